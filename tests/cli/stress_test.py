"""lightsweep stress from the outside: every case on a few arms of each kind, its record, what it refuses, its pictures."""

import json
import unittest

from program import REFUSED, ROOT, ProgramTest, json_of, script, write_json

FEW = ("stress", "S2", "S12", "S23", "--quick")
COUNT = 31


class Listed(ProgramTest):
    def test_every_case_without_a_context(self):
        listed = json.loads(self.assert_done("list", "stress", "--json", environment=self.without_gl()).stdout)
        self.assertEqual([case["id"] for case in listed], [f"S{number}" for number in range(1, COUNT + 1)])
        for case in listed:
            self.assertTrue(case["summary"] and case["bound"], case)
        lines = self.assert_done("list", "stress").stdout.splitlines()[2:]
        self.assertEqual([line.split()[0] for line in lines], [case["id"] for case in listed])

    def test_every_case_is_told_of_in_the_documentation(self):
        text = (ROOT / "docs/stability.md").read_text(encoding="utf-8")
        for number in range(1, COUNT + 1):
            self.assertIn(f"\n### S{number}: ", text)


class Quick(ProgramTest):
    def test_all_cases_hold_and_leave_a_sound_record(self):
        done = self.assert_done("stress", "--quick", "--out", "out")
        run = self.assert_valid_report("out/stress.json")
        self.assertEqual(run["summary"]["fail"], 0)
        self.assertEqual(run["summary"]["cases"], COUNT)
        self.assertEqual({entry["id"] for entry in run["cases"] if entry["status"] != "skipped"},
                         {f"S{number}" for number in range(1, COUNT + 1)}, "none is skipped as a whole")
        self.assertTrue(run["run"]["quick"])
        self.assertTrue(run["ulp"])
        for entry in run["cases"]:
            self.assertLessEqual(len(entry["curve"]), 3)
            self.assertIn(entry["id"], done.stdout)
        self.assertIn(f"{COUNT} cases, ", done.stdout)
        self.assertEqual(sum(line.startswith("[") for line in done.stderr.splitlines()), COUNT, "a line for each case")
        plotted = script("plot_stress.py", self.folder / "out/stress.json", "--out", self.folder / "pictures")
        self.assertEqual((plotted.returncode, plotted.stderr), (0, ""))
        self.assertEqual(len(plotted.stdout.splitlines()), 6)


class Stress(ProgramTest):
    def test_the_same_twice(self):
        texts = [self.assert_done(*FEW, "--out", folder).stdout for folder in ("one", "two")]
        self.assertEqual(*texts)
        records = [json_of(self.folder / folder / "stress.json") | {"run": None} for folder in ("one", "two")]
        self.assertEqual(*records)

    def test_json_is_what_is_written(self):
        done = self.assert_done(*FEW, "-a", "path=forward", "--json", "--out", "out")
        run = json.loads(done.stdout)
        self.assertEqual(run, json_of(self.folder / "out/stress.json"))
        self.assertEqual(run["run"]["arguments"][:2], ["stress", "S2"])
        self.assertNotIn("ulp", run)
        self.assertEqual({entry["axes"].get("path", "forward") for entry in run["cases"]}, {"forward"})

    def test_without_a_folder_it_makes_one_of_its_own(self):
        self.assert_done("stress", "S2", "--quick", "-a", "path=forward")
        (file,) = self.folder.glob("out/stress-*/stress.json")
        self.assert_valid_report(file.relative_to(self.folder))

    def test_bad_input_is_one_line(self):
        self.assert_refused(["stress", "S99"], "'S99'", "known")
        self.assert_refused(["stress", "S2", "-a", "paht=forward"], "'paht'", "did you mean 'path'")
        self.assert_refused(["stress", "S2", "-a", "path=foward"], "'foward'", "did you mean 'forward'")
        self.assert_refused(["stress", "S2", "-a", "path"], "axis=value")
        self.assert_refused(["stress", "ulp", "S2"], "neither cases nor axes")
        self.assert_refused(["stress", "fuzz", "--seconds", "-1"], "--seconds")
        self.assert_refused(["stress", "--frobnicate"], "--help")

    def test_without_a_context_it_is_refused(self):
        for arguments in (["stress", "S2", "--out", "out"], ["stress", "ulp"], ["stress", "fuzz", "--seconds", "1"]):
            self.assert_refused(arguments, "OpenGL 4.5", code=REFUSED, environment=self.without_gl())

    def test_ulps(self):
        rows = json.loads(self.assert_done("stress", "ulp", "--quick", "--json").stdout)
        self.assertEqual(len({row["function"] for row in rows}), len(rows))
        for row in rows:
            self.assertEqual(row["max_ulp"] > 0, row["worst_input"] is not None, row)
            self.assertEqual(row["non_finite"] > 0, row["non_finite_input"] is not None, row)
        lines = self.assert_done("stress", "ulp", "--quick").stdout.splitlines()
        self.assertEqual(len(lines), 2 + len(rows))

    def test_fuzzing_a_scene(self):
        found = json.loads(self.assert_done("stress", "fuzz", "--only", "1", "--json").stdout)
        self.assertEqual(found["scenes"], 1)
        self.assertGreater(found["cells"], 0)
        self.assertFalse([finding for finding in found["findings"] if finding["verdict"] == "fail"])
        text = self.assert_done("stress", "fuzz", "--only", "1").stdout
        self.assertIn(f"1 scenes, {found['cells']} cells, 0 fail", text)


def entry(case, axes, table, status, errors, **more):
    """As in a stress.json: errors over 1, 10, 100, ... or one error without a parameter."""
    points = [{"parameter": 10.0 ** i, "measured": value, "predicted": value and 0.5 * value, "bound": 1e-3,
               "status": "pass" if value is not None and value <= 1e-3 else status} for i, value in enumerate(errors)]
    broken = [point["parameter"] for point in points if point["status"] != "pass"]
    return {"id": case, "summary": f"what {case} does", "unit": "rel", "arm": " ".join(f"{k}={v}" for k, v in axes.items()),
            "axes": axes, "table": table, "status": status, "breakdown": broken[0] if broken else None, "curve": points,
            "parameter": {"name": "distance", "unit": "units", "easy": 1.0, "hard": points[-1]["parameter"]},
            "measured": errors[-1], "predicted": None, "bound": 1e-3, "reason": None} | more


def made_up_run():
    rising, flat, zero = [1e-6, 1e-4, 1e-2], [1e-5, 1e-5, 1e-5], [0.0, 0.0, 0.0]
    cases = [entry("S1", {"path": path, "hdr": "rgba32f"}, "paths", "limit" if path == "deferred" else "pass",
                   rising if path == "deferred" else flat) for path in ("forward", "deferred", "visibility")]
    cases += [entry("S1", {"path": "deferred", "layout": layout, "hdr": "rgba32f"}, "layouts", "pass", zero)
              for layout in ("oct16", "oct32")]
    cases.append(entry("S2", {"path": "forward"}, "paths", "fail", [0.0, None, 1e-2]))
    cases.append(entry("S2", {"path": "deferred"}, "paths", "skipped", [0.0, 0.0], breakdown=None, curve=[], measured=None,
                       bound=None, reason="refused"))
    cases += [entry("S14", {"depth": depth, "planes": planes}, "others", "limit" if depth == "D16-standard" else "pass",
                    rising if depth == "D16-standard" else flat)
              for depth in ("D16-standard", "D32F-reversed") for planes in ("near", "far")]
    cases.append(entry("S30", {}, "others", "pass", [0.0], parameter=None, curve=[], breakdown=None))
    return {"schema": "lightsweep-stress-1", "run": {"version": "0.1.0", "git_commit": None},
            "environment": {"gl_renderer": "a renderer", "cpu": "a processor", "cores": 2}, "cases": cases}


class Plot(ProgramTest):
    def plot(self, run):
        return script("plot_stress.py", write_json(self.folder / "stress.json", run), "--out", self.folder / "pictures")

    def words_in(self, name):
        return " ".join((self.folder / f"pictures/{name}.svg").read_text(encoding="utf-8").split())

    def test_every_kind_of_arm(self):
        done = self.plot(made_up_run())
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        names = [f"{name}.{kind}" for name in ("stress_curves", "breakdown", "breakdown_others") for kind in ("png", "svg")]
        self.assertEqual(done.stdout.split(), [str(self.folder / "pictures" / name) for name in names])
        for words, name in ((("S1: what S1 does", "distance (units)", "breakdown", "law", "bound"), "stress_curves"),
                            (("paths", "visibility", "layouts", "oct16", "fail"), "breakdown"),
                            (("S14 by planes", "depth=D16-standard", "within it on every arm: S30"), "breakdown_others")):
            for word in words:
                self.assertIn(word, self.words_in(name))

    def test_the_same_run_gives_the_same_files(self):
        bytes_of = []
        for _ in range(2):
            self.plot(made_up_run())
            bytes_of.append([file.read_bytes() for file in sorted(self.folder.glob("pictures/*"))])
        self.assertEqual(*bytes_of)

    def test_what_has_no_data_is_left_out_with_a_line(self):
        run = made_up_run()
        done = self.plot(run | {"cases": run["cases"][:3]})
        self.assertEqual((done.returncode, len(done.stdout.split()), len(done.stderr.splitlines())), (0, 4, 1))
        done = self.plot(run | {"cases": []})
        self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (0, "", 3))

    def test_bad_input(self):
        run = made_up_run()
        for content in ({"schema": "lightsweep-report-2"}, [], run | {"cases": None}, run | {"cases": [{"id": "S1"}]}):
            done = self.plot(content)
            self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (2, "", 1), done.stderr)
            self.assertIn("stress.json", done.stderr)


if __name__ == "__main__":
    unittest.main()
