"""Every stress case can fail: with the defect planted that its file in defects/ says, it does, and without it does not."""

import concurrent.futures
import json
import pathlib
import re
import shutil
import unittest

from program import DONE, ROOT, VERDICT_FAILED, ProgramTest, json_of

DEFECTS = sorted(pathlib.Path(__file__).parent.glob("defects/*.json"))
HOME_FOLDERS = ("shaders", "scenes", "bench", "results")  # a program's data: LIGHTSWEEP_HOME
AT_A_TIME = 2


def test_names():
    """`Suite.name` of every GoogleTest."""
    return {".".join(found) for file in (ROOT / "tests").rglob("*.cpp")
            for found in re.findall(r"\bTEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\)", file.read_text(encoding="utf-8"))}


def axes_of(defect):
    return [word for axis, value in defect.get("arms", {}).items() for word in ("-a", f"{axis}={value}")]


class Defects(ProgramTest):
    def setUp(self):
        super().setUp()
        self.defects = {file.stem: json_of(file) for file in DEFECTS}
        self.planted = {name: defect for name, defect in self.defects.items() if "shown_by" not in defect}

    def home_with(self, name, defect):
        """A home whose shaders have the defect; the rest of it is the project's own."""
        home = self.folder / f"home_{name}"
        shutil.copytree(ROOT / "shaders", home / "shaders")
        for folder in HOME_FOLDERS[1:]:
            (home / folder).symlink_to(ROOT / folder)
        file = home / "shaders" / defect["file"]
        text = file.read_text(encoding="utf-8")
        self.assertEqual(text.count(defect["replace"]), defect.get("count", 1), f"{name}: how often {file.name} has the text")
        file.write_text(text.replace(defect["replace"], defect["with"]), encoding="utf-8")
        return home

    def stress(self, name, cases, axes, environment):
        """(exit code, {case: what its arms ended as}, what was said)"""
        done = self.run_program("stress", *cases, "--quick", *axes, "--out", name, environment=environment)
        file = self.folder / name / "stress.json"
        statuses = {}
        for entry in json_of(file)["cases"] if file.exists() else []:
            statuses.setdefault(entry["id"], []).append((entry["status"], entry["arm"], entry["reason"]))
        return done.returncode, statuses, f"{done.stdout}\n{done.stderr}"

    def side_by_side(self, jobs):
        with concurrent.futures.ThreadPoolExecutor(AT_A_TIME) as pool:
            return list(pool.map(lambda job: self.stress(*job), jobs))

    def test_every_case_has_one(self):
        listed = {case["id"] for case in json.loads(self.assert_done("list", "stress", "--json").stdout)}
        self.assertEqual({defect["case"] for defect in self.defects.values()}, listed)
        for name, defect in self.defects.items():
            self.assertTrue(defect.get("why"), name)

    def test_what_a_unit_test_shows_is_there(self):
        names = test_names()
        for name, defect in self.defects.items():
            if "shown_by" in defect:
                self.assertIn(defect["shown_by"], names, name)

    def test_with_it_the_case_fails(self):
        jobs = []
        for name, defect in self.planted.items():
            home = {"LIGHTSWEEP_HOME": self.home_with(name, defect)} if "file" in defect else {}
            jobs.append((name, [defect["case"]], axes_of(defect), self.environment(**home)))
        for (name, (case,), *_), (code, statuses, said) in zip(jobs, self.side_by_side(jobs)):
            with self.subTest(name):
                self.assertEqual(code, VERDICT_FAILED, said)
                self.assertIn("fail", [status for status, *_ in statuses.get(case, [])], said)

    def test_without_it_none_does(self):
        by_axes = {}
        for defect in self.planted.values():
            if "file" in defect:  # the others plant theirs by an axis: every run without it is the one to hold
                by_axes.setdefault(tuple(axes_of(defect)), []).append(defect["case"])
        jobs = [(f"sound{i}", cases, axes, self.environment()) for i, (axes, cases) in enumerate(by_axes.items())]
        for (_, cases, axes, _), (code, statuses, said) in zip(jobs, self.side_by_side(jobs)):
            with self.subTest(f"{cases} {axes}"):
                self.assertEqual(code, DONE, said)
                for case in cases:
                    self.assertLessEqual({status for status, *_ in statuses[case]}, {"pass", "limit"}, said)


if __name__ == "__main__":
    unittest.main()
