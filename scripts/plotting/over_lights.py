"""Over the light count: the time of each arm, and its ratio to forward with the crossover marked."""

import textwrap

from . import report as data
from . import style

BASELINE = "forward"
BAND_ALPHA = 0.18


def _series(points):
    """Points (lights, middle, low, high) as columns by rising light count; an open end of an interval shows no band."""
    points = sorted(points, key=lambda point: point[0])
    lights, middle = [p[0] for p in points], [p[1] for p in points]
    low = [p[1] if p[2] is None else p[2] for p in points]
    high = [p[1] if p[3] is None else p[3] for p in points]
    return lights, middle, low, high


def _draw(axes, points, arm, styles, label):
    lights, middle, low, high = _series(points)
    axes.fill_between(lights, low, high, color=styles.color(arm), alpha=BAND_ALPHA, linewidth=0)
    return axes.plot(lights, middle, label=label, **styles.line(arm))[0]


def _ends(all_points):
    """The smallest and the largest number that the series show."""
    values = [v for points in all_points for column in _series(points)[1:] for v in column]
    return min(values), max(values)


def _wide_enough(cells):
    return len({cell["params"]["lights"] for cell in cells}) > 1


def _time_panel(axes, cells, styles, names):
    points = {}
    for cell in cells:
        wall = cell["statistics"]["wall_ns"]
        scaled = [None if wall[key] is None else wall[key] / style.NS_PER_MS for key in ("median", "low", "high")]
        points.setdefault(data.arm_of(cell["params"]), []).append((cell["params"]["lights"], *scaled))
    for arm, arm_points in points.items():
        _draw(axes, arm_points, arm, styles, names[arm])
    style.light_axis(axes, [cell["params"]["lights"] for cell in cells])
    style.log_axis(axes.yaxis, *_ends(points.values()))
    axes.set_ylabel("time per frame (ms)")


def draw_time(report, scene, cells):
    """A figure, or why there is none."""
    shown = {panel: group for panel, group in data.panels(cells).items() if _wide_enough(group)}
    if not shown:
        return None, "one light count only"
    arms = [data.arm_of(cell["params"]) for group in shown.values() for cell in group]
    styles, names = style.ArmStyles(arms), data.arm_names(arms)
    figure, panels = style.panel_grid(len(shown), 4.2, 3.8, f"{data.name_of(scene)}: time over the number of lights")
    for axes, (panel, group) in zip(panels, shown.items()):
        _time_panel(axes, group, styles, names)
        axes.set_title(panel.title)
    # One legend for all panels: the panel with the most arms has them all, as the arms of a sweep are a product.
    fullest = max(panels, key=lambda axes: len(axes.get_lines()))
    panels[-1].legend(*fullest.get_legend_handles_labels(), loc="upper left", bbox_to_anchor=(1.02, 1))
    return figure, None


def _ratios(report, cells):
    """{arm: points} of every pair of an arm with the forward arm of the same HDR format, the arm's time above."""
    cell_of = {cell["id"]: cell for cell in cells}
    points = {}
    for pair in report["pairs"]:
        if pair["a"] not in cell_of or pair["b"] not in cell_of or pair["ratio"] is None:
            continue
        a, b = cell_of[pair["a"]], cell_of[pair["b"]]
        numbers = (pair["ratio"], pair["low"], pair["high"])
        if a["params"]["path"] == BASELINE:
            a, b = b, a
            numbers = tuple(None if n is None else 1 / n for n in (pair["ratio"], pair["high"], pair["low"]))
        one_apart = b["params"]["path"] == BASELINE != a["params"]["path"]
        if one_apart and a["params"]["hdr"] == b["params"]["hdr"]:
            points.setdefault(data.arm_of(a["params"]), []).append((a["params"]["lights"], *numbers))
    return {arm: arm_points for arm, arm_points in points.items() if len(arm_points) > 1}


def _crossovers(report, scene, panel):
    """{arm: its crossover with forward} in one panel."""
    return {data.arm_of(entry["a"]): entry for entry in report["crossovers"]
            if entry["scene"] == scene and data.panel_of(entry) == panel and entry["b"]["path"] == BASELINE}


def _statement(name, crossover):
    if crossover is None:
        return f"{name}: no crossover worked out"
    if crossover["lights"] is None:
        return f"{name}: no crossover: {crossover['reason']}"
    low, high = ("open" if crossover[end] is None else f"{crossover[end]:.3g}" for end in ("low", "high"))
    return f"{name}: meets forward at {crossover['lights']:.3g} lights, interval {low} to {high}"


def _mark(axes, crossover, color, counts):
    low = min(counts) if crossover["low"] is None else crossover["low"]
    high = max(counts) if crossover["high"] is None else crossover["high"]
    axes.plot([low, high], [1, 1], color=color, linewidth=5, alpha=0.35, solid_capstyle="butt", zorder=3)
    axes.axvline(crossover["lights"], color=color, linewidth=0.8, linestyle=(0, (2, 2)), zorder=1)
    axes.plot([crossover["lights"]], [1], marker="|", markersize=13, markeredgewidth=2, color=color, zorder=4)


def _ratio_panel(axes, ratios, crossovers, styles, names):
    counts = [point[0] for points in ratios.values() for point in points]
    axes.axhline(1, color=style.FAINT, linewidth=1)
    for arm, points in ratios.items():
        crossover = crossovers.get(arm)
        label = textwrap.fill(_statement(names[arm], crossover), 62, subsequent_indent="    ")
        _draw(axes, points, arm, styles, label)
        if crossover and crossover["lights"] is not None:
            _mark(axes, crossover, styles.color(arm), counts)
    style.light_axis(axes, counts)
    low, high = _ends(ratios.values())
    style.log_axis(axes.yaxis, min(low, 0.95), max(high, 1.05))
    axes.set_ylabel("time / time of forward")
    axes.legend(loc="upper left", bbox_to_anchor=(-0.1, -0.16), fontsize=7.5, handlelength=3)


def draw_ratio(report, scene, cells):
    """A figure, or why there is none."""
    shown = {panel: ratios for panel, group in data.panels(cells).items() if (ratios := _ratios(report, group))}
    if not shown:
        return None, "no arm was compared with forward at two light counts"
    arms = [arm for ratios in shown.values() for arm in ratios]
    styles, names = style.ArmStyles(arms), data.arm_names(arms)
    rows = max(len(ratios) for ratios in shown.values())
    figure, panels = style.panel_grid(len(shown), 5.0, 3.8 + 0.3 * rows,
                                      f"{data.name_of(scene)}: against forward, over the number of lights")
    for axes, (panel, ratios) in zip(panels, shown.items()):
        _ratio_panel(axes, ratios, _crossovers(report, scene, panel), styles, names)
        axes.set_title(f"{panel.title} (below 1: faster than forward)")
    return figure, None
