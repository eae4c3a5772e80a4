"""The installed program finds its shaders and scenes beside itself, wherever it is called from."""

import os
import subprocess
import sys
import unittest

from program import ROOT, ProgramTest

BUILD = os.environ.get("LIGHTSWEEP_BUILD", ROOT / "build/release")


class Installed(ProgramTest):
    def test_it_stands_alone(self):
        prefix = self.folder / "prefix"
        subprocess.run(["cmake", "--install", BUILD, "--prefix", prefix], check=True, capture_output=True)
        program = prefix / "bin/lightsweep"
        data = prefix / "share/lightsweep"
        # A scene that only the installed data has shows whose data is read.
        (data / "scenes/only_here.json").write_bytes((data / "scenes/cornell.json").read_bytes())
        self.assertIn("only_here", self.assert_done("list", "scenes", program=program).stdout)
        self.assert_done("run", "smoke", "--dry-run", program=program)
        for name, which in (("installed", program), ("built", None)):
            options = {"program": which} if which else {}
            self.assert_done("render", "--scene", "cornell", "--size", "32x32", "--device", "surfaceless", "-o", f"{name}.png", **options)
        self.assertEqual(*((self.folder / f"{name}.png").read_bytes() for name in ("installed", "built")))
        for name in ("plot.py", "plot_stress.py"):
            plot = subprocess.run([sys.executable, "-B", data / "scripts" / name, "--help"], capture_output=True, text=True,
                                  check=False)
            self.assertEqual(plot.returncode, 0, plot.stderr)


if __name__ == "__main__":
    unittest.main()
