"""scripts/check_floors.py: finds what is planted, in a tree of its own, and nothing else."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "check_floors.py"

CMAKE = """
lightsweep_room(base DIR renderer/base LINK fmt::fmt)
lightsweep_room(image DIR renderer/image LINK lightsweep_base PRIVATE PNG::PNG)
lightsweep_room(gl DIR renderer/gl LINK lightsweep_base
                PRIVATE lightsweep_glad)
lightsweep_room(frame DIR renderer/frame LINK lightsweep_gl)
lightsweep_room(metrics DIR bench/metrics LINK lightsweep_image)
lightsweep_room(measure DIR bench/measure LINK lightsweep_frame)
"""
# A house without fault.
FILES = {
    "CMakeLists.txt": CMAKE,
    "renderer/base/check.h": "#pragma once\n#include <string>\n",
    "renderer/image/image.h": '#include "renderer/base/check.h"\n',
    "renderer/gl/buffer.h": '#include "renderer/base/check.h"\n',
    "renderer/gl/provider_internal.h": "#include <EGL/egl.h>\n",
    "renderer/gl/buffer.cpp": '#include "renderer/gl/buffer.h"\n#include <glad/gl.h>\n',
    "renderer/frame/frame.h": '#include "renderer/gl/buffer.h"\n#include "shaders/shared/types.h"\n',
    "shaders/shared/types.h": "",
    "bench/metrics/rmse.cpp": '#include "renderer/image/image.h"\n',
    "bench/measure/arm.cpp": '#include "generated/build_info.h"\n#include "renderer/base/check.h"\n',
}


class CheckFloors(unittest.TestCase):
    def check(self, planted=None):
        """The lines printed for FILES with `planted` in place of, or beside, theirs."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {**FILES, **(planted or {})}.items():
                path = pathlib.Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            done = subprocess.run([sys.executable, SCRIPT, "--root", folder], capture_output=True, text=True, check=False)
        lines = done.stdout.splitlines()
        self.assertEqual(done.returncode, 1 if lines else 0, done.stderr)
        return lines

    def assert_found(self, planted, place, *words):
        lines = self.check(planted)
        self.assertEqual(len(lines), 1, lines)
        self.assertTrue(lines[0].startswith(place + ": "), lines[0])
        for word in words:
            self.assertIn(word, lines[0])

    def test_a_sound_house_has_no_fault(self):
        self.assertEqual(self.check(), [])

    def test_the_project_has_no_fault(self):
        done = subprocess.run([sys.executable, SCRIPT], capture_output=True, text=True, check=False)
        self.assertEqual((done.stdout, done.returncode), ("", 0))

    def test_an_include_that_goes_up(self):
        self.assert_found({"renderer/base/hash.cpp": '#include <string>\n#include "renderer/frame/frame.h"\n'},
                          "renderer/base/hash.cpp:2", "below renderer/frame")
        self.assert_found({"renderer/frame/frame.cpp": '#include "bench/measure/arm.h"\n'},
                          "renderer/frame/frame.cpp:1", "below bench/measure")

    def test_an_include_that_goes_sideways(self):
        self.assert_found({"renderer/image/png.cpp": '\n# include "renderer/gl/buffer.h"\n'},
                          "renderer/image/png.cpp:2", "one floor")

    def test_an_include_with_a_relative_path_hides_nothing(self):
        self.assert_found({"renderer/image/png.cpp": '#include "../gl/buffer.h"\n'},
                          "renderer/image/png.cpp:1", "renderer/gl/buffer.h")

    def test_an_include_of_a_lower_room_that_is_not_linked(self):
        self.assert_found({"bench/metrics/psnr.cpp": '#include "renderer/gl/buffer.h"\n'},
                          "bench/metrics/psnr.cpp:1", "does not link renderer/gl")

    def test_an_include_of_another_rooms_internal_header(self):
        self.assert_found({"renderer/frame/frame.cpp": '#include "renderer/gl/provider_internal.h"\n'},
                          "renderer/frame/frame.cpp:1", "own room")

    def test_gl_headers_outside_of_their_room(self):
        for header in ("glad/gl.h", "GL/gl.h", "EGL/egl.h", "GLES3/gl3.h"):
            self.assert_found({"renderer/frame/frame.cpp": f"#include <{header}>\n"},
                              "renderer/frame/frame.cpp:1", header, "stay in renderer/gl")

    def test_gl_headers_in_a_header_that_others_include(self):
        self.assert_found({"renderer/gl/query.h": "#include <glad/gl.h>\n"}, "renderer/gl/query.h:1", "_internal.h")

    def test_a_link_that_goes_up(self):
        self.assert_found({"CMakeLists.txt": CMAKE.replace("renderer/image LINK", "renderer/image LINK lightsweep_frame")},
                          "CMakeLists.txt:3", "room image links frame")

    def test_a_room_that_the_table_does_not_know(self):
        self.assert_found({"renderer/attic/box.cpp": ""}, "renderer/attic/box.cpp:1", "renderer/attic is in no floor")


if __name__ == "__main__":
    unittest.main()
