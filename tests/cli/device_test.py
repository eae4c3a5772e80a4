"""Devices: what needs none, what is refused (exit code 3), and that two of them draw the same picture."""

import json
import unittest

from program import CELLS_FAILED, REFUSED, RUN, ProgramTest

SMALL = ("render", "--scene", "cornell", "--size", "32x32", "-o", "a.png")


class WithoutGl(ProgramTest):
    def test_lists_need_none(self):
        environment = self.without_gl()
        for what, some in (("paths", ("forward", "forward_prepass", "deferred", "deferred_volumes")),
                           ("layouts", ("float32", "float16", "lecture", "luminance", "oct16", "oct32", "rgb10a2", "packed")),
                           ("scenes", ("cornell", "spheres", "atrium", "overdraw", "materials", "city", "bunker", "wall")),
                           ("encodings", ("oct",)), ("metrics", ("rmse", "psnr_db")), ("sweeps", ("default", "smoke", "skips")),
                           ("skips", ("frustum", "occlusion", "cells")),
                           ("views", ("final", "depth", "lights"))):
            text = self.assert_done("list", what, environment=environment).stdout
            keys = [line.split()[0] for line in text.splitlines()[2:]]
            self.assertLessEqual(set(some), set(keys))
            listed = json.loads(self.assert_done("list", what, "--json", environment=environment).stdout)
            self.assertEqual([entry["key"] for entry in listed], keys)

    def test_the_needs_of_a_scene_need_none(self):
        self.assertIn("occlusion", self.assert_done("needs", "cornell", environment=self.without_gl()).stdout)

    def test_a_dry_run_needs_none(self):
        self.assert_done("run", "smoke", "--dry-run", environment=self.without_gl())

    def test_devices_are_listed_with_the_reason(self):
        listed = json.loads(self.assert_done("list", "devices", "--json", environment=self.without_gl()).stdout)
        self.assertEqual({device["key"] for device in listed}, {"surfaceless", "osmesa"})
        for device in listed:
            self.assertFalse(device["available"])
            self.assertNotEqual(device["reason"], "")

    def test_what_draws_is_refused_with_the_cure(self):
        environment = self.without_gl()
        for device, cure in (("auto", "install"), ("surfaceless", "libegl-mesa0"), ("osmesa", "libosmesa6"), ("egl:0", "install")):
            self.assert_refused([*SMALL, "--device", device], cure, code=REFUSED, environment=environment)
        self.assert_refused([*RUN, "smoke", "--out", "out"], "OpenGL 4.5", code=REFUSED, environment=environment)
        self.assert_refused(["doctor"], "OpenGL 4.5", code=REFUSED, environment=environment)


class Refusals(ProgramTest):
    def test_an_unknown_device_is_bad_input(self):
        self.assert_refused([*SMALL, "--device", "osmsa"], "--device", "did you mean 'osmesa'")
        self.assert_refused(SMALL, "LIGHTSWEEP_DEVICE", "'gpu'", environment=self.environment(LIGHTSWEEP_DEVICE="gpu"))

    def test_a_device_that_is_not_there(self):
        self.assert_refused([*SMALL, "--device", "egl:99"], "egl:99", code=REFUSED)

    def test_the_wrong_renderer(self):
        self.assert_refused([*SMALL, "--require-renderer", "^no such renderer$"], "no such renderer", "list devices", code=REFUSED)
        self.assert_refused([*RUN, "smoke", "--require-renderer", "^no such renderer$", "--out", "out"], code=REFUSED)

    def test_a_renderer_below_4_5(self):
        environment = self.environment(GALLIUM_DRIVER="softpipe")
        for device in ("auto", "surfaceless", "osmesa"):
            self.assert_refused([*SMALL, "--device", device], "softpipe", "4.5", code=REFUSED, environment=environment)

    def test_a_picture_over_the_devices_limit(self):
        self.assert_refused(["render", "--scene", "cornell", "--size", "65536x1", "-o", "a.png"], "65536x1", "limit", code=REFUSED)


class Pictures(ProgramTest):
    def test_two_devices_draw_the_same_picture(self):
        for path, layout in (("forward", "float32"), ("deferred", "packed"), ("deferred_volumes", "oct32")):
            for device in ("surfaceless", "osmesa"):
                self.assert_done("render", "--scene", "materials", "--path", path, "--layout", layout, "--size", "160x90",
                                 "--device", device, "--require-renderer", "llvmpipe", "-o", f"{device}.png")
            self.assertEqual(*((self.folder / f"{device}.png").read_bytes() for device in ("surfaceless", "osmesa")))

    def test_every_view_is_drawn(self):
        pictures = set()
        for view in json.loads(self.assert_done("list", "views", "--json").stdout):
            for kind, magic in (("png", b"\x89PNG"), ("exr", b"\x76\x2f\x31\x01")):
                name = f"{view['key']}.{kind}"
                self.assert_done("render", "--scene", "materials", "--size", "64x36", "--view", view["key"], "-o", name)
                picture = (self.folder / name).read_bytes()
                self.assertTrue(picture.startswith(magic), name)
                self.assertNotIn(picture, pictures, f"{name} is the same as another view")
                pictures.add(picture)

    def test_diff(self):
        for lights, name in ((4, "a"), (4, "b"), (5, "c")):
            self.assert_done("render", "--scene", "cornell", "--size", "32x32", "--lights", lights, "-o", f"{name}.png")
        same = json.loads(self.assert_done("diff", "a.png", "b.png", "--json").stdout)
        self.assertTrue(same["identical"])
        self.assertEqual((same["rmse"], same["max_abs"], same["psnr_db"]), (0, 0, None))
        self.assertRegex(self.assert_done("diff", "a.png", "b.png").stdout, r"(?m)^identical +true$")
        other = json.loads(self.assert_done("diff", "a.png", "c.png", "--json", "-o", "map.png").stdout)
        self.assertFalse(other["identical"])
        self.assertGreater(other["rmse"], 0)
        self.assertGreater(other["max_abs"], other["rmse"])
        self.assertTrue((self.folder / "map.png").read_bytes().startswith(b"\x89PNG"))


class Cells(ProgramTest):
    def test_a_cell_over_the_devices_limit_is_skipped_and_the_others_go_on(self):
        self.assert_done(*RUN, "-a", "scene=cornell", "-a", "path=forward", "-a", "lights=1", "-a", "size=65536x1,32x32",
                         "--target-ci", "100%", "--out", "out", code=CELLS_FAILED)
        report = self.assert_valid_report("out/report.json")
        too_large, small = report["cells"]
        self.assertEqual((too_large["params"]["width_px"], too_large["status"]), (65536, "skipped"))
        self.assertIn("limit", too_large["reason"])
        self.assertEqual((small["params"]["width_px"], small["status"]), (32, "ok"))
        self.assertEqual((report["summary"]["counts"]["ok"], report["summary"]["counts"]["skipped"]), (1, 1))


if __name__ == "__main__":
    unittest.main()
