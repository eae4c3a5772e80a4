"""Skips as a user meets them: what a scene needs, the axis, the table and the figure of a run."""

import json
import unittest

from program import RUN, ProgramTest, script

KEYS = ["frustum", "light_frustum", "light_lists", "light_depth", "occlusion", "backface", "sort", "fields", "passes", "code",
        "background", "clears", "cells"]


class Needs(ProgramTest):
    def needs(self, scene):
        """Its JSON, and {skip: whether it may help}."""
        json_of_scene = json.loads(self.assert_done("needs", scene, "--json").stdout)
        return json_of_scene, {skip["key"]: skip["may_help"] for skip in json_of_scene["skips"]}

    def test_a_wall_has_nothing_to_cull(self):
        wall, skips = self.needs("wall")
        self.assertEqual((wall["instances"], wall["triangles"], wall["materials"]), (1, 2, 1))
        self.assertEqual(list(skips), KEYS)
        self.assertEqual([key for key in KEYS if not skips[key]], ["frustum", "occlusion", "sort"])
        self.assertTrue(wall["needs"]["directional_lights"] and wall["needs"]["ggx"])
        self.assertFalse(wall["needs"]["alpha_masks"] or wall["needs"]["lambert"])
        self.assertIn("HAS_NORMAL_TEXTURE", wall["defines"])

    def test_a_bunker_needs_next_to_nothing(self):
        bunker, skips = self.needs("bunker")
        self.assertEqual([name for name, needed in bunker["needs"].items() if needed], ["lambert", "single_sided", "local_lights"])
        self.assertEqual([field for field, needed in bunker["fields"].items() if needed], ["position", "normal", "base_color"])
        self.assertTrue(all(skips.values()))

    def test_materials_needs_every_field_and_all_code(self):
        materials, skips = self.needs("materials")
        self.assertTrue(all(materials["fields"].values()))
        self.assertEqual([key for key in KEYS if not skips[key]], ["fields", "code"])

    def test_the_table_says_the_same(self):
        lines = self.assert_done("needs", "wall").stdout.splitlines()
        self.assertLessEqual(max(map(len, lines[1:])), 120)
        words = [line.split() for line in lines]
        self.assertIn(["directional", "lights", "yes"], words)
        self.assertIn(["alpha", "masks", "no"], words)
        self.assertIn(["sort", "no", "1", "instance:", "nothing", "to", "order"], words)

    def test_bad_scenes(self):
        self.assert_refused(["needs", "wal"], "unknown scene 'wal'", "did you mean 'wall'")
        self.assert_refused(["needs", "gone.json"], "gone.json", "no such file")
        self.assert_refused(["needs"], "scene")
        torn = self.write("torn.json", "{")
        self.assert_refused(["needs", torn], "torn.json:1")


class Sets(ProgramTest):
    def test_the_list(self):
        listed = json.loads(self.assert_done("list", "skips", "--json").stdout)
        self.assertEqual([skip["key"] for skip in listed], KEYS)
        self.assertEqual([skip["key"] for skip in listed if not skip["same_bits"]], ["backface", "fields", "code"])
        self.assertTrue(all(skip["what"] for skip in listed))

    def test_bad_sets(self):
        for text, words in (("al", ("'al'", "did you mean 'all'")), ("all-srot", ("'srot'", "did you mean 'sort'")),
                            ("sort", ("'sort'", "all or none")), ("all-", ("''", "frustum")), ("auto-sort", ("auto",)),
                            ("none+*+sort", ("'*'",))):
            self.assert_refused(["run", "-a", "scene=wall", "-a", f"skip={text}", "--dry-run"], f"skip={text}", *words)
            self.assert_refused(["render", "--scene", "wall", "--skip", text, "-o", "a.png"], f"skip={text}", *words)
        self.assert_refused(["render", "--scene", "wall", "--skip", "auto", "-o", "a.png"], "--skip auto", "all")

    def test_pictures_of_any_set(self):
        for number, text in enumerate(("all", "none", "all-background-clears")):
            self.assert_done("render", "--scene", "cornell", "--path", "deferred", "--lights", "8", "--size", "48x32", "--hdr",
                             "rgba32f", "--skip", text, "-o", f"{number}.exr")
        for number in (1, 2):
            metrics = json.loads(self.assert_done("diff", "0.exr", f"{number}.exr", "--json").stdout)
            self.assertLess(metrics["max_abs"], 1e-5)
        self.assert_done("render", "--scene", "cornell", "--view", "normal", "--size", "48x32", "--skip", "none", "-o", "normal.exr")


class SkipRun(ProgramTest):
    """A tiny run over sets of skips: their pictures are one, and its end says what each saved."""

    AXES = ("-a", "scene=cornell", "-a", "path=forward_clustered,deferred_clustered", "-a", "layout=oct32", "-a", "lights=8", "-a",
            "size=48x32", "-a", "light_lists=cpu", "-a", "skip=all,none,all-sort,all-fields,none+light_lists,auto")

    def test_what_is_said_of_skips(self):
        done = self.assert_done(*RUN, *self.AXES, "--time-budget", "2s", "--target-ci", "50%", "--out", "out")
        report = self.assert_valid_report("out/report.json")
        self.assert_cells(report)
        self.assert_savings(report)
        self.assert_table(done.stdout, report)
        plotted = script("plot.py", self.folder / "out/report.json")
        self.assertTrue((self.folder / "out/skips_cornell.png").is_file(), plotted.stderr)

    def assert_cells(self, report):
        ids = {cell["id"] for cell in report["cells"]}
        for cell in report["cells"]:
            self.assertEqual(cell["status"], "ok")
            self.assertEqual(cell["auto_skip"] is not None, cell["params"]["skip"] == "auto")
            self.assertTrue(cell["work_key"])
            if cell["shared_with"] is not None:
                self.assertIn(cell["shared_with"], ids - {cell["id"]})
            proof = cell["skip_proof"]
            if cell["params"]["skip"] == "all":
                self.assertIsNone(proof)  # the first of its kind
            else:
                self.assertIn(proof["compared_with"], ids)
                self.assertLess(proof["max_rel"], 2e-3)  # half floats
            if cell["params"]["skip"] in ("all-sort",):
                self.assertTrue(proof["same_bits"])

    def assert_savings(self, report):
        found = {(saving["path"], saving["skip"], saving["others"]) for saving in report["skips"]}
        for path in ("forward_clustered", "deferred_clustered"):
            self.assertLessEqual({(path, skip, others) for skip, others in
                                  (("sort", "all"), ("fields", "all"), ("light_lists", "none"), ("all", "none"), ("auto", "none"))},
                                 found)
        for saving in report["skips"]:
            if (saving["path"], saving["skip"]) == ("forward_clustered", "fields"):
                self.assertTrue(saving["same_work"])  # it has no G-buffer
            if saving["skip"] == "all":
                self.assertFalse(saving["same_work"])

    def assert_table(self, text, report):
        lines = text.splitlines()
        self.assertEqual(sum(line.startswith("skips: cornell, 8 lights, 48x32, ") for line in lines), 2)
        self.assertTrue(any(line.startswith("same work, off from all: ") and "fields" in line for line in lines))
        self.assertEqual(sum(line.startswith("all against none: ") for line in lines), 2)
        self.assertTrue(any(line.split()[:4] == ["light_lists", "on", "from", "none"] for line in lines), text)
        # The table of cells tells the sets apart.
        self.assertIn("skip", next(line for line in lines if "95 %" in line).split())
        self.assertEqual(sum("(auto)" in line for line in lines), 2, report["cells"][-1]["auto_skip"])
        table = lines[lines.index(next(line for line in lines if line.startswith("skips: "))):]
        self.assertLessEqual(max(len(line) for line in table if "against none" not in line), 120)


class SkipSweep(ProgramTest):
    def test_the_sweep_takes_each_skip_off_and_on(self):
        lines = self.assert_done("run", "skips", "--dry-run").stdout.splitlines()
        city = [line for line in lines if line.startswith("  ") and "scene=city" in line and "path=deferred_clustered" in line]
        sets = {line.split("skip=")[1] if "skip=" in line else "all" for line in city}
        self.assertEqual(sets, {"all", "none", *(f"all-{key}" for key in KEYS), *(f"none+{key}" for key in KEYS)})


if __name__ == "__main__":
    unittest.main()
