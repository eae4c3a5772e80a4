"""Over the light count: the time of each arm with the crossovers of the fastest, its ratio to forward with its crossover, and the
light evaluations that it makes for each one that must be made."""

import math
import textwrap

from matplotlib import patheffects

from . import report as data
from . import style

BASELINE = "forward"
BAND_ALPHA = 0.16
STATEMENT_LETTERS = 76
MOST_BARS = 4
PANEL_WIDTH_IN = 4.4
CROSSOVER_LABEL = "another becomes the fastest"


def _draw(axes, points, arm, styles, label):
    """`points`: (lights, middle, low, high), by rising light count."""
    lights, middle, low, high = zip(*points)
    axes.fill_between(lights, low, high, color=styles.color(arm), alpha=BAND_ALPHA, linewidth=0)
    axes.plot(lights, middle, label=label, **styles.line(arm))


def _ends(series):
    values = [value for points in series.values() for point in points for value in point[1:]]
    return min(values), max(values)


def _times(cells):
    """{arm: points} of the arms measured at two light counts or more."""
    series = {}
    for cell in sorted(cells, key=lambda cell: cell["params"]["lights"]):
        point = (cell["params"]["lights"], *data.estimate_ms(cell["statistics"]["wall_ns"]))
        series.setdefault(data.arm_of(cell["params"]), []).append(point)
    return {arm: points for arm, points in series.items() if len(points) > 1}


def _height_in(names):
    """Of a figure with one legend: many lines need room, and so do their names."""
    return max(3.8, 1.8 + 0.25 * len(names))


def _slowest_first(series):
    """The arms in about the order of their lines' right ends, from above; those that end early were too slow to go on."""
    return sorted(series, key=lambda arm: (series[arm][-1][0], -series[arm][-1][1]))


def _order(shown):
    """Of the arms of all panels, by the last panel each is in: the largest picture."""
    order = []
    for series in reversed(shown.values()):
        order += [arm for arm in _slowest_first(series) if arm not in order]
    return order


def _shared_legend(panels, names):
    """One legend for all panels, in the order of `names`, beside the last."""
    handles = {label: handle for axes in panels for handle, label in zip(*axes.get_legend_handles_labels())}
    labels = [name for name in names if name in handles] + [label for label in handles if label not in names]
    panels[-1].legend([handles[label] for label in labels], labels, loc="upper left", bbox_to_anchor=(1.02, 1), handlelength=4)


def _at(points, lights):
    """The time where the straight line between the neighbours passes, on logarithmic axes; None outside."""
    for (x0, y0, *_), (x1, y1, *_) in zip(points, points[1:]):
        if x0 <= lights <= x1:
            share = math.log((1 + lights) / (1 + x0)) / math.log((1 + x1) / (1 + x0))
            return y0 * (y1 / y0)**share
    return None


def _mark_envelope(axes, report, scene, panel, series):
    """Where another arm becomes the fastest: a ring with its interval, and the light count."""
    for entry in report["crossovers"]:
        if entry["scene"] != scene or data.panel_of(entry) != panel or not entry.get("on_envelope") or entry["lights"] is None:
            continue
        a, b = (_at(series.get(data.arm_of(entry[end]), []), entry["lights"]) for end in "ab")
        if a is None or b is None:
            continue
        time = math.sqrt(a * b)
        counts = [point[0] for points in series.values() for point in points]
        low = min(counts) if entry["low"] is None else entry["low"]
        high = max(counts) if entry["high"] is None else entry["high"]
        axes.plot([low, high], [time, time], color="black", linewidth=1.2, zorder=5)
        axes.plot([entry["lights"]], [time], marker="o", markersize=9, markerfacecolor="none", markeredgecolor="black",
                  linestyle="none", zorder=5, label=CROSSOVER_LABEL)
        axes.annotate(f"{entry['lights']:.3g}", (entry["lights"], time), xytext=(7, -11), textcoords="offset points", fontsize=8,
                      zorder=6, path_effects=[patheffects.withStroke(linewidth=2, foreground="white")])


def draw_time(report, scene, cells, paths):
    """A figure, or why there is none."""
    shown = {panel: series for panel, group in data.panels(cells).items() if (series := _times(group))}
    if not shown:
        return None, "no arm was measured at two light counts"
    order = _order(shown)
    styles, names = style.ArmStyles(paths, order), data.arm_names(order)
    figure, panels = style.panel_grid(report, f"{data.name_of(scene)}: time over the number of lights", len(shown), PANEL_WIDTH_IN,
                                      _height_in(names))
    for axes, (panel, series) in zip(panels, shown.items()):
        for arm, points in series.items():
            _draw(axes, points, arm, styles, names[arm])
        _mark_envelope(axes, report, scene, panel, series)
        style.light_axis(axes, [point[0] for points in series.values() for point in points])
        style.log_axis(axes.yaxis, *_ends(series))
        axes.set_ylabel("time per frame (ms)")
        axes.set_title(panel.title)
    _shared_legend(panels, [names[arm] for arm in order])
    return figure, None


def _evaluations(cells):
    """{arm: points}: light evaluations made for each that must be."""
    series = {}
    for cell in sorted(cells, key=lambda cell: cell["params"]["lights"]):
        work = cell["work"] or {}
        made, needed = work.get("light_evaluations"), work.get("light_hits")
        if made and needed:
            series.setdefault(data.arm_of(cell["params"]), []).append((cell["params"]["lights"], *3 * (made / needed,)))
    return {arm: points for arm, points in series.items() if len(points) > 1}


def draw_evaluations(report, scene, cells, paths):
    """A figure, or why there is none."""
    shown = {panel: series for panel, group in data.panels(cells).items() if (series := _evaluations(group))}
    if not shown:
        return None, "no arm's light evaluations were counted at two light counts"
    order = _order(shown)
    styles, names = style.ArmStyles(paths, order), data.arm_names(order)
    figure, panels = style.panel_grid(report, f"{data.name_of(scene)}: light evaluations made for each that must be", len(shown),
                                      PANEL_WIDTH_IN, _height_in(names))
    for axes, (panel, series) in zip(panels, shown.items()):
        axes.axhline(1, color=style.FAINT, linewidth=1, label="none in vain")
        for arm, points in series.items():
            _draw(axes, points, arm, styles, names[arm])
        style.light_axis(axes, [point[0] for points in series.values() for point in points])
        low, high = _ends(series)
        style.log_axis(axes.yaxis, min(low, 0.95), max(high, 1.3))
        axes.set_ylabel("made / must be made")
        axes.set_title(panel.title)
    _shared_legend(panels, [names[arm] for arm in order])
    return figure, None


def _ratios(report, cells):
    """{arm: points}: each arm's time over that of the forward arm of the same HDR format, skips, guards and sums, from the
    report's pairs."""
    def rival(params):
        arm = data.arm_of(params)
        return arm.hdr, arm.skip, arm.guards, arm.sums

    cell_of = {cell["id"]: cell for cell in cells}
    series = {}
    for pair in report["pairs"]:
        a, b = cell_of.get(pair["a"]), cell_of.get(pair["b"])
        if a is None or b is None or pair["ratio"] is None or rival(a["params"]) != rival(b["params"]):
            continue
        numbers = data.filled(pair["ratio"], pair["low"], pair["high"])
        if a["params"]["path"] == BASELINE:
            a, b = b, a
            middle, low, high = numbers
            numbers = (1 / middle, 1 / high, 1 / low)
        if b["params"]["path"] == BASELINE != a["params"]["path"]:
            series.setdefault(data.arm_of(a["params"]), []).append((a["params"]["lights"], *numbers))
    return {arm: sorted(points) for arm, points in series.items() if len(points) > 1}


def _crossovers(report, scene, panel):
    """{arm: its crossover with forward} in one panel."""
    return {data.arm_of(entry["a"]): entry for entry in report["crossovers"]
            if entry["scene"] == scene and data.panel_of(entry) == panel and entry["b"]["path"] == BASELINE}


def _statement(name, crossover):
    if crossover is None:
        text = f"{name}: no crossover was worked out"
    elif crossover["lights"] is None:
        text = f"{name}: no crossover: {crossover['reason']}"
    else:
        low, high = ("open" if crossover[end] is None else f"{crossover[end]:.3g}" for end in ("low", "high"))
        text = f"{name}: crossover at {crossover['lights']:.3g} lights [{low}, {high}]"
    return textwrap.fill(text, STATEMENT_LETTERS, subsequent_indent="    ")


def _mark(axes, crossover, color, counts, with_interval):
    """The crossover on the line at 1: its interval as a bar, as far as was measured where it is open."""
    axes.plot([crossover["lights"]], [1], marker="|", markersize=14, markeredgewidth=2, color=color, zorder=4)
    if not with_interval:
        return
    low = min(counts) if crossover["low"] is None else crossover["low"]
    high = max(counts) if crossover["high"] is None else crossover["high"]
    axes.plot([low, high], [1, 1], color=color, linewidth=5, alpha=0.35, solid_capstyle="butt", zorder=3)


def _ratio_panel(axes, series, crossovers, styles, names):
    counts = [point[0] for points in series.values() for point in points]
    axes.axhline(1, color=style.FAINT, linewidth=1, label="forward")
    for arm in _slowest_first(series):
        crossover = crossovers.get(arm)
        _draw(axes, series[arm], arm, styles, _statement(names[arm], crossover))
        if crossover and crossover["lights"] is not None:
            _mark(axes, crossover, styles.color(arm), counts, with_interval=len(series) <= MOST_BARS)
    style.light_axis(axes, counts)
    low, high = _ends(series)
    style.log_axis(axes.yaxis, min(low, 0.95), max(high, 1.05))
    axes.set_ylabel("time / time of forward")
    axes.legend(loc="upper left", bbox_to_anchor=(-0.12, -0.16), fontsize=7.5, handlelength=3)


def draw_ratio(report, scene, cells, paths):
    """A figure, or why there is none."""
    shown = {panel: series for panel, group in data.panels(cells).items() if (series := _ratios(report, group))}
    if not shown:
        return None, "no arm was compared with forward at two light counts"
    arms = [arm for series in shown.values() for arm in series]
    styles, names = style.ArmStyles(paths, arms), data.arm_names(arms)
    crossovers = {panel: _crossovers(report, scene, panel) for panel in shown}
    lines = max(sum(1 + _statement(names[arm], crossovers[panel].get(arm)).count("\n") for arm in series)
                for panel, series in shown.items())
    figure, panels = style.panel_grid(report, f"{data.name_of(scene)}: against forward, over the number of lights",
                                      len(shown), 5.4, 4.2 + 0.17 * lines)
    for axes, (panel, series) in zip(panels, shown.items()):
        _ratio_panel(axes, series, crossovers[panel], styles, names)
        axes.set_title(f"{panel.title} (below 1: faster than forward)")
    return figure, None
