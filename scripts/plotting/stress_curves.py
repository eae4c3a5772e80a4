"""Error over the parameter that a case turns up, one panel per case: the bound, the law, and where each arm breaks."""

import math
import textwrap

from matplotlib import lines

from . import stress_data as data
from . import style

COLUMNS = 5
MOST_NAMED = 5
LOWEST_OF_BOUND = 1e-4  # smaller errors, 0 among them, lie on the lower edge
STATUS_COLORS = {"pass": "#0072B2", "limit": "#E69F00", "fail": "#C00000", "skipped": style.FAINT}
BOUND = {"color": "#999999", "linewidth": 4, "alpha": 0.45, "solid_capstyle": "butt", "zorder": 1}
LAW = {"linestyle": (0, (4, 2)), "linewidth": 0.9, "zorder": 2}


def _points(entry):
    """[(parameter, point)]; of a case without a parameter one, at None."""
    if entry["parameter"] is None:
        return [(None, entry)]
    return [(point["parameter"], point) for point in entry["curve"]]


def _floor(entries):
    """Of the errors shown: on a logarithmic axis 0 has no place."""
    bounds = [point["bound"] for entry in entries for _, point in _points(entry) if point["bound"]]
    errors = [point["measured"] for entry in entries for _, point in _points(entry) if point["measured"]]
    lowest = min(errors, default=1e-9)
    return max(lowest, LOWEST_OF_BOUND * min(bounds)) if bounds else lowest


def _ceiling(entries, floor):
    values = [value for entry in entries for _, point in _points(entry)
              for value in (point["measured"], point["predicted"], point["bound"]) if value]
    return max([10 * floor, *values])


def _line(axes, xs, points, color, floor, ceiling, label):
    shown = [ceiling if point["measured"] is None else max(point["measured"], floor) for point in points]
    axes.plot(xs, shown, color=color, linewidth=0.9, marker=".", markersize=3, alpha=0.85, label=label, zorder=3)
    for x, point, value in zip(xs, points, shown):
        if point["measured"] is None:  # not finite
            axes.plot([x], [value], marker="x", color=STATUS_COLORS["fail"], markersize=6, zorder=5)


def _distinct(entries, key):
    """Each curve of `key` once: most arms of a case share it."""
    curves = {}
    for entry in entries:
        curve = tuple((x, point[key]) for x, point in _points(entry) if point[key] is not None)
        if len(curve) > 1:
            curves.setdefault(curve, entry)
    return curves.items()


def _over_parameter(axes, entries, floor, ceiling):
    colors = _colors(entries)
    for curve, _ in _distinct(entries, "bound"):
        axes.plot(*zip(*((x, max(value, floor)) for x, value in curve)), **BOUND)
    for curve, entry in _distinct(entries, "predicted"):
        axes.plot(*zip(*((x, max(value, floor)) for x, value in curve)), color=colors[entry["arm"]], **LAW)
    for entry, name in zip(entries, data.short_names(entries)):
        if not entry["curve"]:
            continue
        xs, points = zip(*_points(entry))
        _line(axes, xs, points, colors[entry["arm"]], floor, ceiling, name)
        if entry["breakdown"] is not None:
            broken = next(point for x, point in _points(entry) if x == entry["breakdown"])
            value = ceiling if broken["measured"] is None else max(broken["measured"], floor)
            axes.plot([entry["breakdown"]], [value], marker="o", markersize=6, markerfacecolor="none",
                      markeredgecolor=STATUS_COLORS[entry["status"]], zorder=4)
    parameter = entries[0]["parameter"]
    axes.set_xscale("log")
    room = (parameter["hard"] / parameter["easy"]) ** 0.04
    axes.set_xlim(parameter["easy"] / room, parameter["hard"] * room)  # harder to the right, whichever way it is turned
    axes.set_xlabel(parameter["name"] + (f" ({parameter['unit']})" if parameter["unit"] else ""), fontsize=7.5)


def _over_arms(axes, entries, floor, ceiling):
    """A case without a parameter: a dot for each arm."""
    for place, entry in enumerate(entries):
        if entry["bound"] is not None:
            axes.plot([place - 0.4, place + 0.4], 2 * [max(entry["bound"], floor)], **BOUND)
        value = ceiling if entry["measured"] is None else max(entry["measured"], floor)
        axes.plot([place], [value], marker="." if entry["measured"] is not None else "x", linestyle="none",
                  color=STATUS_COLORS[entry["status"]], zorder=3)
    axes.set_xlim(-0.7, len(entries) - 0.3)
    axes.set_xticks([])
    axes.set_xlabel(f"{len(entries)} arms" if len(entries) > 1 else "one arm", fontsize=7.5)


def _colors(entries):
    """{arm: colour}: of few arms each has its own; of many it says how they ended."""
    if len(entries) <= MOST_NAMED:
        return {entry["arm"]: style.LINE_COLORS[i] for i, entry in enumerate(entries)}
    return {entry["arm"]: STATUS_COLORS[entry["status"]] for entry in entries}


def _panel(axes, case, entries):
    entries = [entry for entry in entries if entry["status"] != "skipped"]
    axes.set_title(textwrap.fill(f"{case}: {entries[0]['summary']}" if entries else f"{case}: skipped", 46), fontsize=7.5,
                   loc="left")
    axes.tick_params(labelsize=7)
    if not entries:
        axes.set_axis_off()
        return
    points = [point for entry in entries for _, point in _points(entry)]
    if all(point["measured"] == 0 for point in points):
        axes.set_axis_off()
        axes.annotate(f"no error on {len(entries)} arms", (0, 0.9), xycoords="axes fraction", va="top", fontsize=7.5,
                      color=style.FAINT)
        return
    floor = _floor(entries)
    ceiling = _ceiling(entries, floor)
    axes.set_yscale("log")
    axes.set_ylim(floor / 2, ceiling * 2)
    (_over_arms if entries[0]["parameter"] is None else _over_parameter)(axes, entries, floor, ceiling)
    axes.minorticks_off()
    if math.log10(ceiling / floor) > 6:
        style.thin_ticks(axes.yaxis, 6)
    axes.set_ylabel(f"error ({entries[0]['unit']})", fontsize=7.5)
    if 1 < len(entries) <= MOST_NAMED and entries[0]["parameter"] is not None:
        axes.legend(fontsize=6, handlelength=1.5, loc="best")


def _legend(figure):
    handles = [lines.Line2D([], [], label="bound", **{key: BOUND[key] for key in ("color", "linewidth", "alpha")}),
               lines.Line2D([], [], color="black", label="law", linestyle=LAW["linestyle"], linewidth=0.9),
               lines.Line2D([], [], color="black", marker="o", markerfacecolor="none", linestyle="none", label="breakdown"),
               lines.Line2D([], [], color=STATUS_COLORS["fail"], marker="x", linestyle="none", label="not finite")]
    handles += [lines.Line2D([], [], color=STATUS_COLORS[status], label=f"of many arms: {status}")
                for status in ("pass", "limit", "fail")]
    style.legend_below_title(figure, handles)


def draw(run):
    """A figure, or why there is none."""
    cases = data.by_case(run["cases"])
    if not cases:
        return None, "no case was tried"
    columns = min(COLUMNS, len(cases))
    rows = -(-len(cases) // columns)
    figure, panels = style.panel_grid(run, "Error over what each case turns up, harder to the right\n", columns, 3.6,
                                      1.1 + 2.6 * rows, rows=rows)
    for axes, (case, entries) in zip(panels, cases.items()):
        _panel(axes, case, entries)
    for axes in panels[len(cases):]:
        axes.set_axis_off()
    _legend(figure)
    return figure, None
