"""What the tests of the command line share: the program run in a folder of its own, and what a shell would see of it."""

import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("LIGHTSWEEP_PROGRAM", ROOT / "build/release/lightsweep"))
TIMEOUT_S = 200

DONE, VERDICT_FAILED, BAD_INPUT, REFUSED, CELLS_FAILED, INTERRUPTED = range(6)

# Whatever the build and the load of the machine: these tests look at the contract, not at the numbers.
RUN = ("run", "--allow-debug", "--timer", "finish_clock")


def script(name, *arguments):
    """Runs one of the project's scripts."""
    return subprocess.run([sys.executable, "-B", ROOT / "scripts" / name, *arguments], capture_output=True, text=True,
                          check=False, timeout=TIMEOUT_S)


def json_of(file):
    return json.loads(pathlib.Path(file).read_text(encoding="utf-8"))


def write_json(file, value):
    """Returns the file."""
    pathlib.Path(file).write_text(json.dumps(value), encoding="utf-8")
    return file


def journal_of(folder):
    """The complete lines of a run's journal."""
    file = pathlib.Path(folder, "journal.jsonl")
    text = file.read_text(encoding="utf-8") if file.exists() else ""
    return [json.loads(line) for line in text.split("\n")[:-1]]


def groups_of(folder):
    return [line["group"] for line in journal_of(folder) if line["kind"] == "group"]


def grey_png(width, height):
    """The bytes of a picture, all of it mid-grey (PNG specification, sections 5.3 and 11.2)."""
    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    rows = (b"\0" + b"\x80" * 3 * width) * height
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class ProgramTest(unittest.TestCase):
    """Each test works in an empty folder that is gone afterwards."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lightsweep-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        cache = tempfile.TemporaryDirectory(prefix="lightsweep-cache-")
        self.addCleanup(cache.cleanup)
        self.cache = cache.name  # of references: neither the user's own nor another test's

    def environment(self, **variables):
        """Without the user's own wishes."""
        kept = {name: value for name, value in os.environ.items() if name not in ("LIGHTSWEEP_DEVICE", "LIGHTSWEEP_HOME")}
        return kept | {"LIGHTSWEEP_CACHE": self.cache} | {name: str(value) for name, value in variables.items()}

    def without_gl(self):
        """An environment in which no GL driver can be loaded: EGL finds no vendor, and the OSMesa in reach is an empty file."""
        broken = self.folder / "broken"
        broken.mkdir(exist_ok=True)
        (broken / "libOSMesa.so.8").touch()
        return self.environment(LD_LIBRARY_PATH=broken, __EGL_VENDOR_LIBRARY_DIRS=self.folder / "nowhere",
                                __EGL_VENDOR_LIBRARY_FILENAMES="")

    def run_program(self, *arguments, environment=None, program=PROGRAM):
        return subprocess.run([program, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, errors="replace",
                              check=False, env=environment or self.environment(), timeout=TIMEOUT_S)

    def start_program(self, *arguments):
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, env=self.environment(),
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def write(self, name, content):
        """A file in the test's folder: text, bytes, or a value that becomes JSON."""
        file = self.folder / name
        if isinstance(content, bytes):
            file.write_bytes(content)
        else:
            file.write_text(content if isinstance(content, str) else json.dumps(content), encoding="utf-8")
        return name

    def files(self):
        return sorted(str(file.relative_to(self.folder)) for file in self.folder.rglob("*"))

    def assert_done(self, *arguments, code=DONE, **options):
        done = self.run_program(*arguments, **options)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done

    def assert_refused(self, arguments, *words, code=BAD_INPUT, **options):
        """One line on stderr that holds the words, nothing on stdout, the exit code, and no file left behind."""
        before = self.files()
        done = self.run_program(*arguments, **options)
        message = f"{arguments}: {done.returncode}\n{done.stdout}\n{done.stderr}"
        self.assertEqual(done.returncode, code, message)
        self.assertEqual(len(done.stderr.splitlines()), 1, message)
        self.assertTrue(done.stderr.startswith("lightsweep: "), message)
        self.assertEqual(done.stdout, "", message)
        for word in words:
            self.assertIn(str(word), done.stderr, message)
        self.assertEqual(self.files(), before, message)

    def assert_valid_report(self, file):
        checked = script("check_report.py", self.folder / file)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        return json_of(self.folder / file)
