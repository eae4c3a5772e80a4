"""Which field of the G-buffer costs the error: one row per layout, one axes per field, at the largest light count."""

from . import report as data
from . import style

UNITS = {"deg": "degrees", "rel": "relative", "abs": "absolute"}
RELATIVE_TO = {"position": "the distance", "emissive": "the radiance"}
COLOR = style.LINE_COLORS[0]
MARKS = {"mean": {"marker": "o", "markersize": 5, "color": COLOR},
         "p99": {"marker": "|", "markersize": 9, "markeredgewidth": 1.6, "color": COLOR},
         "max": {"marker": "x", "markersize": 4, "color": style.FAINT}}
IMAGE_METRIC = "flip_mean"
MOST_TICKS = 5


def _layouts(cells):
    """{layout: its cell of the smallest image error}, the most exact first: what paths and HDR formats add is left out."""
    best = {}
    for cell in sorted(cells, key=lambda cell: data.image_error(cell, IMAGE_METRIC)[0]):
        best.setdefault(cell["params"]["layout"], cell)
    return best


def _unit(numbers):
    return next(key.removeprefix("mean_") for key in numbers if key.startswith("mean_"))


def _field_panel(axes, field, cells):
    """Dots of each layout that has the field; returns what the legend shows."""
    handles, shown = {}, []
    for row, cell in enumerate(cells):
        numbers = cell["error"]["fields"].get(field)
        if numbers is None:
            continue
        unit = _unit(numbers)
        values = {kind: numbers[f"{kind}_{unit}"] for kind in MARKS if numbers[f"{kind}_{unit}"] is not None}
        axes.plot(list(values.values()), [row] * len(values), color=COLOR, linewidth=0.6, alpha=0.5, zorder=1)
        for kind, value in values.items():
            handles[kind] = axes.plot([value], [row], linestyle="none", **MARKS[kind])[0]
        shown += values.values()
        axes.set_xlabel(UNITS.get(unit, unit) + (f" to {RELATIVE_TO[field]}" if unit == "rel" and field in RELATIVE_TO else ""))
    if shown:
        style.log_axis_from_zero(axes.xaxis, shown)
    axes.set_title(field.replace("_", " "))
    return handles


def _image_panel(axes, cells):
    errors = [data.image_error(cell, IMAGE_METRIC) for cell in cells]
    for row, (value, low, high) in enumerate(errors):
        axes.errorbar([value], [row], xerr=[[max(0, value - low)], [max(0, high - value)]], color="black", elinewidth=0.8,
                      marker="s")
    style.log_axis_from_zero(axes.xaxis, [end for value, low, high in errors for end in (max(low, 0.4 * value), high)])
    axes.set_title("picture")
    axes.set_xlabel("mean FLIP, with interval")


def draw(report, scene, cells, _paths):
    """A figure, or why there is none."""
    known = [cell for cell in cells if data.image_error(cell, IMAGE_METRIC) and cell["error"]["fields"]]
    if not known:
        return None, "no layout has field errors"
    panel, group = list(data.panels(known).items())[-1]
    layouts = _layouts(data.most_lights(group))
    rows = list(layouts.values())
    fields = list(dict.fromkeys(field for cell in rows for field in cell["error"]["fields"]))
    figure, panels = style.panel_grid(
        report, f"{data.name_of(scene)}: which field costs the error ({panel.title}, {rows[0]['params']['lights']} lights)",
        1 + len(fields), 2.2, 1.7 + 0.24 * len(rows))
    _image_panel(panels[0], rows)
    handles = {}
    for axes, field in zip(panels[1:], fields):
        handles |= _field_panel(axes, field, rows)
    for index, axes in enumerate(panels):
        axes.set_ylim(len(rows) - 0.5, -0.5)
        axes.set_yticks(range(len(rows)), [data.name_of(layout) for layout in layouts] if index == 0 else [""] * len(rows))
        axes.tick_params(axis="x", labelsize=7)
        style.thin_ticks(axes.xaxis, MOST_TICKS)
    panels[-1].legend([handles[kind] for kind in MARKS if kind in handles], [kind for kind in MARKS if kind in handles],
                      loc="upper left", bbox_to_anchor=(1.02, 1))
    return figure, None
