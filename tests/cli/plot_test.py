"""scripts/plot.py: draws what is odd but sound, says what it leaves out, and refuses what is no report with one line."""

import itertools
import pathlib
import tempfile
import unittest

from program import script, write_json

HDR = "rgba16f"
ARMS = (("forward", None), ("deferred", "oct32"), ("deferred", "my/own layout.json"))


def estimate(ns, open_ended=False):
    return {"median": ns, "low": None if open_ended else 0.9 * ns, "high": None if open_ended else 1.2 * ns}


def made_up_report(scenes=("cornell",), lights=(0, 1, 8), sizes=((64, 36), (128, 72)), arms=ARMS):
    """A report with what readers need: some intervals open, one arm without error, a crossover with an open end."""
    report = {
        "schema": "lightsweep-report-1",
        "run": {"version": "0.1.0", "git_commit": None},
        "environment": {"gl_renderer": "a renderer", "cpu": "a processor", "cores": 2},
        "timer": {"method": "finish_clock"},
        "noise": {"floor": None},
        "cells": [], "pairs": [], "crossovers": [], "pareto": [],
    }
    for scene, (width, height), count in itertools.product(scenes, sizes, lights):
        group = f"scene={scene} lights={count} size={width}x{height}"
        ids = []
        for number, (path, layout) in enumerate(arms):
            ns = 1e6 * (1 + count * (number + 1)) * width / 64
            ids.append(f"{group} {number}")
            report["cells"].append({
                "id": ids[-1], "group": group, "status": "ok",
                "params": {"scene": scene, "lights": count, "width_px": width, "height_px": height, "overlap": None,
                           "path": path, "layout": layout, "hdr": HDR},
                "statistics": {"wall_ns": estimate(ns, open_ended=count == 0), "gpu_ns": estimate(0.9 * ns),
                               "passes": {"gbuffer": estimate(0.8 * ns), "unattributed": estimate(-5)}},
                "error": {"display": {"rmse": 0.001 * number}},
            })
            if number > 0:
                report["pairs"].append({"a": ids[-1], "b": ids[0], "ratio": 1.5, "low": None, "high": 2.0})
        report["pareto"].append({"group": group, "front": ids[:1], "dominated": ids[1:]})
    for path, layout in arms[1:]:
        report["crossovers"].append({
            "scene": scenes[0], "width_px": 64, "height_px": 36, "overlap": None,
            "a": {"path": path, "layout": layout, "hdr": HDR}, "b": {"path": "forward", "layout": None, "hdr": HDR},
            "lights": 2.5, "low": None, "high": 7, "reason": None})
    report["cells"].append({**report["cells"][0], "id": "failed", "status": "error", "statistics": None, "error": None})
    return report


class Plot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lightsweep-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def plot(self, report):
        """(file names written, lines on stderr), checked against what is printed."""
        done = script("plot.py", write_json(self.folder / "report.json", report), "--out", self.folder / "pictures")
        self.assertEqual(done.returncode, 0, done.stderr)
        written = sorted(self.folder.glob("pictures/*"))
        self.assertEqual(sorted(done.stdout.split()), [str(file) for file in written])
        for file in written:
            self.assertTrue(file.read_bytes().startswith(b"\x89PNG" if file.suffix == ".png" else b"<?xml"), file)
        return {file.name for file in written}, done.stderr.splitlines()

    def names(self, *words):
        return {f"{word}.{kind}" for word in words for kind in ("png", "svg")}

    def test_everything(self):
        files, said = self.plot(made_up_report())
        self.assertEqual(files, self.names("time_over_lights_cornell", "ratio_to_forward_cornell", "time_per_pass_cornell",
                                           "time_against_error_cornell"))
        self.assertEqual(said, [])

    def test_the_crossover_and_its_absence_are_written_down(self):
        report = made_up_report(sizes=((64, 36),))
        report["crossovers"][1] |= {"lights": None, "high": None, "reason": "forward is faster at every light count measured"}
        self.plot(report)
        # SVG text is drawn as glyphs; its comments hold the words.
        svg = (self.folder / "pictures/ratio_to_forward_cornell.svg").read_text(encoding="utf-8")
        self.assertIn("deferred, oct32: crossover at 2.5 lights [open, 7]", svg)
        self.assertIn("deferred, own layout: no crossover: forward is faster at every", " ".join(svg.split()))

    def test_what_has_no_data_is_left_out_with_a_line(self):
        files, said = self.plot(made_up_report(lights=(4,), arms=ARMS[:2]))
        self.assertEqual(files, self.names("time_per_pass_cornell"))
        self.assertEqual(len(said), 3)
        self.assertTrue(all(line.startswith("plot.py: no ") and "cornell" in line for line in said), said)

    def test_scenes_with_one_name(self):
        files, _ = self.plot(made_up_report(scenes=("a/box.gltf", "b/box.gltf"), lights=(4,)))
        self.assertLessEqual(self.names("time_per_pass_box", "time_per_pass_box-2"), files)

    def test_nothing_measured(self):
        files, said = self.plot(made_up_report(scenes=("cornell",)) | {"cells": []})
        self.assertEqual((files, len(said)), (set(), 1))

    def test_the_same_report_gives_the_same_files(self):
        self.plot(made_up_report(lights=(1, 2)))
        first = {file.name: file.read_bytes() for file in self.folder.glob("pictures/*")}
        self.plot(made_up_report(lights=(1, 2)))
        self.assertEqual({file.name: file.read_bytes() for file in self.folder.glob("pictures/*")}, first)

    def test_bad_input(self):
        report = made_up_report()
        cases = {
            "gone.json": None,
            "torn.json": '{"schema": ',
            "list.json": [],
            "other.json": report | {"schema": "another-1"},
            "part.json": {key: value for key, value in report.items() if key != "pairs"},
            "cell.json": report | {"cells": [{"status": "ok"}]},
        }
        for name, content in cases.items():
            file = self.folder / name
            if isinstance(content, str):
                file.write_text(content, encoding="utf-8")
            elif content is not None:
                write_json(file, content)
            done = script("plot.py", file, "--out", self.folder / "pictures")
            self.assertEqual((done.returncode, done.stdout), (2, ""), name)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(name, done.stderr)


if __name__ == "__main__":
    unittest.main()
