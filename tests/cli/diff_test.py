"""lightsweep diff: every number of two pictures, the FLIP map, and what it says of files that are no pictures."""

import json
import struct
import unittest

from program import ProgramTest, grey_png

KEYS = ["rmse", "psnr_db", "max_abs", "max_rel", "mrse", "rel_p50", "rel_p90", "rel_p99", "rel_p999", "ssim", "flip_mean",
        "flip_max", "flip_exposure_start", "flip_exposure_stop", "flip_exposure_count", "nonfinite_px", "identical"]
NAN, INFINITY = float("nan"), float("inf")


def exr(width, height, value_of):
    """The bytes of an uncompressed 32-bit float RGB picture (OpenEXR's file layout); value_of(x, y) is a grey or (r, g, b)."""
    def attribute(name, kind, content):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(content)) + content

    channels = b"".join(name + b"\0" + struct.pack("<IIII", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    box = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = (struct.pack("<II", 20000630, 2) + attribute("channels", "chlist", channels)
              + attribute("compression", "compression", b"\0") + attribute("dataWindow", "box2i", box)
              + attribute("displayWindow", "box2i", box) + attribute("lineOrder", "lineOrder", b"\0")
              + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
              + attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0))
              + attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0")
    row_bytes = 12 * width
    first = len(header) + 8 * height
    offsets = struct.pack(f"<{height}Q", *(first + y * (8 + row_bytes) for y in range(height)))
    rows = b""
    for y in range(height):
        pixels = [value if isinstance(value, tuple) else (value,) * 3 for value in (value_of(x, y) for x in range(width))]
        values = [pixel[channel] for channel in (2, 1, 0) for pixel in pixels]
        rows += struct.pack("<iI", y, row_bytes) + struct.pack(f"<{3 * width}f", *values)
    return header + offsets + rows


def ramp(x, y):
    return (x + 1) / 16, (y + 1) / 16, 2.0 if x == y else 0.25


class Numbers(ProgramTest):
    def diff(self, *arguments):
        return json.loads(self.assert_done("diff", *arguments, "--json").stdout)

    def test_equal_pictures(self):
        self.write("a.exr", exr(16, 16, ramp))
        self.write("a.png", grey_png(16, 16))
        for name in ("a.exr", "a.png"):
            same = self.diff(name, name)
            self.assertEqual(list(same), KEYS)
            self.assertTrue(same["identical"])
            self.assertIsNone(same["psnr_db"])
            self.assertEqual(same["ssim"], 1)
            for key in KEYS:
                if key not in ("psnr_db", "ssim", "identical") and not key.startswith("flip_exposure"):
                    self.assertEqual(same[key], 0, key)
            self.assertEqual(same["flip_exposure_count"] is None, name == "a.png")

    def test_known_differences(self):
        self.write("a.exr", exr(16, 16, lambda x, y: 0.5))
        self.write("b.exr", exr(16, 16, lambda x, y: 0.5 if (x, y) != (3, 4) else 2.5))
        error = self.diff("a.exr", "b.exr")
        # One pixel of 256: 0.7353570 (the sRGB curve at 0.5) becomes 1; 2 / 0.51 squared; 2 / 0.5.
        self.assertAlmostEqual(error["rmse"], (1 - 0.7353570) / 16, 7)
        self.assertAlmostEqual(error["mrse"], (2 / 0.51) ** 2 / 256, 9)
        self.assertEqual((error["max_abs"], error["max_rel"], error["rel_p50"], error["rel_p99"]), (2, 4, 0, 0))
        self.assertFalse(error["identical"])
        self.assertGreater(error["flip_max"], error["flip_mean"])
        self.assertLess(error["ssim"], 1)

    def test_a_png_against_an_exr(self):
        # 128 of 255 shows 0.2158605 linear. With a PNG for reference it is LDR-FLIP and display values.
        self.write("a.png", grey_png(16, 16))
        self.write("b.exr", exr(16, 16, lambda x, y: 0.2158605))
        for arguments, ldr in ((("a.png", "b.exr"), True), (("b.exr", "a.png"), False)):
            error = self.diff(*arguments)
            self.assertLess(error["rmse"], 1e-6)
            self.assertLess(error["flip_mean"], 1e-3)
            self.assertEqual(error["flip_exposure_start"] is None, ldr)

    def test_pixels_that_are_not_finite_are_counted(self):
        self.write("a.exr", exr(16, 16, ramp))
        self.write("b.exr", exr(16, 16, lambda x, y: {(2, 2): NAN, (3, 2): INFINITY}.get((x, y), ramp(x, y))))
        error = self.diff("a.exr", "b.exr", "-o", "map.png")
        self.assertEqual(error["nonfinite_px"], 2)
        self.assertEqual((error["rmse"], error["flip_max"], error["identical"]), (0, 0, False))
        self.write("nothing.exr", exr(16, 16, lambda x, y: NAN))
        nothing = self.diff("nothing.exr", "nothing.exr", "-o", "map.png")
        self.assertEqual((nothing["nonfinite_px"], nothing["rmse"], nothing["flip_mean"], nothing["identical"]),
                         (256, None, None, True))

    def test_table_and_map(self):
        self.write("a.exr", exr(16, 16, ramp))
        self.write("b.exr", exr(16, 16, lambda x, y: 0.5))
        lines = self.assert_done("diff", "a.exr", "b.exr", "-o", "map.png").stdout.splitlines()
        self.assertEqual([line.split()[0] for line in lines[2:]], KEYS)
        self.assertTrue((self.folder / "map.png").read_bytes().startswith(b"\x89PNG"))
        # The map is a picture of the same size: it can be compared again.
        self.assertFalse(self.diff("map.png", "a.exr")["identical"])


class BadInput(ProgramTest):
    def test_files(self):
        whole = exr(8, 8, ramp)
        bad = {
            "torn.png": (grey_png(8, 8)[:-20], "damaged"),
            "torn.exr": (whole[:-20], "damaged"),
            "head.exr": (whole[:60], "damaged"),
            "empty.exr": (b"", "not an OpenEXR file"),
            "text.png": ("text", "not a PNG file"),
            "text.exr": ("text", "not an OpenEXR file"),
            "an_exr.png": (whole, "not a PNG file"),
            "picture.jpg": (grey_png(8, 8), ".png, .exr"),
        }
        self.write("good.exr", whole)
        for name, (content, word) in bad.items():
            self.write(name, content)
            self.assert_refused(["diff", "good.exr", name, "-o", "map.png"], name, word)
            self.assert_refused(["diff", name, "good.exr", "--json"], name, word)
        self.assert_refused(["diff", "good.exr", "gone.exr"], "gone.exr")
        (self.folder / "folder.exr").mkdir()
        self.assert_refused(["diff", "good.exr", "folder.exr"], "folder.exr")

    def test_sizes(self):
        self.write("a.exr", exr(8, 8, ramp))
        self.write("b.exr", exr(8, 7, ramp))
        self.write("c.png", grey_png(7, 8))
        self.assert_refused(["diff", "a.exr", "b.exr"], "8x8", "8x7", "same size")
        self.assert_refused(["diff", "a.exr", "c.png"], "8x8", "7x8", "same size")

    def test_arguments(self):
        self.write("a.exr", exr(8, 8, ramp))
        self.assert_refused(["diff", "a.exr"], "test")
        self.assert_refused(["diff", "a.exr", "a.exr", "-o", "gone/map.png"], "gone/map.png")
        self.assert_refused(["diff", "a.exr", "a.exr", "-o", "map.jpg"], "map.jpg", ".png")


if __name__ == "__main__":
    unittest.main()
