"""Where each arm errs: the FLIP maps beside a report, as one sheet, at the largest light count. The maps as written go from 0
to 1, and most errors are small: here all have one scale that ends at the largest and spreads the small ones."""

import matplotlib
import numpy
from matplotlib import pyplot

from . import report as data
from . import style

METRIC = "flip_mean"
LUMA = numpy.array((0.2126, 0.7152, 0.0722))
COLUMNS = 4
TILE_WIDTH_IN = 2.6
NONFINITE = "#00ff00"
LEAST_SCALE = 0.02
SPREAD = 0.5  # exponent of the colour scale


def _read(file):
    """The map's values, from its colours: magma's luma rises with the value. Not finite where the picture is green."""
    rgb = pyplot.imread(file)[..., :3]
    legend = matplotlib.colormaps["magma"](numpy.linspace(0, 1, 256))[:, :3] @ LUMA
    values = numpy.interp(rgb @ LUMA, legend, numpy.linspace(0, 1, 256))
    green = (rgb[..., 1] > 0.9) & (rgb[..., 0] < 0.1) & (rgb[..., 2] < 0.1)
    return numpy.where(green, numpy.nan, values)


def _scale(maps):
    """The largest value worth showing: single pixels may go beyond."""
    finite = [values[numpy.isfinite(values)] for values in maps]
    return max([LEAST_SCALE, *(numpy.percentile(values, 99.9) for values in finite if values.size)])


def draw(report, scene, cells, _paths, folder):
    """A figure, or why there is none. `folder`: where the maps are, each named by its cell."""
    known = [cell for cell in cells if data.image_error(cell, METRIC) and (folder / f"{cell['id']}.png").is_file()]
    if not known:
        return None, f"no map in {folder}; `lightsweep run --maps` writes them"
    panel, group = list(data.panels(known).items())[-1]
    group = sorted(data.most_lights(group), key=lambda cell: data.image_error(cell, METRIC)[0])
    names = data.arm_names([data.arm_of(cell["params"]) for cell in group])
    try:
        maps = [_read(folder / f"{cell['id']}.png") for cell in group]
    except (OSError, SyntaxError, ValueError) as error:
        raise data.ReportError(f"{folder}: a map cannot be read: {error}") from error
    columns = min(COLUMNS, len(group))
    tile_height = TILE_WIDTH_IN * panel.height_px / panel.width_px + 0.35
    title = f"{data.name_of(scene)}: FLIP maps ({panel.title}, {group[0]['params']['lights']} lights)"
    figure, grid = style.panel_grid(report, title, columns, TILE_WIDTH_IN, 1.0 + tile_height * -(-len(group) // columns),
                                    rows=-(-len(group) // columns))
    colors = matplotlib.colormaps["magma"].with_extremes(bad=NONFINITE)
    scale = _scale(maps)
    norm = matplotlib.colors.PowerNorm(SPREAD, vmin=0, vmax=scale)
    for axes in grid:
        axes.set_axis_off()
    for axes, cell, values in zip(grid, group, maps):
        shown = axes.imshow(values, cmap=colors, norm=norm, interpolation="nearest")
        axes.set_title(f"{names[data.arm_of(cell['params'])]}\nmean FLIP {data.image_error(cell, METRIC)[0]:.2g}", fontsize=8)
    figure.colorbar(shown, ax=grid, shrink=0.6, label="FLIP", extend="max" if scale < 1 else "neither")
    return figure, None
