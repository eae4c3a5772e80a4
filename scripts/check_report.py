#!/usr/bin/env python3
"""Checks reports and stress runs: strict JSON, their schema in results/, and what no schema can say (sums, lengths, references).

Usage: check_report.py REPORT...      prints each fault as `file:/pointer: what`; exit code 1 if there is any, 2 on bad usage.
Debian: python3-jsonschema.
"""

import argparse
import collections
import json
import pathlib
import sys

import jsonschema

RESULTS = pathlib.Path(__file__).resolve().parent.parent / "results"
STRESS = "lightsweep-stress-1"
MAX_FAULTS_SHOWN = 20
FRONT_STATES = ("front", "perhaps", "dominated")


def strict_json(text):
    """Python reads NaN and Infinity, and takes the last of two equal keys; JSON has neither."""

    def refuse_constant(token):
        raise ValueError(f"{token} is not JSON")

    def refuse_duplicates(pairs):
        keys = collections.Counter(key for key, _ in pairs)
        twice = [key for key, count in keys.items() if count > 1]
        if twice:
            raise ValueError(f"the key '{twice[0]}' stands twice in one object")
        return dict(pairs)

    return json.loads(text, parse_constant=refuse_constant, object_pairs_hook=refuse_duplicates)


def schema_faults(report, schema):
    for error in jsonschema.Draft202012Validator(schema).iter_errors(report):
        yield "/" + "/".join(str(part) for part in error.absolute_path), error.message[:300]


def sample_faults(cell, where):
    samples = cell["samples"]
    count = len(samples["wall_ns"])
    series = {key: samples[key] for key in ("round", "cpu_ns", "gpu_ns")}
    series |= {f"passes/{name}": values for name, values in samples["passes"].items()}
    for key, values in series.items():
        if len(values) != count:
            yield f"{where}/samples/{key}", f"{len(values)} samples, but wall_ns has {count}"
            return
    if count == 0:
        if cell["status"] == "ok":
            yield f"{where}/samples", "status is ok, but there is no sample"
        return
    if "unattributed" not in samples["passes"]:
        yield f"{where}/samples/passes", "unattributed is missing"
    for frame, gpu_ns in enumerate(samples["gpu_ns"]):
        total = sum(values[frame] for values in samples["passes"].values())
        if total != gpu_ns:
            yield f"{where}/samples/gpu_ns/{frame}", f"is {gpu_ns}, but the passes sum to {total}"
            return
    for key in ("cpu_ns", "gpu_ns", "wall_ns"):
        statistics = (cell["statistics"] or {}).get(key)
        if statistics and (statistics["count"], statistics["min"], statistics["max"]) != (
            count, min(samples[key]), max(samples[key])):
            yield f"{where}/statistics/{key}", "count, min or max is not that of the samples"


def lost_faults(cell, where):
    params = cell["params"]
    if cell["error"] and not cell["error"]["lost_px"] <= params["width_px"] * params["height_px"]:
        yield f"{where}/error/lost_px", "is more than the picture has pixels"


def display_error(cell, metric):
    """Against the reference; None where there is none."""
    error = cell["error"] and cell["error"]["reference"]
    return error and error["display"][metric]


def front_faults(pareto, error_of, floor_known, where):
    points = {point["id"]: (point["time_ns"], point["error"]) for point in pareto["points"]}
    members = [member for state in FRONT_STATES for member in pareto[state]]
    if sorted(members) != sorted(point["id"] for point in pareto["points"]) or len(points) != len(members):
        yield where, "front, perhaps and dominated together are not the points, each once"
        return
    for index, point in enumerate(pareto["points"]):
        if point["id"] not in pareto[point["state"]]:
            yield f"{where}/points/{index}/state", f"is {point['state']}, but the cell is not in that list"
        if point["error"] != error_of[point["id"]]:
            yield f"{where}/points/{index}/error", f"is {point['error']}, but the cell's is {error_of[point['id']]}"
        # The error's interval is around the mean of the picture's regions, which need not be equally large.
        for key, parts in (("time_ns", ("time_low_ns", "time_ns", "time_high_ns")), ("error", ("error_low", "error_high"))):
            known = [point[part] for part in parts if point[part] is not None]
            if known != sorted(known):
                yield f"{where}/points/{index}/{key}", "is not within its interval"

    def beaten(point):
        return any(other != point and other[0] <= point[0] and other[1] <= point[1] for other in points.values())

    for state in FRONT_STATES:
        for index, member in enumerate(pareto[state]):
            if beaten(points[member]) == (state == "front"):
                yield f"{where}/{state}/{index}", f"is {'beaten in both' if state == 'front' else 'beaten by none'}"
    if pareto["dominated"] and not floor_known:
        yield f"{where}/dominated", "nobody is surely beaten where no noise floor was measured"
    times = [points[member][0] for member in pareto["front"]]
    if times != sorted(times):
        yield f"{where}/front", "is not in the order of time"


def slow_faults(cell, where):
    slow, lights = cell.get("too_slow_at_lights"), cell["params"]["lights"]
    if slow is not None and (slow > lights or (cell["status"] == "timeout" and slow < lights)):
        yield f"{where}/too_slow_at_lights", f"is {slow}, but the cell has {lights} lights"
    if slow is not None and cell["samples"]["wall_ns"]:
        yield f"{where}/samples", "are there, though the arm was too slow to sample"


def work_faults(cell, where):
    work = cell["work"] or {}
    hits, evaluations, rate = (work.get(key) for key in ("light_hits", "light_evaluations", "false_positive_rate"))
    if rate is not None and (not evaluations or hits is None or abs(1 - hits / evaluations - rate) > 1e-9):
        yield f"{where}/work/false_positive_rate", f"is {rate}, but there are {hits} hits of {evaluations} evaluations"


def fastest_faults(entry, where):
    last = -1
    for index, part in enumerate(entry["ranges"]):
        if not last < part["from_lights"] <= part["to_lights"]:
            yield f"{where}/ranges/{index}", "does not begin after the one before, or ends before it begins"
        last = part["to_lights"]
        if part["surely"] == bool(part["rivals"]):
            yield f"{where}/ranges/{index}/surely", f"is {part['surely']}, with {len(part['rivals'])} rivals"


def answer_faults(answer, group_of, where):
    named = [answer["arm"], answer["runner_up"], *answer["uncertain"]]
    if any(group_of.get(member) != answer["group"] for member in named if member is not None):
        yield where, "a cell is not of the group"
    if (answer["arm"] is None) != (answer["reason"] is not None):
        yield f"{where}/reason", "stands beside a winner, or there is neither"
    if answer["runner_up"] is not None and answer["arm"] in (None, answer["runner_up"]):
        yield f"{where}/runner_up", "is the winner, or has none before it"
    if (answer["runner_up"] is None) != (answer["verdict"] is None):
        yield f"{where}/verdict", "stands without a runner-up, or is missing beside one"


def invariant_faults(report):
    cells = report["cells"]
    ids = collections.Counter(cell["id"] for cell in cells)
    for cell_id, count in ids.items():
        if count > 1:
            yield "/cells", f"the id {cell_id} stands {count} times"
    for index, cell in enumerate(cells):
        yield from sample_faults(cell, f"/cells/{index}")
        yield from lost_faults(cell, f"/cells/{index}")
        yield from slow_faults(cell, f"/cells/{index}")
        yield from work_faults(cell, f"/cells/{index}")

    group_of = {cell["id"]: cell["group"] for cell in cells}
    for index, pair in enumerate(report["pairs"]):
        if {group_of.get(pair["a"]), group_of.get(pair["b"])} != {pair["group"]}:
            yield f"/pairs/{index}", "a or b is not a cell of the group"
        if None not in (pair["low"], pair["ratio"], pair["high"]) and not pair["low"] <= pair["ratio"] <= pair["high"]:
            yield f"/pairs/{index}", "the ratio is not within its interval"
    groups = set(group_of.values())
    referred = collections.Counter(reference["group"] for reference in report["references"])
    for group, count in referred.items():
        if group not in groups or count > 1:
            yield "/references", f"the group '{group}' has no cell, or stands {count} times"
    error_of = {cell["id"]: display_error(cell, "flip_mean") for cell in cells}
    for index, pareto in enumerate(report["pareto"]):
        if any(group_of.get(point["id"]) != pareto["group"] for point in pareto["points"]):
            yield f"/pareto/{index}", "a cell is not of the group"
        else:
            yield from front_faults(pareto, error_of, report["noise"]["floor"] is not None, f"/pareto/{index}")
    for index, entry in enumerate(report.get("fastest", [])):
        yield from fastest_faults(entry, f"/fastest/{index}")
    for index, answer in enumerate(report["answers"]):
        yield from answer_faults(answer, group_of, f"/answers/{index}")

    summary = report["summary"]
    counts = collections.Counter(cell["status"] for cell in cells)
    if {status: count for status, count in summary["counts"].items() if count} != dict(counts):
        yield "/summary/counts", f"are not those of the cells: {dict(counts)}"
    if len(cells) > summary["planned"]:
        yield "/summary/planned", f"is {summary['planned']}, but there are {len(cells)} cells"
    if summary["complete"] != (len(cells) == summary["planned"]):
        yield "/summary/complete", "does not agree with the number of cells"
    if summary["complete"] != (report["run"]["stopped_because"] == "complete"):
        yield "/run/stopped_because", "does not agree with summary.complete"


def curve_faults(result, where):
    parameter, curve = result["parameter"], result["curve"]
    if parameter is None:
        if curve or result["breakdown"] is not None:
            yield where, "has a curve or a breakdown, but no parameter"
        return
    values = [point["parameter"] for point in curve]
    ends = (parameter["easy"], parameter["hard"])
    if values != sorted(values, reverse=ends[0] > ends[1]) or not all(min(ends) <= value <= max(ends) for value in values):
        yield f"{where}/curve", "is not in order from easy to hard, or leaves that range"
    broken = [point["parameter"] for point in curve if point["status"] != "pass"]
    if result["breakdown"] != (broken[0] if broken else None):
        yield f"{where}/breakdown", f"is {result['breakdown']}, but the curve's first is {broken[:1]}"
    found = {point["status"] for point in curve}
    worst = next((status for status in ("fail", "limit", "pass") if status in found), result["status"])
    if curve and result["status"] not in (worst, "fail"):
        yield f"{where}/status", f"is {result['status']}, but the curve has {worst}"


def stress_faults(run):
    results = run["cases"]
    for index, result in enumerate(results):
        where = f"/cases/{index}"
        if (result["status"] == "pass") != (result["reason"] is None):
            yield f"{where}/reason", "stands beside a pass, or is missing beside another status"
        if result["arm"] != " ".join(f"{axis}={value}" for axis, value in result["axes"].items()):
            yield f"{where}/arm", "is not what its axes say"
        yield from curve_faults(result, where)
    arms = collections.Counter((result["id"], result["arm"]) for result in results)
    for (case, arm), count in arms.items():
        if count > 1:
            yield "/cases", f"{case} stands {count} times on the arm '{arm}'"
    statuses = collections.Counter(result["status"] for result in results)
    counted = {"cases": len({result["id"] for result in results}), "arms": len(results)}
    counted |= {status: statuses[status] for status in ("pass", "limit", "fail", "skipped")}
    if run["summary"] != counted:
        yield "/summary", f"are not the counts of the cases: {counted}"


def faults(path, schemas):
    try:
        report = strict_json(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        return [("/", str(error))]
    # The invariants take the shape for granted.
    if isinstance(report, dict) and report.get("schema") == STRESS:
        environment = schemas["report"]["properties"]["environment"]
        found = list(schema_faults(report, schemas["stress"])) or list(schema_faults(report["environment"], environment))
        return found or list(stress_faults(report))
    return list(schema_faults(report, schemas["report"])) or list(invariant_faults(report))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("reports", nargs="+", type=pathlib.Path, metavar="REPORT")
    arguments = parser.parse_args()
    schemas = {kind: json.loads((RESULTS / f"{kind}.schema.json").read_text(encoding="utf-8")) for kind in ("report", "stress")}
    for schema in schemas.values():
        jsonschema.Draft202012Validator.check_schema(schema)
    failed = False
    for path in arguments.reports:
        found = faults(path, schemas)
        for where, what in found[:MAX_FAULTS_SHOWN]:
            print(f"{path}:{where}: {what}")
        if len(found) > MAX_FAULTS_SHOWN:
            print(f"{path}: and {len(found) - MAX_FAULTS_SHOWN} more faults")
        if not found:
            print(f"{path}: valid")
        failed |= bool(found)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
