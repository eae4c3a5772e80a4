"""A stress run as the pictures want it: its arms by case, and its breakdown tables."""

import math
from typing import NamedTuple

from .report import ReportError, read_json

SCHEMA = "lightsweep-stress-1"
TABLES = ("paths", "layouts", "others")
BARE_AXES = ("path", "layout", "hdr")


class Grid(NamedTuple):
    """A breakdown table: the arm in a row and a column, where there is one."""

    title: str
    rows: list
    columns: list
    cells: dict  # (row, column) -> entry of `cases`


def load(path):
    run = read_json(path)
    if not isinstance(run, dict) or run.get("schema") != SCHEMA:
        raise ReportError(f"{path}:/schema: '{SCHEMA}' was expected; lightsweep stress writes such a file")
    if not isinstance(run.get("cases"), list):
        raise ReportError(f"{path}:/cases: a list was expected")
    return run


def by_case(entries):
    """{id: its arms}, in the order of the run."""
    cases = {}
    for entry in entries:
        cases.setdefault(entry["id"], []).append(entry)
    return cases


def _shared(entries, kept=()):
    """{axis: value} where all arms that have the axis agree: nothing where there is one arm alone."""
    if len({entry["arm"] for entry in entries}) < 2:
        return {}
    values = {}
    for entry in entries:
        for axis, value in entry["axes"].items():
            values.setdefault(axis, set()).add(value)
    return {axis: next(iter(found)) for axis, found in values.items() if len(found) == 1 and axis not in kept}


def short_names(entries, left_out=()):
    """[name of each arm], without what all share and the axes left out."""
    unsaid = {*_shared(entries), *left_out}
    names = []
    for entry in entries:
        words = [value if axis in BARE_AXES else f"{axis}={value}"
                 for axis, value in entry["axes"].items() if axis not in unsaid]
        names.append(" ".join(words) or entry["arm"] or "one arm")
    return names


def _title(words, shared):
    return words + "".join(f", {axis}={value}" for axis, value in sorted(shared.items()))


def arms_by_cases(run, table):
    """The grid of `paths` or of `layouts`; None where it has no arm."""
    entries = [entry for entry in run["cases"] if entry["table"] == table]
    if not entries:
        return None
    shared = _shared(entries, kept=("path",) if table == "paths" else ())
    cells = {}
    for entry in entries:
        words = [value if axis in BARE_AXES else f"{axis}={value}" for axis, value in entry["axes"].items() if axis not in shared]
        name = " ".join(words) or entry["arm"]
        cells[(name if (name, entry["id"]) not in cells else entry["arm"], entry["id"])] = entry
    rows, columns = (list(dict.fromkeys(key[i] for key in cells)) for i in (0, 1))
    return Grid(_title(table, shared), rows, columns, cells)


def _kind(entry):
    """Its case and its axes; some paths take a layout and some lists, and are compared all the same."""
    return entry["id"], tuple(axis for axis in entry["axes"] if axis not in ("layout", "light_lists"))


def other_cases(run):
    """Grids of the arms with axes of one case's own: the values of the last axis that varies are the columns, where two vary."""
    kinds = {}
    for entry in run["cases"]:
        if entry["table"] == "others":
            kinds.setdefault(_kind(entry), []).append(entry)
    grids = []
    for (case, _), entries in kinds.items():
        shared = _shared(entries)
        varying = list(dict.fromkeys(axis for entry in entries for axis in entry["axes"] if axis not in shared))
        varying.sort(key=lambda axis: axis not in ("path", "layout"))  # there are many of both: they are rows
        last = varying[-1] if len(entries) > 1 and len(varying) > 1 else None
        names = short_names(entries, left_out=[last])
        cells = {(name, entry["axes"].get(last, "none") if last else ""): entry for name, entry in zip(names, entries)}
        rows, columns = (list(dict.fromkeys(key[i] for key in cells)) for i in (0, 1))
        grids.append(Grid(_title(f"{case} by {last}" if last else case, shared), rows, columns, cells))
    return grids


def short_number(value):
    """`250`, `3.2e4`: a breakdown is known to 5 %."""
    if value == round(value) and abs(value) < 1e4:
        return f"{value:.0f}"
    return f"{value:.{3 if 1 <= value < 1000 else 2}g}".replace("e+0", "e").replace("e+", "e").replace("e-0", "e-")


def share_reached(entry):
    """How far the parameter was turned before the bound was passed: 0 not at all, 1 to the end; of a case without one 0."""
    parameter, breakdown = entry["parameter"], entry["breakdown"]
    if breakdown is None:
        return 0.0 if parameter is None else 1.0
    return math.log(breakdown / parameter["easy"]) / math.log(parameter["hard"] / parameter["easy"])
