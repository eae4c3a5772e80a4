"""lightsweep explore from the outside: it proposes layouts that fit, that load, and that a run then measures."""

import json
import unittest

from program import ProgramTest

EXPLORE = ("explore", "--scene", "cornell", "--size", "96x54", "--lights", "4", "--allow-debug", "--timer", "finish_clock",
           "--time-budget", "1s")


class Explore(ProgramTest):
    def test_proposes_layouts_that_fit_and_measures_them(self):
        self.assert_done(*EXPLORE, "--max-bytes", "12", "--max-error", "flip=0.5", "--out", "found")
        files = sorted((self.folder / "found/layouts").glob("*.json"))
        self.assertTrue(files)
        report = self.assert_valid_report("found/report.json")
        cells = {cell["params"]["layout"]: cell for cell in report["cells"]}
        self.assertEqual(set(cells), {"float32"} | {f"found/layouts/{file.name}" for file in files})
        front = [cells[f"found/layouts/{file.name}"] for file in files]
        for cell in front:
            self.assertEqual(cell["status"], "ok", cell["reason"])
            self.assertLessEqual(cell["work"]["gbuffer_bytes_per_px"], 12)
        # A front: more bytes only for less error.
        front.sort(key=lambda cell: cell["work"]["gbuffer_bytes_per_px"])
        errors = [cell["error"]["control"]["display"]["flip_mean"] for cell in front]
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertEqual(len(set(errors)), len(errors))
        self.assertEqual(len(report["answers"]), 1)
        # What it wrote is a sweep like any other.
        self.assert_done("run", "found/sweep.json", "--dry-run")

    def test_the_same_again_proposes_the_same(self):
        for folder in ("one", "two"):
            self.assert_done(*EXPLORE, "--max-bytes", "10", "--out", folder)
        texts = [[file.read_text(encoding="utf-8") for file in sorted((self.folder / folder / "layouts").glob("*.json"))]
                 for folder in ("one", "two")]
        self.assertEqual(*texts)

    def test_options_of_ones_own(self):
        self.write("mine.json", {
            "normal": [{"encoding": "oct", "bits": [8, 8]}], "base_color": [{"encoding": "gamma2", "bits": [5, 6, 5]}],
            "roughness": [{"encoding": "linear", "bits": [8]}], "model": [{"encoding": "id", "bits": [2]}],
            "depth": [{"format": "D24", "convention": "reversed"}]})
        self.assert_done(*EXPLORE, "--options", "mine.json", "--out", "mine")
        (file,) = (self.folder / "mine/layouts").glob("*.json")
        layout = json.loads(file.read_text(encoding="utf-8"))
        self.assertEqual(layout["depth"], {"format": "D24", "convention": "reversed"})
        self.assertEqual(sum(len(target["fields"]) for target in layout["targets"]), 4)

    def test_bad_input_is_one_line(self):
        self.assert_refused((*EXPLORE, "--max-bytes", "3"), "--max-bytes 3")
        self.assert_refused((*EXPLORE, "--max-error", "flipp=0.1"), "flip")
        self.assert_refused((*EXPLORE, "--max-time", "soon"), "--max-time soon")
        self.assert_refused((*EXPLORE, "--options", "nowhere.json"), "nowhere.json")
        self.write("few.json", {"normal": [{"encoding": "oct", "bits": [8, 8]}],
                                "depth": [{"format": "D24", "convention": "reversed"}]})
        self.assert_refused((*EXPLORE, "--options", "few.json"), "base_color")
        self.assert_refused(("explore", "--scene", "atriun"), "atrium")


if __name__ == "__main__":
    unittest.main()
