"""Time against error: every arm of a group with the front that no other beats, at the largest light count."""

import itertools
import math

from matplotlib import font_manager, lines, patheffects, ticker, transforms

from . import report as data
from . import style

FADED = 0.35
MARKER_ROOM_PX = 6
BAR_ROOM_PX = 2
LABEL_POINTS = 7
LEADER_FROM_PX = 16
LABEL_RADII_PX = (12, 20, 30, 42, 56, 72, 90, 110, 135)


def _error(cell):
    return cell["error"]["display"]["rmse"]


def _time(cell):
    return data.estimate_ms(cell["statistics"]["wall_ns"])


def _error_axis(axes, errors):
    """Logarithmic, with a place for 0 below the smallest error there is."""
    positive = [error for error in errors if error > 0]
    if not positive:
        axes.set_ylim(-1, 1)
        axes.set_yticks([0])
    elif min(errors) > 0:
        style.log_axis(axes.yaxis, min(errors) / 1.1, max(errors) * 1.1)
    else:
        threshold = 10.0 ** math.floor(math.log10(min(positive)))
        axes.set_yscale("symlog", linthresh=threshold, linscale=0.4)
        axes.set_ylim(-0.3 * threshold, 1.5 * max(errors))
        axes.set_yticks([0, *style.round_ticks(min(positive), max(positive) * 1.4)])
        axes.yaxis.set_minor_locator(ticker.NullLocator())
        axes.yaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))


def _label_boxes(center, size):
    """Where a label may stand around its point, the near places first."""
    for radius, turn in itertools.product(LABEL_RADII_PX, range(16)):
        angle = math.radians(22.5 * turn + 45)
        dx, dy = 1.3 * radius * math.cos(angle), radius * math.sin(angle)
        left = center[0] + dx - size[0] * (0.5 - 0.5 * math.cos(angle))
        bottom = center[1] + dy - size[1] * (0.5 - 0.5 * math.sin(angle))
        yield transforms.Bbox.from_bounds(left, bottom, *size)


def _around(x0, y0, x1, y1, room):
    return transforms.Bbox.from_extents(x0 - room, y0 - room, x1 + room, y1 + room)


def _write(axes, point, text, color, center, box):
    """The label in its box, and a line to its point where that is not beside it."""
    points_per_px = 72 / axes.figure.dpi
    halo = [patheffects.withStroke(linewidth=2, foreground="white")]
    offset = ((box.x0 - center[0]) * points_per_px, (box.y0 - center[1]) * points_per_px)
    axes.annotate(text, point, xytext=offset, textcoords="offset points", fontsize=LABEL_POINTS, color=color, zorder=6,
                  path_effects=halo)
    nearest = (min(max(center[0], box.x0), box.x1) - center[0], min(max(center[1], box.y0), box.y1) - center[1])
    if math.hypot(*nearest) > LEADER_FROM_PX:
        axes.annotate("", point, xytext=[px * points_per_px for px in nearest], textcoords="offset points", zorder=5,
                      arrowprops={"arrowstyle": "-", "linewidth": 0.5, "color": color, "shrinkA": 0, "shrinkB": 3})


def _place_labels(figure, axes, labels):
    """Writes each label (x, (low x, high x), y, text, color) where it covers no point and no other label, and no interval
    if there is room for that."""
    figure.canvas.draw()  # only a drawn figure knows its sizes
    renderer = figure.canvas.get_renderer()
    frame = axes.get_window_extent(renderer)
    to_px = axes.transData.transform
    centers = [to_px((x, y)) for x, _, y, *_ in labels]
    taken = [_around(*center, *center, MARKER_ROOM_PX) for center in centers]
    bars = [_around(*to_px((low, y)), *to_px((high, y)), BAR_ROOM_PX) for _, (low, high), y, *_ in labels]
    font = font_manager.FontProperties(size=LABEL_POINTS)
    for center, (x, _, y, text, color) in zip(centers, labels):
        size = renderer.get_text_width_height_descent(text, font, False)[:2]
        boxes = [box for box in _label_boxes(center, size) if frame.x0 <= box.x0 and box.x1 <= frame.x1
                 and frame.y0 <= box.y0 and box.y1 <= frame.y1]
        free = (box for obstacles in (taken + bars, taken) for box in boxes
                if not any(box.overlaps(other) for other in obstacles))
        box = next(free, boxes[0])
        _write(axes, (x, y), text, color, center, box)
        taken.append(box)


def _panel(axes, cells, front_ids, styles):
    """Returns the labels to place."""
    several_hdr = len({cell["params"]["hdr"] for cell in cells}) > 1
    labels = []
    for cell in cells:
        arm = data.arm_of(cell["params"])
        time, low, high = _time(cell)
        axes.errorbar([time], [_error(cell)], xerr=[[time - low], [high - time]], elinewidth=0.8, linestyle="none",
                      color=styles.color(arm), marker=styles.marker(arm), alpha=1.0 if cell["id"] in front_ids else FADED)
        text = data.name_of(arm.layout) if arm.layout else arm.path
        labels.append((time, (low, high), _error(cell), f"{text}, {arm.hdr}" if several_hdr else text, styles.color(arm)))
    front = [cell for member in front_ids for cell in cells if cell["id"] == member]
    axes.plot([_time(cell)[0] for cell in front], [_error(cell) for cell in front], drawstyle="steps-post",
              color="black", linewidth=1, linestyle="--", zorder=2.5)
    style.log_axis(axes.xaxis, min(_time(cell)[1] for cell in cells), max(_time(cell)[2] for cell in cells))
    _error_axis(axes, [_error(cell) for cell in cells])
    axes.set_xlabel("time per frame (ms)")
    axes.set_ylabel("error (RMSE of display values)")
    return labels


def _legend(axes, arms, styles):
    paths = {arm.path: styles.color(arm) for arm in arms}
    handles = [lines.Line2D([], [], color=color, marker="s", linestyle="none", label=path) for path, color in paths.items()]
    handles.append(lines.Line2D([], [], color="black", linestyle="--", linewidth=1, label="front: nothing beats\nit in both"))
    handles.append(lines.Line2D([], [], color=style.FAINT, marker="s", linestyle="none", alpha=FADED, label="faded: beaten"))
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1))


def draw(report, scene, cells, paths):
    """A figure, or why there is none."""
    fronts = {entry["group"]: entry["front"] for entry in report["pareto"]}
    shown = {}
    for panel, group in data.panels([cell for cell in cells if cell["error"] and _error(cell) is not None]).items():
        group = data.most_lights(group)
        if len({cell["params"]["layout"] for cell in group} - {None}) > 1 and group[0]["group"] in fronts:
            shown[panel] = group
    if not shown:
        return None, "no group has an error for two layouts"
    arms = [data.arm_of(cell["params"]) for group in shown.values() for cell in group]
    styles = style.ArmStyles(paths, arms)
    figure, panels = style.panel_grid(report, f"{data.name_of(scene)}: time against error, compared with the control arm",
                                      len(shown), 5.2, 4.6)
    labels = {}
    for axes, (panel, group) in zip(panels, shown.items()):
        labels[axes] = _panel(axes, group, fronts[group[0]["group"]], styles)
        axes.set_title(f"{panel.title}, {group[0]['params']['lights']} lights")
    _legend(panels[-1], arms, styles)
    for axes, of_panel in labels.items():
        _place_labels(figure, axes, of_panel)
    return figure, None
