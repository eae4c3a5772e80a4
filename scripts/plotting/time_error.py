"""Time against error: every arm of a group, and how sure it is that another beats it, at the largest light count."""

import itertools
import math

from matplotlib import font_manager, lines, patheffects, transforms

from . import report as data
from . import style

# The errors that can be drawn, all of the display picture against the reference, all better when smaller.
METRICS = {
    "flip_mean": "mean FLIP",
    "flip_max": "largest FLIP",
    "rmse": "RMSE of display values",
    "mrse": "mean relative squared error",
    "max_abs": "largest absolute difference",
    "max_rel": "largest relative difference",
    "rel_p50": "median relative difference",
    "rel_p99": "99th percentile of the relative difference",
}
LOOKS = {"front": {}, "perhaps": {"markerfacecolor": "white"}, "dominated": {"alpha": 0.35}}  # on top of the arm's style
NAMES = {"perhaps": "perhaps: not surely\nbeaten", "dominated": "faded: surely beaten"}
MARKER_ROOM_PX = 6
BAR_ROOM_PX = 2
LABEL_POINTS = 7
LEADER_FROM_PX = 16
LABEL_RADII_PX = (12, 20, 30, 42, 56, 72, 90, 110, 135, 165)
SHOWN_OF_LOW_END = 0.4


def _time(cell):
    return data.estimate_ms(cell["statistics"]["wall_ns"])


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
    """Writes each label (time, error, text, color), both coordinates with their ends, where it covers no point and no other
    label, and no interval if there is room for that."""
    figure.canvas.draw()  # only a drawn figure knows its sizes
    renderer = figure.canvas.get_renderer()
    frame = axes.get_window_extent(renderer)
    to_px = axes.transData.transform
    centers = [to_px((time[0], error[0])) for time, error, *_ in labels]
    taken = [_around(*center, *center, MARKER_ROOM_PX) for center in centers]
    bars = [_around(*to_px((time[1], error[0])), *to_px((time[2], error[0])), BAR_ROOM_PX) for time, error, *_ in labels]
    bars += [_around(*to_px((time[0], _shown_low(error))), *to_px((time[0], error[2])), BAR_ROOM_PX)
             for time, error, *_ in labels]
    font = font_manager.FontProperties(size=LABEL_POINTS)
    for center, (time, error, text, color) in zip(centers, labels):
        size = renderer.get_text_width_height_descent(text, font, False)[:2]
        boxes = [box for box in _label_boxes(center, size) if frame.x0 <= box.x0 and box.x1 <= frame.x1
                 and frame.y0 <= box.y0 and box.y1 <= frame.y1]
        free = (box for obstacles in (taken + bars, taken) for box in boxes
                if not any(box.overlaps(other) for other in obstacles))
        box = next(free, boxes[0])
        _write(axes, (time[0], error[0]), text, color, center, box)
        taken.append(box)


def _shown_low(error):
    """An interval that comes near 0 would take all of a logarithmic axis."""
    return max(error[1], SHOWN_OF_LOW_END * error[0])


def _panel(axes, cells, metric, styles, states):
    """Returns the labels to place, those of the front first."""
    cells = [cell for cell in cells if cell["id"] in states]  # path=auto draws what another arm draws
    several_hdr = len({cell["params"]["hdr"] for cell in cells}) > 1
    labels = []
    points = [(_time(cell), data.image_error(cell, metric)) for cell in cells]
    front = sorted((index for index, cell in enumerate(cells) if states[cell["id"]] == "front"),
                   key=lambda index: points[index][0][0])
    for cell, (time, error) in zip(cells, points):
        arm = data.arm_of(cell["params"])
        axes.errorbar([time[0]], [error[0]], xerr=[[time[0] - time[1]], [time[2] - time[0]]],
                      yerr=[[max(0, error[0] - error[1])], [max(0, error[2] - error[0])]], elinewidth=0.8, linestyle="none",
                      color=styles.color(arm), marker=styles.marker(arm), **LOOKS[states[cell["id"]]])
        words = [data.name_of(arm.layout) if arm.layout else arm.path] + [arm.hdr] * several_hdr + data.switches_of(arm)
        labels.append((time, error, ", ".join(words), styles.color(arm)))
    axes.plot([points[index][0][0] for index in front], [points[index][1][0] for index in front], drawstyle="steps-post",
              color="black", linewidth=1, linestyle="--", zorder=2.5)
    style.log_axis(axes.xaxis, min(time[1] for time, _ in points), max(time[2] for time, _ in points))
    style.log_axis_from_zero(axes.yaxis, [end for _, error in points for end in (_shown_low(error), error[2])])
    axes.set_xlabel("time per frame (ms)")
    axes.set_ylabel(f"error: {METRICS[metric]}")
    return [labels[index] for index in front] + [label for index, label in enumerate(labels) if index not in front]


def _legend(axes, arms, styles):
    paths = {arm.path: styles.color(arm) for arm in arms}
    handles = [lines.Line2D([], [], color=color, marker="s", linestyle="none", label=path) for path, color in paths.items()]
    handles.append(lines.Line2D([], [], color="black", linestyle="--", linewidth=1, label="front (by the estimates)"))
    handles += [lines.Line2D([], [], color=style.FAINT, marker="s", linestyle="none", label=name, **LOOKS[state])
                for state, name in NAMES.items()]
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1))


def draw(report, scene, cells, paths, metric):
    """A figure, or why there is none. `metric`: one of METRICS."""
    shown = {}
    for panel, group in data.panels([cell for cell in cells if data.image_error(cell, metric)]).items():
        group = data.most_lights(group)
        if len(group) > 1:
            shown[panel] = group
    if not shown:
        return None, f"no two arms of a group have a {metric} against the reference"
    arms = [data.arm_of(cell["params"]) for group in shown.values() for cell in group]
    styles = style.ArmStyles(paths, arms)
    crowded = max(len(group) for group in shown.values()) > 10
    figure, panels = style.panel_grid(report, f"{data.name_of(scene)}: time against error, compared with the reference",
                                      len(shown), 7.0 if crowded else 5.2, 5.8 if crowded else 4.6)
    labels = {}
    for axes, (panel, group) in zip(panels, shown.items()):
        labels[axes] = _panel(axes, group, metric, styles, data.front_states(report, group, metric))
        axes.set_title(f"{panel.title}, {group[0]['params']['lights']} lights")
    _legend(panels[-1], arms, styles)
    for axes, of_panel in labels.items():
        _place_labels(figure, axes, of_panel)
    return figure, None
