"""Where each arm errs: the FLIP maps beside a report, as one sheet, at the largest light count. Most errors are small: all maps
share one logarithmic scale that ends at the largest and shows what is well below it."""

import matplotlib
import numpy
from matplotlib import pyplot

from . import report as data
from . import style

METRIC = "flip_mean"
COLUMNS = 4
TILE_WIDTH_IN = 2.6
LEAST = 1e-4  # what is smaller has the lowest colour; a map's own steps are 1.5e-5
LEAST_LARGEST = 1e-2


def _read(file, panel):
    """The map's values."""
    values = pyplot.imread(file)  # of grey PNGs shares of the largest number, as floats
    if values.shape != (panel.height_px, panel.width_px):
        raise ValueError(f"{file.name} is not a grey picture of {panel.width_px}x{panel.height_px}")
    return values


def _largest(maps):
    """The largest value worth showing: single pixels may go beyond."""
    return max([LEAST_LARGEST, *(numpy.percentile(values, 99.9) for values in maps)])


def _title(cell, name):
    nonfinite = cell["error"]["reference"]["display"]["nonfinite_px"]
    return (f"{name}\nmean FLIP {data.image_error(cell, METRIC)[0]:.2g}"
            + (f", {nonfinite:g} px not finite" if nonfinite else ""))


def draw(report, scene, cells, _paths, folder):
    """A figure, or why there is none. `folder`: where the maps are, each named by its cell."""
    known = [cell for cell in cells if data.image_error(cell, METRIC) and (folder / f"{cell['id']}.png").is_file()]
    if not known:
        return None, f"no map in {folder}; `lightsweep run --maps` writes them"
    panel, group = list(data.panels(known).items())[-1]
    group = sorted(data.most_lights(group), key=lambda cell: data.image_error(cell, METRIC)[0])
    names = data.arm_names([data.arm_of(cell["params"]) for cell in group])
    try:
        maps = [_read(folder / f"{cell['id']}.png", panel) for cell in group]
    except (OSError, SyntaxError, ValueError) as error:
        raise data.ReportError(f"{folder}: a map cannot be read: {error}") from error
    columns = min(COLUMNS, len(group))
    tile_height = TILE_WIDTH_IN * panel.height_px / panel.width_px + 0.35
    title = f"{data.name_of(scene)}: FLIP maps ({panel.title}, {group[0]['params']['lights']} lights)"
    figure, grid = style.panel_grid(report, title, columns, TILE_WIDTH_IN, 1.0 + tile_height * -(-len(group) // columns),
                                    rows=-(-len(group) // columns))
    largest = _largest(maps)
    norm = matplotlib.colors.LogNorm(LEAST, largest)
    for axes in grid:
        axes.set_axis_off()
    for axes, cell, values in zip(grid, group, maps):
        shown = axes.imshow(numpy.maximum(values, LEAST), cmap="magma", norm=norm, interpolation="nearest")
        axes.set_title(_title(cell, names[data.arm_of(cell["params"])]), fontsize=8)
    figure.colorbar(shown, ax=grid, shrink=0.6, label="FLIP", extend="both" if largest < 1 else "min")
    return figure, None
