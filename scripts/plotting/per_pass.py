"""What each pass costs: one stacked bar per arm, at the largest light count of each panel."""

from . import report as data
from . import style

UNATTRIBUTED = "unattributed"
UNATTRIBUTED_COLOR = "#cccccc"


def _pass_names(cells):
    names = list(dict.fromkeys(name for cell in cells for name in cell["statistics"]["passes"]))
    return [name for name in names if name != UNATTRIBUTED] + [UNATTRIBUTED]


def _pass_styles(names):
    looks = {name: {"color": style.COLORS[i % len(style.COLORS)], "hatch": style.HATCHES[i % len(style.HATCHES)]}
             for i, name in enumerate(names)}
    looks[UNATTRIBUTED] = {"color": UNATTRIBUTED_COLOR, "hatch": ""}
    return looks


def _panel(axes, cells, looks, names):
    rows = range(len(cells))
    left = [0.0] * len(cells)
    for name, look in looks.items():
        # Time stamps of passes may overlap a little, which leaves less than nothing unattributed: no bar for that.
        widths = [max(0.0, cell["statistics"]["passes"].get(name, {"median": 0.0})["median"]) / style.NS_PER_MS
                  for cell in cells]
        axes.barh(rows, widths, left=left, label=name, edgecolor="white", linewidth=0.4, **look)
        left = [start + width for start, width in zip(left, widths)]
    for row, cell in zip(rows, cells):
        gpu = cell["statistics"]["gpu_ns"]
        low, high = (gpu["median"] if gpu[end] is None else gpu[end] for end in ("low", "high"))
        error = [[max(0.0, gpu["median"] - low) / style.NS_PER_MS], [max(0.0, high - gpu["median"]) / style.NS_PER_MS]]
        axes.errorbar([gpu["median"] / style.NS_PER_MS], [row], xerr=error, fmt="|", color="black", capsize=2,
                      elinewidth=0.8, markersize=8, label="all passes, with interval" if row == 0 else None)
    axes.set_yticks(rows, [names[data.arm_of(cell["params"])] for cell in cells])
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.set_xlim(left=0)
    axes.set_xlabel("GPU time per frame (ms), median of each pass")


def draw(report, scene, cells):
    """A figure, or why there is none."""
    shown = {panel: data.most_lights(group) for panel, group in data.panels(cells).items()}
    all_cells = [cell for group in shown.values() for cell in group]
    looks = _pass_styles(_pass_names(all_cells))
    names = data.arm_names([data.arm_of(cell["params"]) for cell in all_cells])
    rows = max(len(group) for group in shown.values())
    figure, panels = style.panel_grid(len(shown), 5.6, 1.5 + 0.26 * rows, f"{data.name_of(scene)}: time per pass")
    for axes, (panel, group) in zip(panels, shown.items()):
        _panel(axes, group, looks, names)
        axes.set_title(f"{panel.title}, {group[0]['params']['lights']} lights")
    panels[-1].legend(loc="upper left", bbox_to_anchor=(1.02, 1))
    return figure, None
