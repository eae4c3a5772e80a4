"""scripts/plot.py: draws what is odd but sound, says what it leaves out, and refuses what is no report with one line."""

import itertools
import pathlib
import re
import struct
import sys
import tempfile
import unittest
import zlib

from program import ROOT, script, write_json

sys.path.insert(0, str(ROOT / "scripts"))
sys.dont_write_bytecode = True

from plotting import flip_maps  # noqa: E402  (the path comes first)
from plotting import report as data  # noqa: E402
from plotting import style  # noqa: E402

HDR = "rgba16f"
ARMS = (("forward", None), ("deferred", "oct32"), ("deferred", "my/own layout.json"))


def estimate(ns, open_ended=False):
    return {"median": ns, "low": None if open_ended else 0.9 * ns, "high": None if open_ended else 1.2 * ns}


def error(flip_mean, layout):
    """As a cell's: the larger, the wider its interval; the first layout is exact in its roughness."""
    number = {"flip_mean": flip_mean, "rmse": 2 * flip_mean, "nonfinite_px": 0}
    fields = {} if layout is None else {
        "normal": {"mean_deg": 0.1, "p99_deg": 0.4, "max_deg": 2.0},
        "roughness": dict.fromkeys(("mean_abs", "p99_abs", "max_abs"), 0.0 if layout == ARMS[1][1] else 0.002)}
    return {"reference": {"display": number}, "control": None, "flip_mean_low": 0.0, "flip_mean_high": 1.5 * flip_mean,
            "fields": fields}


def map_png(width, height, values):
    """The bytes of a 16-bit grey picture (PNG specification, sections 5.3 and 11.2)."""
    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    rows = b"".join(b"\0" + struct.pack(f">{width}H", *values[y * width:(y + 1) * width]) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def made_up_report(scenes=("cornell",), lights=(0, 1, 8), sizes=((64, 36), (128, 72)), arms=ARMS):
    """A report with what readers need: some intervals open, one arm whose error is 0, a crossover with an open end."""
    report = {
        "schema": "lightsweep-report-2",
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
                "work": {"light_evaluations": 30 * (number + 1) * (count + 1), "light_hits": 30 * count},
                "error": error(0.001 * number, layout),
            })
            if number > 0:
                report["pairs"].append({"a": ids[-1], "b": ids[0], "ratio": 1.5, "low": None, "high": 2.0,
                                        "verdict": "slower" if number == 1 else "ambiguous"})
        states = ("front", "perhaps", "dominated")
        points = [{"id": cell_id, "state": states[number % 3]} for number, cell_id in enumerate(ids)]
        report["pareto"].append({"points": points})
    for path, layout in arms[1:]:
        report["crossovers"].append({
            "scene": scenes[0], "width_px": 64, "height_px": 36, "overlap": None,
            "a": {"path": path, "layout": layout, "hdr": HDR}, "b": {"path": "forward", "layout": None, "hdr": HDR},
            "on_envelope": layout == "oct32", "lights": 2.5, "low": None, "high": 7, "reason": None})
    report["cells"].append({**report["cells"][0], "id": "failed", "status": "error", "statistics": None, "error": None})
    return report


def saving(cell, skip, others, ratio, same_work=False):
    """An entry of `skips` with the axes of a cell: an open end below, none of its own where the ratio is none."""
    return {**cell["params"], "group": cell["group"], "skip": skip, "others": others, "with": "a", "without": "b",
            "same_work": same_work, "ratio": ratio, "low": None, "high": None if ratio is None else 1.1 * ratio, "floor": 0.02}


class Plot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lightsweep-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def plot(self, report, *options):
        """(file names written, lines on stderr), checked against what is printed."""
        done = script("plot.py", write_json(self.folder / "report.json", report), "--out", self.folder / "pictures", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        written = sorted(self.folder.glob("pictures/*"))
        self.assertEqual(sorted(done.stdout.split()), [str(file) for file in written])
        for file in written:
            self.assertTrue(file.read_bytes().startswith(b"\x89PNG" if file.suffix == ".png" else b"<?xml"), file)
        return {file.name for file in written}, done.stderr.splitlines()

    def words_in(self, name):
        """The words of a picture: SVG text is drawn as glyphs, but its comments hold it."""
        svg = (self.folder / "pictures" / f"{name}.svg").read_text(encoding="utf-8")
        return " ".join(" ".join(re.findall("<!--(.*?)-->", svg, re.DOTALL)).split())

    def names(self, *words):
        return {f"{word}.{kind}" for word in words for kind in ("png", "svg")}

    def write_maps(self, report):
        (self.folder / "maps").mkdir()
        for cell in report["cells"]:
            params = cell["params"]
            width, height = params["width_px"], params["height_px"]
            (self.folder / "maps" / f"{cell['id']}.png").write_bytes(map_png(width, height, range(width * height)))

    def test_everything(self):
        report = made_up_report()
        self.write_maps(report)
        files, said = self.plot(report)
        self.assertEqual(files, self.names("time_over_lights_cornell", "ratio_to_forward_cornell",
                                           "evaluations_over_lights_cornell", "time_per_pass_cornell",
                                           "time_against_error_cornell", "field_errors_cornell", "flip_maps_cornell"))
        self.assertEqual(said, [])

    def test_time_against_another_error(self):
        report = made_up_report(lights=(4,))
        self.plot(report, "--error", "rmse")
        self.assertIn("error: RMSE of display values", self.words_in("time_against_error_cornell"))
        done = script("plot.py", self.folder / "report.json", "--error", "rmes")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("rmse", done.stderr)

    def test_the_legend_says_how_sure_a_beaten_arm_is_beaten(self):
        self.plot(made_up_report(lights=(4,)))
        words = self.words_in("time_against_error_cornell")
        for word in ("front (by the estimates)", "perhaps: not surely", "faded: surely beaten"):
            self.assertIn(word, words)

    def test_states_on_the_front(self):
        report = made_up_report(lights=(4,), sizes=((64, 36),))
        cells = data.measured(report)
        ids = [cell["id"] for cell in cells]
        self.assertEqual(data.front_states(report, cells, "flip_mean"), dict(zip(ids, ("front", "perhaps", "dominated"))))
        # Of another error the report has only its pairs: the second arm is surely slower than the first, the third is not.
        self.assertEqual(data.front_states(report, cells, "rmse"), dict(zip(ids, ("front", "dominated", "perhaps"))))
        report["pairs"][0]["verdict"] = "same"
        self.assertEqual(data.front_states(report, cells, "rmse")[ids[1]], "dominated")
        cells[1]["error"]["reference"]["display"]["rmse"] = 0
        self.assertEqual(data.front_states(report, cells, "rmse")[ids[1]], "perhaps")

    def test_maps_are_read_with_all_their_bits(self):
        file = self.folder / "map.png"
        file.write_bytes(map_png(3, 2, (0, 1, 7, 255, 256, 65535)))
        values = flip_maps._read(file, data.Panel(3, 2, None))
        self.assertEqual([round(65535 * float(value)) for value in values.flat], [0, 1, 7, 255, 256, 65535])
        self.assertEqual(values.flat[5], 1)
        with self.assertRaisesRegex(ValueError, "2x3"):
            flip_maps._read(file, data.Panel(2, 3, None))

    def test_arms_without_an_error_are_left_out(self):
        report = made_up_report(lights=(4,), sizes=((64, 36),), arms=(*ARMS, ("deferred", "unheard"), ("deferred", "alone")))
        report["cells"][3]["error"] = None
        report["cells"][4]["error"]["reference"] = None
        files, said = self.plot(report)
        self.assertLessEqual(self.names("time_against_error_cornell", "field_errors_cornell"), files)
        words = self.words_in("field_errors_cornell")
        self.assertIn("oct32", words)
        self.assertNotIn("unheard", words)
        self.assertNotIn("alone", words)
        self.assertTrue(any("flip_maps" in line and "--maps" in line for line in said), said)

    def test_a_map_that_is_no_picture(self):
        report = made_up_report(lights=(4,))
        self.write_maps(report)
        (self.folder / "maps" / f"{report['cells'][-2]['id']}.png").write_bytes(b"\x89PNG")
        done = script("plot.py", write_json(self.folder / "report.json", report), "--out", self.folder / "pictures")
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 4), done.stderr)
        self.assertIn("maps: a map cannot be read", done.stderr.splitlines()[-1])

    def test_the_crossover_and_its_absence_are_written_down(self):
        report = made_up_report(sizes=((64, 36),))
        report["crossovers"][1] |= {"lights": None, "high": None, "reason": "forward is faster at every light count measured"}
        self.plot(report)
        words = self.words_in("ratio_to_forward_cornell")
        self.assertIn("deferred, oct32: crossover at 2.5 lights [open, 7]", words)
        self.assertIn("deferred, own layout: no crossover: forward is faster at every", words)

    def test_where_another_becomes_the_fastest_is_marked(self):
        report = made_up_report(sizes=((64, 36),))
        self.plot(report)
        self.assertIn("another becomes the fastest", self.words_in("time_over_lights_cornell"))
        for entry in report["crossovers"]:
            entry["on_envelope"] = False
        self.plot(report)
        self.assertNotIn("another becomes the fastest", self.words_in("time_over_lights_cornell"))

    def test_the_legend_is_in_the_order_of_the_lines(self):
        # The times rise with the number of the arm.
        self.plot(made_up_report(sizes=((64, 36),)))
        words = self.words_in("time_over_lights_cornell")
        self.assertLess(words.index("deferred, own layout"), words.index("deferred, oct32"))
        self.assertLess(words.index("deferred, oct32"), words.index("forward"))

    def test_evaluations_that_were_not_counted_are_left_out(self):
        report = made_up_report(lights=(0, 1, 8))
        self.plot(report)
        self.assertIn("light evaluations made for each that must be", self.words_in("evaluations_over_lights_cornell"))
        for cell in report["cells"]:
            cell["work"] = {"light_evaluations": 5} if cell["params"]["path"] == "forward" else None
        for name in self.names("evaluations_over_lights_cornell"):
            (self.folder / "pictures" / name).unlink()
        self.assertTrue(any("no evaluations_over_lights of cornell" in line for line in self.plot(report)[1]))

    def test_passes_at_the_light_counts_asked_for(self):
        self.plot(made_up_report(), "--lights", "1,8")
        words = self.words_in("time_per_pass_cornell")
        for title in ("64\u00d736, 1 lights", "64\u00d736, 8 lights", "128\u00d772, 1 lights", "128\u00d772, 8 lights"):
            self.assertIn(title, words)
        self.plot(made_up_report(), "--lights", "5")  # none has so many: the largest count, as without
        self.assertIn("64\u00d736, 8 lights", self.words_in("time_per_pass_cornell"))
        done = script("plot.py", self.folder / "report.json", "--lights", "many")
        self.assertEqual((done.returncode, done.stdout), (2, ""))

    def test_passes_of_arms_that_lie_far_apart_are_shown_as_shares(self):
        report = made_up_report(lights=(4,), sizes=((64, 36),))
        self.plot(report)
        self.assertIn("GPU time per frame (ms)", self.words_in("time_per_pass_cornell"))
        slowest = report["cells"][2]["statistics"]
        slowest["gpu_ns"] = estimate(1e9)
        slowest["passes"]["gbuffer"] = estimate(1e9)
        self.plot(report)
        words = self.words_in("time_per_pass_cornell")
        self.assertIn("share of the GPU time (%)", words)
        self.assertIn("1e+03 ms", words)

    def test_what_skips_save(self):
        report = made_up_report(lights=(4,), sizes=((64, 36),))
        cell = report["cells"][1]
        self.assertNotIn("skips_cornell.png", self.plot(report | {"skips": []})[0])
        report["skips"] = [saving(cell, "sort", "all", 0.8), saving(cell, "sort", "none", 1.0, same_work=True),
                           saving(cell, "frustum", "none", None), saving(cell, "clears", "none+sort", 0.5),
                           saving(cell, "all", "none", 0.25), saving(report["cells"][0], "sort", "all", 1.2)]
        self.assertLessEqual(self.names("skips_cornell"), self.plot(report)[0])
        words = self.words_in("skips_cornell")
        for expected in ("deferred, 64\u00d736, 4 lights", "forward, 64\u00d736, 4 lights", "all against none: 75 % saved [72, 75]",
                         "sort", "frustum", "same work", "no time", "off from all", "on from none", "noise floor"):
            self.assertIn(expected, words)

    def test_a_scene_without_savings_is_left_out_with_a_line(self):
        report = made_up_report(scenes=("cornell", "atrium"), lights=(4,))
        report["skips"] = [saving(report["cells"][0], "sort", "all", 0.8)]
        files, said = self.plot(report)
        self.assertLessEqual(self.names("skips_cornell"), files)
        self.assertTrue(any("no skips of atrium" in line for line in said), said)

    def test_single_skips_are_in_their_own_picture_alone(self):
        cells = [{"params": {"path": "forward", "layout": None, "hdr": HDR, "skip": skip}}
                 for skip in ("all", "all-sort", "none+sort", "none", "auto")]
        kept = data.without_single_skips(cells)
        self.assertEqual([cell["params"]["skip"] for cell in kept], ["all", "none", "auto"])
        self.assertEqual(data.without_single_skips(cells[1:3]), cells[1:3])
        self.assertEqual(list(data.arm_names([data.arm_of(cell["params"]) for cell in kept]).values()),
                         ["forward, skip all", "forward, skip none", "forward, skip auto"])
        arms = [data.arm_of(cell["params"]) for cell in kept]
        looks = style.ArmStyles(["forward"], arms)
        self.assertNotEqual(looks.line(arms[0]), looks.line(arms[1]))

    def test_arms_that_differ_in_guards_or_sums_alone_are_told_apart(self):
        params = {"path": "forward", "layout": None, "hdr": HDR}
        arms = [data.arm_of(params | more) for more in ({}, {"guards": "off"}, {"sums": "compensated"})]
        self.assertEqual(arms[0], data.arm_of(params | {"guards": "on", "sums": "plain"}), "reports of before have neither")
        self.assertEqual(list(data.arm_names(arms).values()), ["forward", "forward, unguarded", "forward, compensated sums"])
        looks = style.ArmStyles(["forward"], arms)
        lines = [tuple(looks.line(arm)[key] for key in ("linestyle", "marker")) for arm in arms]
        self.assertEqual(len(set(lines)), len(arms))

    def test_every_path_of_a_sweep_looks_its_own_way(self):
        paths = [*style.PATH_COLORS, "mine", "mine_too"]
        for arms in ([data.Arm(path, None, HDR) for path in paths], [data.Arm("deferred", layout, HDR) for layout in "abc"]):
            looks = style.ArmStyles([arm.path for arm in arms], arms)
            lines = [tuple(looks.line(arm)[key] for key in ("color", "linestyle", "marker")) for arm in arms]
            self.assertEqual(len(set(lines)), len(arms))
        alone = style.ArmStyles(["deferred_tiled"], [data.Arm("deferred_tiled", "oct32", HDR)])
        self.assertEqual(alone.line(data.Arm("deferred_tiled", "oct32", HDR))["color"], style.PATH_COLORS["deferred_tiled"])

    def test_builders_of_light_lists_are_told_apart(self):
        arms = [data.Arm("deferred_tiled", "oct32", HDR, lists) for lists in ("cpu", "compute")]
        self.assertEqual(list(data.arm_names(arms).values()), ["deferred_tiled, cpu lists", "deferred_tiled, compute lists"])
        looks = style.ArmStyles(["deferred_tiled"], arms)
        self.assertNotEqual(looks.line(arms[0]), looks.line(arms[1]))

    def test_what_has_no_data_is_left_out_with_a_line(self):
        files, said = self.plot(made_up_report(lights=(4,), arms=ARMS[:1]))
        self.assertEqual(files, self.names("time_per_pass_cornell"))
        self.assertEqual(len(said), 6)
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
            "old.json": report | {"schema": "lightsweep-report-1"},
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
