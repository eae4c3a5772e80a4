"""Bad input: one line that names the place, what is wrong and what is allowed; exit code 2; nothing half-written."""

import copy
import itertools
import unittest

from program import ROOT, ProgramTest, grey_png, json_of

SWEEP = {"summary": "a sweep", "blocks": [{"scene": "cornell", "lights": 1, "size": "32x32"}]}
SCENE = json_of(ROOT / "scenes/cornell.json")
LAYOUT = json_of(ROOT / "shaders/gbuffer/layouts/oct32.json")

# Every way in which a file is no JSON, and what is said of it.
NO_JSON = {
    "torn": ('{"summary": "x",', ":1:"),
    "empty": ("", ":1:1"),
    "binary": (b"\xff\xfe\x00\x01", ":1:1"),
    "nan": ('{"summary": "x",\n "blocks": NaN}', ":2:"),
    "list": ("[]", "object"),
}


def changed(json, path, value):
    """A copy with the value at `path` replaced, or set where there was none; None takes it out."""
    result = copy.deepcopy(json)
    place = result
    for step in path[:-1]:
        place = place[step]
    if value is None:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return result


class Usage(ProgramTest):
    def test_no_or_unknown_command(self):
        self.assert_refused([], "subcommand")
        self.assert_refused(["rum"], "unknown command 'rum'", "did you mean 'run'")

    def test_unknown_option(self):
        for command in ("list", "doctor", "run", "render", "diff", "compare", "merge"):
            self.assert_refused([command, "--frobnicate"], "--help")

    def test_unknown_list(self):
        self.assert_refused(["list", "path"], "'path'", "did you mean 'paths'")


class Axes(ProgramTest):
    def assert_axis_refused(self, axis, *words):
        self.assert_refused(["run", "-a", axis, "--dry-run"], *words)

    def test_unknown_names_with_the_nearest(self):
        self.assert_axis_refused("light=1", "'light'", "did you mean 'lights'", "size")
        self.assert_axis_refused("scene=cornel", "'cornel'", "did you mean 'cornell'", "atrium")
        self.assert_axis_refused("path=deffered", "'deffered'", "did you mean 'deferred'", "forward_prepass")
        self.assert_axis_refused("layout=oct33", "'oct33'", "did you mean 'oct32'", "packed")
        self.assert_axis_refused("hdr=rgba8", "rgba8", "rgba16f")

    def test_numbers(self):
        for lights in ("-1", "nan", "inf", "1.5", "x", "99999999999", "", "pow2:3:1", "pow2:0:99", "pow2:a:b"):
            self.assert_axis_refused(f"lights={lights}", "lights", "allowed")
        for size in ("-640x360", "640x-360", "0x0", "640", "640x", "640x360x2", "nanxnan", "99999999x1"):
            self.assert_axis_refused(f"size={size}", "size", "allowed")
        for overlap in ("nan", "inf", "-1", "0", "x"):
            self.assert_axis_refused(f"overlap={overlap}", "overlap", "allowed")

    def test_form(self):
        self.assert_axis_refused("lights", "axis=values")
        self.assert_refused(["run", "-a", "lights=1", "-a", "lights=2", "--dry-run"], "twice")


class RunOptions(ProgramTest):
    def assert_option_refused(self, option, value, *words):
        self.assert_refused(["run", option, value, "--dry-run"], *words)

    def test_quantities(self):
        for duration in ("soon", "nan", "inf", "-3s", "0", "3 days"):
            self.assert_option_refused("--time-budget", duration, "--time-budget", duration, "90s")
        for share in ("nan", "-1%", "0", "2 percent"):
            self.assert_option_refused("--target-ci", share, "--target-ci", share, "2%")
        self.assert_option_refused("--seed", "x", "--seed")
        self.assert_option_refused("--seed", "-1", "--seed")

    def test_filter(self):
        self.assert_option_refused("--filter", "(", "filter '('", "not a regular expression")
        self.assert_option_refused("--filter", "no such cell", "matches none", "scene=")

    def test_shard(self):
        for shard in ("0/2", "3/2", "1", "a/b", "1/2/3", "-1/2"):
            self.assert_option_refused("--shard", shard, shard, "INDEX/COUNT")
        self.assert_refused(["run", "-a", "scene=cornell", "-a", "lights=1", "--shard", "900/1000", "--dry-run"], "fewer shards")

    def test_timer(self):
        self.assert_option_refused("--timer", "finish_clok", "did you mean 'finish_clock'", "timestamp")


class Files(ProgramTest):
    """Sweeps, scenes, layouts and glTF files of the user."""

    def test_missing(self):
        self.assert_refused(["run", "gone.json"], "gone.json", "no such file")
        self.assert_refused(["run", "gone"], "unknown sweep 'gone'", "default")
        for axis in ("scene=gone.json", "scene=gone.gltf", "scene=gone.glb"):
            self.assert_refused(["run", "-a", axis, "--out", "out"], "gone", "no such file")
        self.assert_refused(["run", "-a", "scene=cornell", "-a", "layout=gone.json", "--out", "out"], "gone.json", "no such file")
        self.assert_refused(["render", "--scene", "gone.glb", "-o", "a.png"], "gone.glb", "no such file")

    def test_no_json(self):
        for name, (content, place) in NO_JSON.items():
            file = self.write(f"{name}.json", content)
            self.assert_refused(["run", file, "--out", "out"], file, place)
            self.assert_refused(["run", "-a", f"scene={file}", "--out", "out"], file, place)
            self.assert_refused(["run", "-a", "scene=cornell", "-a", f"layout={file}", "--out", "out"], file, place)
            self.assert_refused(["render", "--scene", file, "-o", "a.png"], file, place)
            self.assert_refused(["render", "--scene", "cornell", "--layout", file, "-o", "a.png"], file, place)

    def test_a_folder_is_no_file(self):
        (self.folder / "folder.json").mkdir()
        self.assert_refused(["run", "folder.json"], "folder.json", "folder")
        self.assert_refused(["render", "--scene", "folder.json", "-o", "a.png"], "folder.json", "folder")

    def test_sweep(self):
        for path, value, words in (
            (["blocks", 0, "light"], 3, ("/blocks/0", "'light'", "lights")),
            (["blok"], [], ("unknown key 'blok'", "blocks")),
            (["blocks"], None, ("blocks",)),
            (["blocks"], [], ("/blocks",)),
            (["blocks"], 3, ("/blocks", "list")),
            (["blocks", 0, "size"], "-1x5", ("/blocks/0/size", "-1x5", "allowed")),
            (["blocks", 0, "lights"], "nan", ("/blocks/0/lights", "nan")),
            (["blocks", 0, "path"], "forwrad", ("/blocks/0/path", "did you mean 'forward'")),
            (["time_budget_s"], -1, ("/time_budget_s",)),
            (["target_ci"], "2%", ("/target_ci", "number")),
        ):
            file = self.write("sweep.json", changed(SWEEP, path, value))
            self.assert_refused(["run", file, "--dry-run"], "sweep.json", *words)

    def test_scene(self):
        for path, value, words in (
            (["materal"], {}, ("unknown key 'materal'", "did you mean 'materials'")),
            (["camera"], None, ("camera",)),
            (["camera", "fov_y_deg"], -5, ("/camera/fov_y_deg",)),
            (["camera", "eye"], [0, 1], ("/camera/eye",)),
            (["camera", "near"], "x", ("/camera/near", "number")),
            (["instances", 0, "shape"], "wal", ("/instances/0", "'wal'", "did you mean 'wall'")),
            (["instances", 0, "material"], "pink", ("/instances/0", "'pink'", "white")),
            (["materials", "white", "model"], "lambret", ("/materials/white", "did you mean 'lambert'")),
            (["materials", "white", "base_color"], [2, 0, 0], ("/materials/white/base_color",)),
            (["lights", "default_count"], -1, ("/lights/default_count",)),
            (["lights", "generator", "placement"], "gird", ("/lights/generator/placement", "did you mean 'grid'")),
            (["lights", "generator", "radius"], 0, ("/lights/generator/radius",)),
        ):
            file = self.write("scene.json", changed(SCENE, path, value))
            self.assert_refused(["render", "--scene", file, "--size", "32x32", "-o", "a.png"], "scene.json", *words)
        file = self.write("scene.json", changed(SCENE, ["instances", 0], {"gltf": "gone.gltf"}))
        self.assert_refused(["render", "--scene", file, "--size", "32x32", "-o", "a.png"], "gone.gltf")

    def test_layout(self):
        for path, value, words in (
            (["target"], [], ("unknown key 'target'", "did you mean 'targets'")),
            (["depth", "convention"], "revrsed", ("/depth/convention", "did you mean 'reversed'")),
            (["targets", 0, "format"], "RGBA9", ("/targets/0/format", "'RGBA9'", "RGBA8")),
            (["targets", 1, "fields", 0, "encoding"], "octo", ("/targets/1/fields/0", "'octo'", "oct")),
            (["targets", 1, "fields", 0, "field"], "normla", ("/targets/1/fields/0", "did you mean 'normal'")),
            (["targets", 1, "fields", 0, "in"], "xyz", ("/targets/1/fields/0",)),
        ):
            file = self.write("layout.json", changed(LAYOUT, path, value))
            self.assert_refused(["render", "--scene", "cornell", "--layout", file, "--size", "32x32", "-o", "a.png"],
                                "layout.json", *words)

    def test_gltf(self):
        for name, content, word in (
            ("text.gltf", "this is no glTF", "text.gltf"),
            ("nothing.gltf", {"asset": {"version": "2.0"}}, "triangles"),
            ("empty.glb", b"", "empty.glb"),
            ("noise.glb", bytes(range(256)), "noise.glb"),
            ("torn.glb", b"glTF\x02\x00\x00\x00\xff\xff\x00\x00", "torn.glb"),
        ):
            file = self.write(name, content)
            self.assert_refused(["render", "--scene", file, "--size", "32x32", "-o", "a.png"], file, word)


class Pictures(ProgramTest):
    def test_render_options(self):
        for option, value, words in (
            ("--view", "normals", ("'normals'", "did you mean 'normal'", "base_color")),
            ("--path", "foward", ("did you mean 'forward'",)),
            ("--layout", "oct3", ("did you mean 'oct32'",)),
            ("--scene", "cornel", ("did you mean 'cornell'",)),
            ("--lights", "-1", ("lights=-1", "allowed")),
            ("--lights", "nan", ("lights=nan", "allowed")),
            ("--size", "0x5", ("size=0x5", "allowed")),
            ("--hdr", "rgba8", ("hdr=rgba8", "rgba16f")),
            ("--overlap", "nan", ("overlap=nan", "allowed")),
            ("--device", "egl", ("'egl'", "egl:N")),
            ("--require-renderer", "(", ("--require-renderer", "regular expression")),
        ):
            options = {"--scene": "cornell", "--size": "32x32", "-o": "a.png", option: value}
            self.assert_refused(["render", *itertools.chain(*options.items())], *words)

    def test_render_output(self):
        self.assert_refused(["render", "--scene", "cornell"], "--output")
        self.assert_refused(["render", "--scene", "cornell", "-o", "a.jpg"], "a.jpg", ".png or .exr")
        self.assert_refused(["render", "--scene", "cornell", "--size", "32x32", "-o", "gone/a.png"], "gone/a.png")

    def test_diff(self):
        self.write("grey.png", grey_png(8, 8))
        self.write("torn.png", grey_png(8, 8)[:-20])
        self.write("small.png", grey_png(4, 4))
        self.write("empty.png", b"")
        self.write("text.txt", "text")
        for test, word in (("gone.png", "gone.png"), ("torn.png", "torn.png"), ("empty.png", "empty.png"), ("text.txt", ".exr"),
                           ("small.png", "8x8")):
            self.assert_refused(["diff", "grey.png", test, "-o", "map.png"], word)


class Reports(ProgramTest):
    def test_compare(self):
        self.write("other.json", {"schema": "another-1"})
        self.write("torn.json", "{")
        for file, word in (("gone.json", "gone.json"), ("torn.json", "torn.json"), ("other.json", "lightsweep-report-2")):
            self.assert_refused(["compare", file, file], word)

    def test_merge(self):
        self.write("empty.jsonl", "")
        self.write("torn.jsonl", '{"kind": "run", "ru')
        self.write("other.jsonl", '{"kind": "walk"}\n')
        for file in ("gone.jsonl", "empty.jsonl", "torn.jsonl", "other.jsonl"):
            self.assert_refused(["merge", file, "-o", "report.json"], file)


if __name__ == "__main__":
    unittest.main()
