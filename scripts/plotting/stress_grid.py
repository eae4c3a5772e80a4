"""The breakdown tables as heat maps: arms against cases, the darker the earlier an arm leaves its bound."""

import textwrap

import matplotlib
from matplotlib import patches

from . import stress_data as data
from . import style

CELL_WIDTH_IN, CELL_HEIGHT_IN = 0.55, 0.24
LETTER_IN = 0.062
LIMITS = matplotlib.colormaps["YlOrBr"]
PASS, FAIL, SKIPPED = "#d9ead3", "#C00000", "#eeeeee"
TITLE_LETTERS = 44
SMALL_COLUMNS, SMALL_WIDTH = 3, 6  # panels side by side, and the cells that each has room for


def _look(entry):
    """(face colour, text, text colour)"""
    status = entry["status"]
    number = "" if entry["breakdown"] is None else data.short_number(entry["breakdown"])
    if status == "skipped":
        return SKIPPED, "\u2013", style.FAINT
    if status == "pass":
        return PASS, "", "black"
    if status == "fail":
        return FAIL, number or "fail", "white"
    share = data.share_reached(entry)
    return LIMITS(0.15 + 0.6 * (1 - share)), number or "limit", "black" if share > 0.3 else "white"


def _draw(axes, grid, columns):
    """With room for so many `columns`."""
    for row, name in enumerate(grid.rows):
        for column, case in enumerate(grid.columns):
            entry = grid.cells.get((name, case))
            if entry is None:
                continue
            face, text, color = _look(entry)
            axes.add_patch(patches.Rectangle((column - 0.5, row - 0.5), 1, 1, facecolor=face, edgecolor="white", linewidth=0.8))
            axes.text(column, row, text, ha="center", va="center", fontsize=6, color=color)
    axes.set_xlim(-0.5, max(columns, len(grid.columns)) - 0.5)
    axes.set_ylim(len(grid.rows) - 0.5, -0.5)
    axes.set_xticks(range(len(grid.columns)), grid.columns, fontsize=7, rotation=0 if max(map(len, grid.columns)) < 5 else 25,
                    ha="center" if max(map(len, grid.columns)) < 5 else "left")
    axes.set_yticks(range(len(grid.rows)), grid.rows, fontsize=7)
    axes.tick_params(length=0)
    axes.xaxis.tick_top()
    axes.grid(visible=False)
    for spine in axes.spines.values():
        spine.set_visible(False)
    axes.set_title(textwrap.fill(grid.title, TITLE_LETTERS), fontsize=9, loc="left")


def _legend(figure, title_lines=1):
    looks = [(PASS, "within the bound"), (LIMITS(0.2), "limit of the format, late"), (LIMITS(0.75), "limit, early"),
             (FAIL, "fail"), (SKIPPED, "refused")]
    style.legend_below_title(figure, [patches.Patch(facecolor=color, label=label) for color, label in looks], title_lines)


def _width_in(grid):
    return max(map(len, grid.rows)) * LETTER_IN + CELL_WIDTH_IN * len(grid.columns) + 0.4


def draw(run):
    """Paths and layouts: a figure, or why there is none."""
    grids = [grid for table in ("paths", "layouts") if (grid := data.arms_by_cases(run, table))]
    if not grids:
        return None, "no arm is a path or a layout alone"
    heights = [0.9 + CELL_HEIGHT_IN * len(grid.rows) for grid in grids]
    columns = max(len(grid.columns) for grid in grids)
    figure, panels = style.panel_grid(run, "Where each arm leaves its bound\n", 1, max(map(_width_in, grids)), 1.2 + sum(heights),
                                      rows=len(grids), heights=heights)
    for axes, grid in zip(panels, grids):
        _draw(axes, grid, columns)
    _legend(figure)
    return figure, None


def draw_others(run):
    """Cases with axes of their own, but for those that pass on every arm: a figure, or why there is none."""
    every_grid = data.other_cases(run)
    grids = [grid for grid in every_grid if any(entry["status"] != "pass" for entry in grid.cells.values())]
    if not grids:
        return None, "no case with axes of its own leaves its bound"
    shown = {entry["id"] for grid in grids for entry in grid.cells.values()}
    passed = dict.fromkeys(entry["id"] for grid in every_grid for entry in grid.cells.values() if entry["id"] not in shown)
    grids.sort(key=lambda grid: len(grid.rows))  # panels of one line are about as high
    columns = min(SMALL_COLUMNS, len(grids))
    lines = [grids[i:i + columns] for i in range(0, len(grids), columns)]
    heights = [0.9 + CELL_HEIGHT_IN * max(len(grid.rows) for grid in line) for line in lines]
    title = "Where each arm leaves its bound: cases with axes of their own"
    if passed:
        title += f"\n(within it on every arm: {', '.join(passed)})"
    figure, panels = style.panel_grid(run, title + "\n", columns,
                                      max(4.5, *map(_width_in, grids)), 1.0 + sum(heights), rows=len(lines), heights=heights)
    for axes, grid in zip(panels, grids):
        _draw(axes, grid, SMALL_WIDTH)
    for axes in panels[len(grids):]:
        axes.set_axis_off()
    _legend(figure, 2 if passed else 1)
    return figure, None
