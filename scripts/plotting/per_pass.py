"""What each pass costs: one stacked bar per arm, at the light counts asked for, else at the largest of each panel."""

from . import report as data
from . import style

UNATTRIBUTED = "unattributed"
EDGE = {"edgecolor": "white", "linewidth": 0.4}
UNATTRIBUTED_LOOK = {"color": "#cccccc", "hatch": ""}
MOST_TIMES_THE_SHORTEST = 8


def _looks(cells):
    """{pass: keyword arguments for its bars}, in about the order run."""
    places = {}
    for cell in cells:
        names = list(cell["statistics"]["passes"])
        for index, name in enumerate(names):
            places.setdefault(name, []).append(index / len(names))
    ordered = sorted(places, key=lambda name: sum(places[name]) / len(places[name]))
    looks = {name: {"color": style.BAR_COLORS[i % len(style.BAR_COLORS)], "hatch": style.HATCHES[i % len(style.HATCHES)]}
             for i, name in enumerate(name for name in ordered if name != UNATTRIBUTED)}
    return looks | {UNATTRIBUTED: UNATTRIBUTED_LOOK}


def _bar(axes, row, cell, looks, scale):
    """Draws the times of the passes times `scale`."""
    left = 0.0
    for name, statistics in cell["statistics"]["passes"].items():
        # Time stamps of passes may overlap a little, which leaves less than nothing unattributed: no bar for that.
        width = scale * max(0.0, data.estimate_ms(statistics)[0])
        axes.barh([row], [width], left=[left], **EDGE, **looks[name])
        left += width
    median, low, high = (scale * value for value in data.estimate_ms(cell["statistics"]["gpu_ns"]))
    return axes.errorbar([median], [row], xerr=[[median - low], [high - median]], fmt="|", color="black", capsize=2,
                         elinewidth=0.8, markersize=8)


def _panel(axes, cells, looks, names, rows):
    """With room for so many `rows`; returns what the legend shows of the totals. Times that lie far apart are drawn as shares, each
    with its sum beside it: the passes of the fast arms could not be seen."""
    totals = [data.estimate_ms(cell["statistics"]["gpu_ns"])[0] for cell in cells]
    as_shares = max(totals) > MOST_TIMES_THE_SHORTEST * min(totals)
    for row, (cell, total_ms) in enumerate(zip(cells, totals)):
        total = _bar(axes, row, cell, looks, 100 / total_ms if as_shares else 1)
        if as_shares:
            axes.annotate(f"{total_ms:.3g} ms", (1, row), xycoords=("axes fraction", "data"), xytext=(-2, 0),
                          textcoords="offset points", ha="right", va="center", fontsize=7.5)
    axes.set_yticks(range(len(cells)), [names[data.arm_of(cell["params"])] for cell in cells])
    axes.set_ylim(rows - 0.4, -0.6)
    axes.grid(axis="y", visible=False)
    axes.set_xlim(left=0, right=135 if as_shares else None)
    if as_shares:
        axes.set_xticks(range(0, 101, 20))
    axes.set_xlabel("share of the GPU time (%)" if as_shares else "GPU time per frame (ms)")
    return total


def _chosen(cells, counts):
    """{(panel, light count): its cells}: at the counts that a panel has, the largest where it has none of them."""
    shown = {}
    for panel, group in data.panels(cells).items():
        measured = data.light_counts(group)
        for count in [count for count in counts if count in measured] or measured[-1:]:
            shown[panel, count] = data.with_lights(group, count)
    return shown


def draw(report, scene, cells, _paths, counts=()):
    """A figure, or why there is none."""
    shown = _chosen(cells, counts)
    all_cells = [cell for group in shown.values() for cell in group]
    looks = _looks(all_cells)
    names = data.arm_names([data.arm_of(cell["params"]) for cell in all_cells])
    rows = max(len(group) for group in shown.values())
    columns = len(data.panels(cells))
    lines = -(-len(shown) // columns)
    figure, panels = style.panel_grid(report, f"{data.name_of(scene)}: time per pass (median of each)", columns, 4.6,
                                      0.6 + (1.0 + 0.24 * rows) * lines, rows=lines)
    # A row for each light count; places that are left over stay empty.
    order = sorted(shown, key=lambda key: counts.index(key[1]) if key[1] in counts else 0)
    for axes, (panel, count) in zip(panels, order):
        total = _panel(axes, shown[panel, count], looks, names, rows)
        axes.set_title(f"{panel.title}, {count} lights")
    for axes in panels[len(order):]:
        axes.set_axis_off()
    handles = [panels[0].barh([0], [0], **EDGE, **look) for look in looks.values()]
    panels[columns - 1].legend([*handles, total], [*looks, "all passes, with interval"], loc="upper left", bbox_to_anchor=(1.02, 1))
    return figure, None
