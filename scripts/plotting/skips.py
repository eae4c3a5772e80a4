"""What each skip saves: a pair of bars for each, turned off where all others are on, and on where all others are off."""

from . import report as data
from . import style

SIDES = {"all": ("off from all", {"color": style.LINE_COLORS[0]}),
         "none": ("on from none", {"color": style.LINE_COLORS[5], "hatch": "///", "edgecolor": "white", "linewidth": 0.4})}
WHOLE_SETS = ("all", "auto")
BAR_HEIGHT = 0.38
MOST_COLUMNS = 3
LEFT_OF_BARS = 30  # per cent: intervals that end farther off would take all of the axis


def _saved(entry):
    """(per cent of the time without it, low, high), or None without a time"""
    if entry["ratio"] is None:
        return None
    middle, low, high = data.filled(entry["ratio"], entry["low"], entry["high"])
    return tuple(100 * (1 - value) for value in (middle, high, low))


def _by_arm(report, scene):
    """{(panel, light count, arm): its entries}"""
    shown = {}
    for entry in report.get("skips", []):
        if entry["scene"] == scene:
            arm = data.arm_of(entry)._replace(skip=data.EVERY_SKIP)
            shown.setdefault((data.panel_of(entry), entry["lights"], arm), []).append(entry)
    return {key: entries for key, entries in shown.items() if any(entry["others"] in SIDES for entry in entries)}


def _switches(entries):
    """The skips by themselves, in the report's order."""
    return list(dict.fromkeys(entry["skip"] for entry in entries if entry["skip"] not in WHOLE_SETS))


def _bar(axes, row, entry, look):
    """Returns what the legend shows."""
    saved = _saved(entry)
    if entry["same_work"] or saved is None:
        words = "same work" if entry["same_work"] else "no time"
        axes.annotate(words, (0, row), xytext=(3, 0), textcoords="offset points", va="center", fontsize=6.5, color=style.FAINT)
        return axes.barh([row], [0], height=BAR_HEIGHT, **look)
    middle, low, high = saved
    return axes.barh([row], [middle], height=BAR_HEIGHT, xerr=[[middle - low], [high - middle]],
                     error_kw={"elinewidth": 0.8, "capsize": 1.5}, **look)


def _panel(axes, entries, switches):
    """Returns {label: handle}."""
    handles = {}
    floor = next((entry["floor"] for entry in entries if entry["floor"] is not None), None)
    if floor is not None:
        handles["noise floor"] = axes.axvspan(-100 * floor, 100 * floor, color="#dddddd", zorder=0)
    for entry in entries:
        if entry["skip"] in switches and entry["others"] in SIDES:
            label, look = SIDES[entry["others"]]
            side = 0.5 if entry["others"] == "none" else -0.5
            handles[label] = _bar(axes, switches.index(entry["skip"]) + side * BAR_HEIGHT, entry, look)
    axes.axvline(0, color=style.FAINT, linewidth=0.8)
    axes.set_yticks(range(len(switches)), switches)
    axes.set_ylim(len(switches) - 0.4, -0.6)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("time saved (% of the frame without it)")
    return handles


def _limits(entries):
    """Of the axis that all panels share, in per cent."""
    saved = [_saved(entry) for entry in entries if entry["ratio"] is not None and entry["others"] in SIDES] or [(0, 0, 0)]
    leftmost = min(0, *(middle for middle, _, _ in saved)) - LEFT_OF_BARS
    return max(leftmost, min(-5, *(low for _, low, _ in saved))), min(100, max(5, *(high for _, _, high in saved))) + 2


def _title(name, entries):
    """With what whole sets of skips save."""
    lines = [name]
    for entry in entries:
        saved = _saved(entry) if entry["skip"] in WHOLE_SETS else None
        if saved:
            lines.append(f"{entry['skip']} against none: {saved[0]:.0f} % saved [{saved[1]:.0f}, {saved[2]:.0f}]")
    return "\n".join(lines)


def draw(report, scene, _cells, _paths):
    """A figure, or why there is none."""
    shown = _by_arm(report, scene)
    if not shown:
        return None, "no two cells differ in one skip, or in all of them"
    names = data.arm_names([arm for _, _, arm in shown])
    switches = {key: _switches(entries) for key, entries in shown.items()}
    columns = min(MOST_COLUMNS, len(shown))
    lines = -(-len(shown) // columns)
    height = 0.7 + (1.1 + 0.3 * max(len(rows) for rows in switches.values())) * lines
    figure, panels = style.panel_grid(report, f"{data.name_of(scene)}: what each skip saves", columns, 4.4, height, rows=lines)
    limits = _limits([entry for key, entries in shown.items() for entry in entries if entry["skip"] in switches[key]])
    handles = {}
    for axes, (key, entries) in zip(panels, shown.items()):
        panel, lights, arm = key
        handles |= _panel(axes, entries, switches[key])
        axes.set_xlim(limits)
        axes.set_title(_title(f"{names[arm]}, {panel.title}, {lights} lights", entries))
    for axes in panels[len(shown):]:
        axes.set_axis_off()
    panels[columns - 1].legend(list(handles.values()), list(handles), loc="upper left", bbox_to_anchor=(1.02, 1))
    return figure, None
