"""Runs: what they leave on disk when they end, are interrupted or killed, and how their parts come together."""

import os
import signal
import time
import unittest

from program import DONE, INTERRUPTED, RUN, ProgramTest, groups_of, journal_of, json_of, script

# Twelve small groups; SLOW gives each a good part of a second, so that a signal finds some finished and some not.
PLAN = ("-a", "scene=cornell", "-a", "path=forward,deferred", "-a", "layout=oct32", "-a", "lights=pow2:0:5", "-a", "size=32x32,48x32")
QUICK = ("--time-budget", "0.1s", "--target-ci", "100%")
SLOW = ("--time-budget", "1h", "--target-ci", "0.0001%")
GROUPS = 12
WAIT_S = 120


class Runs(ProgramTest):
    def planned_ids(self, *more):
        lines = self.assert_done("run", *PLAN, *more, "--dry-run").stdout.splitlines()
        return [line.split()[0] for line in lines if line.startswith("  ")]

    def stopped(self, number, *arguments):
        """A slow run that got the signal once two groups were finished: (exit code, what it said, its groups before)."""
        process = self.start_program(*RUN, *PLAN, *SLOW, *arguments)
        end = time.monotonic() + WAIT_S
        while len(groups_of(self.folder / "out")) < 2 and time.monotonic() < end and process.poll() is None:
            time.sleep(0.005)
        before = groups_of(self.folder / "out")
        os.kill(process.pid, number)
        said = process.communicate(timeout=WAIT_S)[1]
        self.assertIn(len(before), range(2, GROUPS), said)
        return process.returncode, said, before

    def assert_samples_add_up(self, report):
        for cell in report["cells"]:
            samples = cell["samples"]
            self.assertGreater(len(samples["gpu_ns"]), 0)
            self.assertIn("unattributed", samples["passes"])
            self.assertEqual([sum(frame) for frame in zip(*samples["passes"].values())], samples["gpu_ns"], cell["name"])

    def test_a_dry_run_writes_nothing(self):
        ids = self.planned_ids("--out", "out")
        self.assertEqual(len(set(ids)), 2 * GROUPS)
        self.assertEqual(self.files(), [])

    def test_an_interrupted_run_ends_in_order_and_can_be_resumed(self):
        code, said, before = self.stopped(signal.SIGINT, "--out", "out")
        self.assertEqual(code, INTERRUPTED, said)
        self.assertIn("--resume", said)
        partial = self.assert_valid_report("out/report.json")
        self.assertEqual(partial["run"]["stopped_because"], "interrupted")
        self.assertFalse(partial["summary"]["complete"])
        lines = journal_of(self.folder / "out")
        self.assertEqual([line["group"] for line in lines[1:]][:len(before)], before)

        # A torn line at the end is what a crash leaves; the whole lines before it are kept as they are.
        with open(self.folder / "out/journal.jsonl", "a", encoding="utf-8") as journal:
            journal.write('{"kind": "group", "gro')
        self.assert_done(*RUN, *PLAN, *QUICK, "--out", "out", "--resume")
        self.assertEqual(journal_of(self.folder / "out")[:len(lines)], lines)
        self.assertEqual(len(set(groups_of(self.folder / "out"))), GROUPS)
        report = self.assert_valid_report("out/report.json")
        self.assertTrue(report["summary"]["complete"])
        self.assertEqual(report["run"]["stopped_because"], "complete")
        self.assertEqual([cell["id"] for cell in report["cells"]], self.planned_ids())
        self.assert_samples_add_up(report)

    def test_a_killed_run_leaves_every_finished_group(self):
        code, said, before = self.stopped(signal.SIGKILL, "--out", "out")
        self.assertEqual(code, -signal.SIGKILL, said)
        self.assertFalse((self.folder / "out/report.json").exists())
        self.assertEqual(groups_of(self.folder / "out")[:len(before)], before)

        self.assert_done("merge", "out/journal.jsonl", "-o", "report.json")
        report = self.assert_valid_report("report.json")
        self.assertEqual(list(dict.fromkeys(cell["group"] for cell in report["cells"])), groups_of(self.folder / "out"))
        self.assertEqual(report["summary"]["planned"], 2 * GROUPS)
        self.assertFalse(report["summary"]["complete"])
        self.assert_samples_add_up(report)

    def test_shards_come_together(self):
        for index in (1, 2):
            self.assert_done(*RUN, *PLAN, *QUICK, "--shard", f"{index}/2", "--out", f"part{index}")
        ids = [[cell["id"] for cell in self.assert_valid_report(f"part{index}/report.json")["cells"]] for index in (1, 2)]
        self.assertEqual(len(ids[0]) + len(ids[1]), 2 * GROUPS)
        self.assert_done("merge", "part1/journal.jsonl", "part2/journal.jsonl", "-o", "report.json")
        whole = self.assert_valid_report("report.json")
        self.assertEqual(sorted(cell["id"] for cell in whole["cells"]), sorted(self.planned_ids()))
        self.assertTrue(whole["summary"]["complete"])
        self.assertEqual(whole["run"]["shard"], {"index": 1, "count": 1})

        # What does not belong together is refused.
        self.assert_refused(["merge", "part1/journal.jsonl", "part1/journal.jsonl", "-o", "twice.json"], "already")
        self.assert_refused([*RUN, *PLAN, "--out", "part1"], "part1/journal.jsonl", "resume")
        self.assert_refused([*RUN, "-a", "scene=cornell", "-a", "lights=1", "--out", "part1", "--resume"], "part1/journal.jsonl", "plan")

        # A report against itself: nothing became slower.
        self.assert_done("compare", "report.json", "report.json", "--fail-on", "1", code=DONE)

        # The pictures of the whole.
        plotted = script("plot.py", self.folder / "report.json", "--out", self.folder / "pictures")
        self.assertEqual(plotted.returncode, 0, plotted.stderr)
        names = {f"{figure}_cornell.{kind}" for kind in ("png", "svg")
                 for figure in ("time_over_lights", "ratio_to_forward", "evaluations_over_lights", "time_per_pass",
                                                  "time_against_error", "field_errors")}
        self.assertEqual({path.name for path in (self.folder / "pictures").iterdir()}, names)
        self.assertEqual(len(plotted.stdout.splitlines()), len(names))
        self.assertIn("no flip_maps of cornell", plotted.stderr)


class SlowArms(ProgramTest):
    """Arms whose frame takes longer than asked for: drawn once, not sampled, not drawn with more lights, and no failure."""

    SLOW_PLAN = ("-a", "scene=cornell", "-a", "path=forward,deferred", "-a", "layout=oct32", "-a", "lights=1,4,16",
                 "-a", "size=32x32", "--max-frame", "0.001ms")

    def assert_slow(self, report):
        self.assertEqual({status: count for status, count in report["summary"]["counts"].items() if count},
                         {"timeout": 2, "skipped": 4})
        self.assertTrue(report["summary"]["complete"])
        self.assertAlmostEqual(report["run"]["max_frame_s"], 1e-6)
        for cell in report["cells"]:
            self.assertEqual(cell["too_slow_at_lights"], 1)
            self.assertEqual(cell["status"], "timeout" if cell["params"]["lights"] == 1 else "skipped")
            self.assertEqual(cell["error"] is not None, cell["status"] == "timeout")
            self.assertIn("s, more than the 1e-06 s allowed", cell["reason"])

    def test_too_slow_is_no_failure_and_is_remembered(self):
        done = self.assert_done(*RUN, *self.SLOW_PLAN, "--out", "out")
        self.assertIn("2 cells were too slow to sample; 4 with as many lights or more were not drawn", done.stdout)
        self.assert_slow(self.assert_valid_report("out/report.json"))

        # What goes on after the first group knows what it found, and does not draw the others to find it again.
        journal = self.folder / "out/journal.jsonl"
        journal.write_text("".join(journal.read_text(encoding="utf-8").splitlines(keepends=True)[:2]), encoding="utf-8")
        self.assert_done(*RUN, *self.SLOW_PLAN, "--out", "out", "--resume")
        self.assert_slow(self.assert_valid_report("out/report.json"))

    def test_a_sweep_may_say_it(self):
        blocks = [{"scene": "cornell", "lights": 4, "size": "32x32", "path": "forward"}]
        self.write("mine.json", {"summary": "s", "blocks": blocks, "max_frame_s": 1e-6})
        self.assert_done(*RUN, "mine.json", "--out", "slow")
        self.assertEqual(json_of(self.folder / "slow/report.json")["summary"]["counts"]["timeout"], 1)
        self.assert_done(*RUN, "mine.json", "--max-frame", "1000s", "--time-budget", "0.1s", "--out", "fast")
        self.assertEqual(json_of(self.folder / "fast/report.json")["summary"]["counts"]["ok"], 1)

    def test_bad_limits(self):
        for limit in ("slow", "0s", "-1s", "2h"):
            self.assert_refused([*RUN, f"--max-frame={limit}", "--out", "out"], f"--max-frame {limit}", "2s or 500ms")


class Answers(ProgramTest):
    """What a user came for: the cheapest arm within an error, the most exact one within a time."""

    SWEEP = {"summary": "three arms", "maps": True, "target_ci": 1.0,
             "blocks": [{"scene": "cornell", "lights": 4, "size": "64x48", "path": ["forward", "deferred"],
                         "layout": ["float32", "thin"]}]}

    def flip_mean(self, report):
        return {cell["id"]: cell["error"]["reference"]["display"]["flip_mean"] for cell in report["cells"]}

    def test_answers_and_maps(self):
        self.write("three.json", self.SWEEP)
        done = self.assert_done(*RUN, "three.json", "--max-error", "flip=1", "--max-time", "100s", "--out", "out")
        report = self.assert_valid_report("out/report.json")
        self.assertEqual(report["run"]["max_error"], {"metric": "flip_mean", "limit": 1})
        self.assertEqual(report["run"]["max_time_ns"], 100e9)
        cheapest, most_exact = report["answers"]
        times = {cell["id"]: cell["statistics"]["wall_ns"]["median"] for cell in report["cells"]}
        self.assertEqual({cheapest["arm"], cheapest["runner_up"]}, set(sorted(times, key=times.get)[:2]))
        self.assertLessEqual(cheapest["ratio"], 1)
        errors = self.flip_mean(report)
        self.assertEqual(errors[most_exact["arm"]], min(errors.values()))
        self.assertEqual([line.strip() for line in done.stdout.splitlines()][-2:],
                         [cheapest["statement"], most_exact["statement"]])

        self.assertEqual({file.name for file in (self.folder / "out/maps").iterdir()}, {f"{cell}.png" for cell in errors})
        plotted = script("plot.py", self.folder / "out/report.json")
        self.assertTrue((self.folder / "out/flip_maps_cornell.png").is_file(), plotted.stderr)

        # Another question needs no other frame.
        before = journal_of(self.folder / "out")
        self.assert_done(*RUN, "three.json", "--max-error", "rmse=0", "--out", "out", "--resume")
        self.assertEqual(journal_of(self.folder / "out"), before)
        none, again = self.assert_valid_report("out/report.json")["answers"]
        self.assertEqual((none["question"], none["arm"]), ({"metric": "rmse", "limit": 0}, None))
        self.assertIn("no arm is within rmse 0", none["reason"])
        self.assertEqual(again, most_exact)

    def test_without_questions_there_are_no_answers_and_without_maps_no_maps(self):
        self.write("three.json", self.SWEEP | {"maps": False})
        done = self.assert_done(*RUN, "three.json", "--out", "out")
        self.assertTrue(done.stdout.splitlines()[-1].startswith("report: "))
        self.assertEqual(self.assert_valid_report("out/report.json")["answers"], [])
        self.assertFalse((self.folder / "out/maps").exists())

    def test_bad_questions(self):
        for limit, word in (("flipp=0.1", "'flip'"), ("ssim=0.9", "known: flip"), ("=1", "known: flip"), ("flip", "flip=0.01"),
                            ("rmse=small", "METRIC=VALUE"), ("rmse=-1", "METRIC=VALUE"), ("mrse=nan", "METRIC=VALUE"),
                            ("max_abs=1x", "METRIC=VALUE")):
            self.assert_refused([*RUN, "--max-error", limit, "--out", "out"], f"--max-error {limit}", word)
        for time_limit in ("8", "8m", "fast", "-8ms", "0ms"):
            self.assert_refused([*RUN, f"--max-time={time_limit}", "--out", "out"], "--max-time", "8ms, 500us or 0.02s")


class Smoke(ProgramTest):
    def test_the_smoke_sweep_runs_everything_once(self):
        self.assert_done(*RUN, "smoke", "--time-budget", "0.1s", "--out", "out")
        report = self.assert_valid_report("out/report.json")
        self.assertTrue(report["summary"]["complete"])
        self.assertEqual(report["summary"]["counts"]["ok"], len(report["cells"]))
        for axis, what in (("scene", "scenes"), ("path", "paths"), ("layout", "layouts")):
            listed = self.assert_done("list", what).stdout.splitlines()[2:]
            self.assertEqual({line.split()[0] for line in listed}, {cell["params"][axis] for cell in report["cells"]} - {None})
        self.assertEqual({cell["params"]["hdr"] for cell in report["cells"]}, {"rgba16f", "rgba32f", "r11g11b10f"})
        self.assertLessEqual({"cpu", "compute"}, {cell["params"]["light_lists"] for cell in report["cells"]})
        self.assert_checks_find_faults(json_of(self.folder / "out/report.json"))

    def assert_checks_find_faults(self, report):
        """The check of reports is worth something: it finds what is planted."""
        text = (self.folder / "out/report.json").read_text(encoding="utf-8")
        planted = {"nan": text.replace('"schema"', '"x": NaN, "schema"', 1), "torn": text[:-10]}
        cell = report["cells"][0]
        cell["samples"]["gpu_ns"][0] += 1
        self.write("sum.json", report)
        cell["samples"]["gpu_ns"][0] -= 1
        cell["status"] = "fine"
        self.write("status.json", report)
        for name, content in planted.items():
            self.write(f"{name}.json", content)
        for name in (*planted, "sum", "status"):
            checked = script("check_report.py", self.folder / f"{name}.json")
            self.assertEqual(checked.returncode, 1, name)
            self.assertIn(f"{name}.json:", checked.stdout)


if __name__ == "__main__":
    unittest.main()
