"""Over the light count: the time of each arm, and its ratio to forward with the crossover marked."""

import textwrap

from . import report as data
from . import style

BASELINE = "forward"
BAND_ALPHA = 0.16
STATEMENT_LETTERS = 76


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


def draw_time(report, scene, cells, paths):
    """A figure, or why there is none."""
    shown = {panel: series for panel, group in data.panels(cells).items() if (series := _times(group))}
    if not shown:
        return None, "no arm was measured at two light counts"
    arms = [arm for series in shown.values() for arm in series]
    styles, names = style.ArmStyles(paths, arms), data.arm_names(arms)
    height = max(3.8, 1.0 + 0.2 * len(names))  # the legend's
    figure, panels = style.panel_grid(report, f"{data.name_of(scene)}: time over the number of lights", len(shown), 4.2, height)
    for axes, (panel, series) in zip(panels, shown.items()):
        for arm, points in series.items():
            _draw(axes, points, arm, styles, names[arm])
        style.light_axis(axes, [point[0] for points in series.values() for point in points])
        style.log_axis(axes.yaxis, *_ends(series))
        axes.set_ylabel("time per frame (ms)")
        axes.set_title(panel.title)
    # One legend for all panels.
    handles = {label: handle for axes in panels for handle, label in zip(*axes.get_legend_handles_labels())}
    panels[-1].legend(handles.values(), handles.keys(), loc="upper left", bbox_to_anchor=(1.02, 1))
    return figure, None


def _ratios(report, cells):
    """{arm: points}: each arm's time over that of the forward arm of the same HDR format, from the report's pairs."""
    cell_of = {cell["id"]: cell for cell in cells}
    series = {}
    for pair in report["pairs"]:
        a, b = cell_of.get(pair["a"]), cell_of.get(pair["b"])
        if a is None or b is None or pair["ratio"] is None or a["params"]["hdr"] != b["params"]["hdr"]:
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


def _mark(axes, crossover, color, counts):
    """The crossover on the line at 1: its interval as a bar, as far as was measured where it is open."""
    low = min(counts) if crossover["low"] is None else crossover["low"]
    high = max(counts) if crossover["high"] is None else crossover["high"]
    axes.plot([low, high], [1, 1], color=color, linewidth=5, alpha=0.35, solid_capstyle="butt", zorder=3)
    axes.plot([crossover["lights"]], [1], marker="|", markersize=14, markeredgewidth=2, color=color, zorder=4)


def _ratio_panel(axes, series, crossovers, styles, names):
    counts = [point[0] for points in series.values() for point in points]
    axes.axhline(1, color=style.FAINT, linewidth=1, label="forward")
    for arm, points in series.items():
        crossover = crossovers.get(arm)
        _draw(axes, points, arm, styles, _statement(names[arm], crossover))
        if crossover and crossover["lights"] is not None:
            _mark(axes, crossover, styles.color(arm), counts)
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
