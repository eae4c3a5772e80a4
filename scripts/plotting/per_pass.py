"""What each pass costs: one stacked bar per arm, at the largest light count of each panel."""

from . import report as data
from . import style

UNATTRIBUTED = "unattributed"
EDGE = {"edgecolor": "white", "linewidth": 0.4}
UNATTRIBUTED_LOOK = {"color": "#cccccc", "hatch": ""}


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


def _bar(axes, row, cell, looks):
    left = 0.0
    for name, statistics in cell["statistics"]["passes"].items():
        # Time stamps of passes may overlap a little, which leaves less than nothing unattributed: no bar for that.
        width = max(0.0, data.estimate_ms(statistics)[0])
        axes.barh([row], [width], left=[left], **EDGE, **looks[name])
        left += width
    median, low, high = data.estimate_ms(cell["statistics"]["gpu_ns"])
    return axes.errorbar([median], [row], xerr=[[median - low], [high - median]], fmt="|", color="black", capsize=2,
                         elinewidth=0.8, markersize=8)


def _panel(axes, cells, looks, names, rows):
    """With room for so many `rows`; returns what the legend shows of the totals."""
    for row, cell in enumerate(cells):
        total = _bar(axes, row, cell, looks)
    axes.set_yticks(range(len(cells)), [names[data.arm_of(cell["params"])] for cell in cells])
    axes.set_ylim(rows - 0.4, -0.6)
    axes.grid(axis="y", visible=False)
    axes.set_xlim(left=0)
    axes.set_xlabel("GPU time per frame (ms)")
    return total


def draw(report, scene, cells, _paths):
    """A figure, or why there is none."""
    shown = {panel: data.most_lights(group) for panel, group in data.panels(cells).items()}
    all_cells = [cell for group in shown.values() for cell in group]
    looks = _looks(all_cells)
    names = data.arm_names([data.arm_of(cell["params"]) for cell in all_cells])
    rows = max(len(group) for group in shown.values())
    figure, panels = style.panel_grid(report, f"{data.name_of(scene)}: time per pass (median of each)", len(shown), 4.6,
                                      1.6 + 0.24 * rows)
    for axes, (panel, group) in zip(panels, shown.items()):
        total = _panel(axes, group, looks, names, rows)
        axes.set_title(f"{panel.title}, {group[0]['params']['lights']} lights")
    handles = [panels[-1].barh([0], [0], **EDGE, **look) for look in looks.values()]
    panels[-1].legend([*handles, total], [*looks, "all passes, with interval"], loc="upper left", bbox_to_anchor=(1.02, 1))
    return figure, None
