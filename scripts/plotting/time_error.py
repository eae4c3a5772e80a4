"""Time against error: every arm of a group with the front that no other beats, at the largest light count."""

import itertools
import math

from matplotlib import lines, ticker, transforms

from . import report as data
from . import style

FADED = 0.35
MARKER_ROOM_PX = 5


def _error(cell):
    return cell["error"]["display"]["rmse"]


def _error_axis(axes, errors):
    """Logarithmic, with a place for 0 below the smallest error there is."""
    positive = [error for error in errors if error > 0]
    if not positive:
        axes.set_ylim(-1, 1)
        axes.set_yticks([0])
        return
    if min(errors) > 0:
        style.log_axis(axes.yaxis, min(errors) / 1.15, max(errors) * 1.15)
    else:
        threshold = 10.0 ** math.floor(math.log10(min(positive)))
        axes.set_yscale("symlog", linthresh=threshold, linscale=0.4)
        axes.set_ylim(-0.2 * threshold, 1.5 * max(errors))
        axes.yaxis.set_minor_locator(ticker.NullLocator())
    axes.yaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:.3g}"))


def _candidates():
    """Offsets of a label's nearest corner from its point in px, the near ones first."""
    for radius, step in itertools.product((9, 20, 32, 46, 62, 80, 100), range(12)):
        angle = math.radians(30 * step + 20)
        yield radius * math.cos(angle), radius * math.sin(angle)


def _place_labels(figure, axes, labels):
    """Writes each (x, y, text, color, alpha) where it covers neither a point nor another label."""
    figure.canvas.draw()  # only a drawn figure knows its sizes
    renderer = figure.canvas.get_renderer()
    at = [axes.transData.transform((x, y)) for x, y, *_ in labels]
    taken = [transforms.Bbox.from_extents(px - MARKER_ROOM_PX, py - MARKER_ROOM_PX, px + MARKER_ROOM_PX,
                                          py + MARKER_ROOM_PX) for px, py in at]
    frame = axes.get_window_extent(renderer)
    for (px, py), (x, y, text, color, alpha) in zip(at, labels):
        note = axes.annotate(text, (x, y), xytext=(0, 0), textcoords="offset pixels", fontsize=7, color=color,
                             alpha=alpha, arrowprops={"arrowstyle": "-", "linewidth": 0.4, "color": color,
                                                      "alpha": alpha, "shrinkA": 0, "shrinkB": 3})
        box = note.get_window_extent(renderer)
        size = renderer.get_text_width_height_descent(text, note.get_fontproperties(), False)
        width, height = size[0], size[1]
        for dx, dy in _candidates():
            left = px + dx - (width if dx < 0 else 0)
            bottom = py + dy - height / 2
            box = transforms.Bbox.from_bounds(left, bottom, width, height)
            inside = frame.x0 <= box.x0 and box.x1 <= frame.x1 and frame.y0 <= box.y0 and box.y1 <= frame.y1
            if inside and not any(box.overlaps(other) for other in taken):
                break
        note.set_position((box.x0 - px, box.y0 - py))
        taken.append(box)


def _panel(axes, cells, pareto, styles):
    front = [cell for member in pareto["front"] for cell in cells if cell["id"] == member]
    shown = set(pareto["front"]) | set(pareto["dominated"])
    cells = [cell for cell in cells if cell["id"] in shown]
    several_hdr = len({cell["params"]["hdr"] for cell in cells}) > 1
    labels = []
    ends = []
    for cell in cells:
        arm = data.arm_of(cell["params"])
        alpha = 1.0 if cell["id"] in pareto["front"] else FADED
        wall = cell["statistics"]["wall_ns"]
        time, low, high = (None if wall[key] is None else wall[key] / style.NS_PER_MS for key in ("median", "low", "high"))
        low, high = time if low is None else low, time if high is None else high
        ends += [low, high]
        look = {**styles.line(arm), "linestyle": "none"}
        axes.errorbar([time], [_error(cell)], xerr=[[max(0, time - low)], [max(0, high - time)]], elinewidth=0.8, alpha=alpha, **look)
        text = data.name_of(arm.layout) if arm.layout else arm.path
        labels.append((time, _error(cell), f"{text}, {arm.hdr}" if several_hdr else text, styles.color(arm),
                       max(alpha, 0.7)))
    axes.plot([cell["statistics"]["wall_ns"]["median"] / style.NS_PER_MS for cell in front], [_error(cell) for cell in front],
              drawstyle="steps-post", color=style.FAINT, linewidth=1, linestyle="--", zorder=1)
    style.log_axis(axes.xaxis, min(ends), max(ends))
    _error_axis(axes, [_error(cell) for cell in cells])
    axes.set_xlabel("time per frame (ms)")
    axes.set_ylabel("RMSE of display values, against the control arm")
    return labels


def _legend(axes, arms, styles):
    paths = {arm.path: styles.color(arm) for arm in arms}
    handles = [lines.Line2D([], [], color=color, marker="o", linestyle="none", label=path) for path, color in paths.items()]
    handles.append(lines.Line2D([], [], color=style.FAINT, linestyle="--", linewidth=1, label="front: nothing is\nbetter in both"))
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1))


def draw(report, scene, cells):
    """A figure, or why there is none."""
    fronts = {entry["group"]: entry for entry in report["pareto"]}
    shown = {}
    for panel, group in data.panels([cell for cell in cells if cell["error"] and _error(cell) is not None]).items():
        group = data.most_lights(group)
        if len({cell["params"]["layout"] for cell in group} - {None}) > 1 and group[0]["group"] in fronts:
            shown[panel] = group
    if not shown:
        return None, "no group with an error for two layouts"
    arms = [data.arm_of(cell["params"]) for group in shown.values() for cell in group]
    styles = style.ArmStyles(arms)
    figure, panels = style.panel_grid(len(shown), 5.6, 4.4, f"{data.name_of(scene)}: time against error")
    labels = {}
    for axes, (panel, group) in zip(panels, shown.items()):
        labels[axes] = _panel(axes, group, fronts[group[0]["group"]], styles)
        axes.set_title(f"{panel.title}, {group[0]['params']['lights']} lights")
    _legend(panels[-1], arms, styles)
    for axes, entries in labels.items():
        _place_labels(figure, axes, entries)
    return figure, None
