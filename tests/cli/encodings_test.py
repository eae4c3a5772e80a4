"""lightsweep encodings from the outside: the table's contract, its numbers' order, and what docs/layouts.md says of the layouts."""

import json
import math
import re
import unittest

from program import REFUSED, ROOT, ProgramTest

MILLION = 1 << 20


class Encodings(ProgramTest):
    listed = None

    def measured(self):
        """All of them, measured once."""
        if Encodings.listed is None:
            Encodings.listed = json.loads(self.assert_done("encodings", "--json").stdout)["encodings"]
        return Encodings.listed

    def named(self, field):
        return {e["name"]: e for e in self.measured() if e["field"] == field}

    def test_every_entry_has_its_keys(self):
        units = {"normal": "deg", "depth": "rel", "position": "rel", "emissive": "rel"}
        names = [(e["field"], e["name"]) for e in self.measured()]
        self.assertEqual(len(names), len(set(names)))
        for e in self.measured():
            self.assertEqual(e["samples"], MILLION, e)
            self.assertIn(e["bits"], range(1, 129))
            unit = units.get(e["field"], "abs")
            mean, p99, most = (e[f"{which}_{unit}"] for which in ("mean", "p99", "max"))
            self.assertTrue(0 <= mean <= most and 0 <= p99 <= most and math.isfinite(most), e)
            for what in ("encode", "decode"):
                time, low, high = (e[f"{what}{end}_ns_per_px"] for end in ("", "_low", "_high"))
                self.assertGreater(time, 0)
                self.assertTrue((low is None or 0 < low <= time) and (high is None or high >= time), e)
            self.assertNotEqual(e["domain"], "")

    def test_what_is_measured(self):
        normals = self.named("normal")
        for encoding in ("oct", "oct_precise", "hemi_oct", "spheremap", "xy_z"):
            for bits in (8, 10, 12, 16):
                self.assertEqual(normals[f"{encoding}_{bits}_{bits}"]["bits"], 2 * bits)
        for name, bits in (("unorm_8_8_8", 24), ("unorm_10_10_10", 30), ("snorm_8_8_8", 24), ("half_16_16_16", 48), ("best_fit_8_8_8", 24)):
            self.assertEqual(normals[name]["bits"], bits)
        for name, e in normals.items():
            self.assertEqual(e["domain"], "hemisphere" if name.startswith(("hemi_oct", "xy_z")) else "sphere")
        self.assertEqual(set(self.named("depth")), {f"{depth}_{convention}{clip}" for depth in ("d16", "d24", "d32f")
                                                   for convention in ("standard", "reversed") for clip in ("", "_no_clip_control")})

        for name, e in self.named("base_color").items():
            self.assertEqual("patches of 64 px" in e["domain"], name.startswith("ycocg"), e)

    def test_more_bits_err_less(self):
        normals = self.named("normal")
        for encoding in ("oct", "oct_precise", "hemi_oct", "spheremap", "xy_z"):
            means = [normals[f"{encoding}_{bits}_{bits}"]["mean_deg"] for bits in (8, 10, 12, 16)]
            self.assertEqual(means, sorted(means, reverse=True), encoding)
        for bits in (8, 10, 12, 16):
            plain, precise = (normals[f"{encoding}_{bits}_{bits}"] for encoding in ("oct", "oct_precise"))
            self.assertLess(precise["mean_deg"], plain["mean_deg"])
            self.assertLessEqual(precise["max_deg"], plain["max_deg"])
        # Cigolle et al. 2014, JCGT 3(2).
        for name, mean in (("oct_8_8", 0.33709), ("snorm_8_8_8", 0.17015), ("oct_10_10", 0.08380), ("oct_12_12", 0.02091)):
            self.assertAlmostEqual(normals[name]["mean_deg"] / mean, 1, delta=0.01)

    def test_reversed_float_depth_shines_with_clip_control_alone(self):
        depth = {name: e["mean_rel"] for name, e in self.named("depth").items()}
        self.assertLess(depth["d32f_reversed"] * 100, min(error for name, error in depth.items() if name != "d32f_reversed"))

    def test_one_field_as_a_table(self):
        text = self.assert_done("encodings", "--field", "model").stdout
        self.assertRegex(text, r"(?m)^id_2 +2 +0 +0 +0 ")
        self.assertNotIn("oct_8_8", text)
        self.assertIn(str(MILLION), text)

    def test_mistakes(self):
        self.assert_refused(["encodings", "--field", "normla"], "'normla'", "did you mean 'normal'")
        self.assert_refused(["encodings", "--device", "osmsa"], "did you mean 'osmesa'")
        self.assert_refused(["encodings"], "OpenGL 4.5", code=REFUSED, environment=self.without_gl())


class Documentation(ProgramTest):
    TEXT = (ROOT / "docs/layouts.md").read_text(encoding="utf-8")

    def rows(self, header):
        """The cells of every table whose first line starts with this."""
        inside = False
        for line in self.TEXT.splitlines():
            if line.startswith(header):
                inside = True
            elif not line.startswith("|"):
                inside = False
            elif inside and not line.startswith("|-"):
                yield [cell.strip() for cell in line.strip("|").split("|")]

    def test_bytes_per_pixel_of_every_layout(self):
        told = {row[0].strip("`"): int(row[1]) for row in self.rows("| layout | B/px |")}
        listed = {e["key"]: e["bytes_per_px"] for e in json.loads(self.assert_done("list", "layouts", "--json").stdout)}
        self.assertEqual(told, listed)

    def test_every_encoding(self):
        told = {name for row in self.rows("| encoding | for |") for name in re.findall(r"`(\w+)`", row[0])}
        self.assertEqual(told, {e["key"] for e in json.loads(self.assert_done("list", "encodings", "--json").stdout)})


if __name__ == "__main__":
    unittest.main()
