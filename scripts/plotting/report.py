"""A report as the pictures want it: the cells that were measured, by scene, panel and arm."""

import json
import pathlib
from typing import NamedTuple

SCHEMA = "lightsweep-report-2"
PARTS = {"run": dict, "environment": dict, "timer": dict, "noise": dict, "cells": list, "pairs": list,
         "crossovers": list, "pareto": list}
EVERY_SKIP = "all"
GUARDED = "on"
PLAIN_SUMS = "plain"


class ReportError(Exception):
    """The file is no report that can be drawn; the message says where and why."""


class Arm(NamedTuple):
    """What tells two cells of a group apart."""

    path: str
    layout: str | None
    hdr: str
    light_lists: str | None = None
    skip: str = EVERY_SKIP
    guards: str = GUARDED
    sums: str = PLAIN_SUMS


class Panel(NamedTuple):
    """What one axes shows."""

    width_px: int
    height_px: int
    overlap: float | None

    @property
    def title(self):
        regime = "" if self.overlap is None else f", {self.overlap:g} lights per point"
        return f"{self.width_px}\u00d7{self.height_px}{regime}"


def read_json(path):
    try:
        return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    except OSError as error:
        raise ReportError(f"{path}: {error.strerror}") from error
    except ValueError as error:
        raise ReportError(f"{path}: not JSON: {error}") from error


def load(path):
    report = read_json(path)
    if not isinstance(report, dict) or report.get("schema") != SCHEMA:
        found = report.get("schema") if isinstance(report, dict) else None
        raise ReportError(f"{path}:/schema: '{SCHEMA}' was expected, not {json.dumps(found)}; measure again")
    for key, kind in PARTS.items():
        if not isinstance(report.get(key), kind):
            raise ReportError(f"{path}:/{key}: {'an object' if kind is dict else 'a list'} was expected")
    return report


def name_of(value):
    """The key of a scene or layout, or the stem of the file it is."""
    return pathlib.Path(value).stem


def arm_of(params):
    return Arm(params["path"], params["layout"], params["hdr"], params.get("light_lists"), params.get("skip", EVERY_SKIP),
               params.get("guards", GUARDED), params.get("sums", PLAIN_SUMS))


def switches_of(arm):
    """The words that tell an arm from the same one with every default: none for most."""
    return ["unguarded"] * (arm.guards != GUARDED) + [f"{arm.sums} sums"] * (arm.sums != PLAIN_SUMS)


def panel_of(params):
    return Panel(params["width_px"], params["height_px"], params["overlap"])


def measured(report):
    return [cell for cell in report["cells"] if cell["status"] == "ok"]


def scenes(report):
    """{scene: its measured cells}, in the report's order."""
    by_scene = {}
    for cell in measured(report):
        by_scene.setdefault(cell["params"]["scene"], []).append(cell)
    return by_scene


def without_single_skips(cells):
    """Those with a whole set of skips, or with none: what single skips do has a picture of its own. All where there are no others."""
    return [cell for cell in cells if not set("+-") & set(arm_of(cell["params"]).skip)] or cells


def panels(cells):
    """{panel: its cells}, small pictures first. What two groups measured alike (a scene's own regime, and the same one asked
    for) stands once."""
    by_panel = {}
    for cell in cells:
        params = cell["params"]
        by_panel.setdefault(panel_of(params), {}).setdefault((arm_of(params), params["lights"]), cell)
    order = sorted(by_panel, key=lambda panel: (panel.overlap or 0, panel.width_px * panel.height_px))
    return {panel: list(by_panel[panel].values()) for panel in order}


def light_counts(cells):
    """Those that were measured, rising."""
    return sorted({cell["params"]["lights"] for cell in cells})


def with_lights(cells, count):
    return [cell for cell in cells if cell["params"]["lights"] == count]


def most_lights(cells):
    """The cells with the largest light count among `cells`."""
    return with_lights(cells, light_counts(cells)[-1])


def filled(middle, low, high):
    """An estimate whose open ends are closed at its middle, so that they show no interval."""
    return middle, middle if low is None else low, middle if high is None else high


def estimate_ms(estimate_ns):
    """(median, low, high) of a statistic in ns, in ms."""
    return tuple(value / 1e6 for value in filled(*(estimate_ns[key] for key in ("median", "low", "high"))))


def image_error(cell, metric):
    """(value, low, high) of the display picture against the reference, or None where there is none. FLIP's mean alone has an
    interval; elsewhere the ends are the value."""
    error = cell["error"]
    value = error and error["reference"] and error["reference"]["display"][metric]
    if value is None:
        return None
    return filled(value, error["flip_mean_low"], error["flip_mean_high"]) if metric == "flip_mean" else (value, value, value)


def front_states(report, cells, metric):
    """{cell id: front, perhaps or dominated} as the report's `pareto` has it. That is of FLIP's mean: for another error the
    front is drawn anew, and only the verdicts in `pairs` say which arm is surely beaten."""
    if metric == "flip_mean":
        return {point["id"]: point["state"] for entry in report["pareto"] for point in entry["points"]}
    error_of = {cell["id"]: image_error(cell, metric)[0] for cell in cells}
    on_front = front([(estimate_ms(cell["statistics"]["wall_ns"])[0], error_of[cell["id"]]) for cell in cells])
    states = {cell["id"]: "front" if index in on_front else "perhaps" for index, cell in enumerate(cells)}
    opposite = {"faster": "slower", "slower": "faster"}
    for pair in report["pairs"]:
        a, b, verdict = pair["a"], pair["b"], pair["verdict"]
        for winner, loser, judged in ((a, b, verdict), (b, a, opposite.get(verdict, verdict))):
            if winner not in states or states.get(loser) != "perhaps" or error_of[winner] > error_of[loser]:
                continue
            if judged == "faster" or (judged == "same" and error_of[winner] < error_of[loser]):
                states[loser] = "dominated"
    return states


def front(points):
    """The indices of the points (time, error) that no other is as good as in both and better than in one, by rising time."""
    beaten = [any(other != point and other[0] <= point[0] and other[1] <= point[1] for other in points) for point in points]
    return sorted((index for index, is_beaten in enumerate(beaten) if not is_beaten), key=lambda index: points[index])


def arm_names(arms):
    """{arm: label}: as much of each arm as is needed to tell it from the others."""
    arms = list(dict.fromkeys(arms))
    several_layouts = len({arm.layout for arm in arms if arm.layout}) > 1
    several_hdr = len({arm.hdr for arm in arms}) > 1
    several_lists = len({arm.light_lists for arm in arms if arm.light_lists}) > 1
    several_skips = len({arm.skip for arm in arms}) > 1
    names = {}
    for arm in arms:
        words = [arm.path]
        if arm.layout and several_layouts:
            words.append(name_of(arm.layout))
        if arm.light_lists and several_lists:
            words.append(f"{arm.light_lists} lists")
        if several_hdr:
            words.append(arm.hdr)
        if several_skips:
            words.append(f"skip {arm.skip}")
        words += switches_of(arm)
        names[arm] = ", ".join(words)
    return names
