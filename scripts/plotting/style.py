"""How every picture looks: colours that the colour-blind can tell apart, each with a marker of its own, and axes."""

import math
import textwrap

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot, ticker  # noqa: E402  (the backend comes first)

from .report import EVERY_SKIP, switches_of  # noqa: E402

# Okabe and Ito, "Color Universal Design", 2008. Their yellow is too light for a line on white, their black too heavy for a bar.
_HUES = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")
LINE_COLORS = (*_HUES, "#000000")
BAR_COLORS = (*_HUES, "#F0E442")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*", "<", ">", "p", "h")
LINES = ("-", "--", ":", "-.")
HATCHES = ("", "///", "...", "\\\\\\", "xx", "++", "--")
FAINT = "#666666"
MIN_WIDTH_IN = 6.5
FOOTER_POINTS = 6.5

matplotlib.rcParams.update({
    "figure.dpi": 150,
    "font.size": 9,
    "axes.titlesize": 10,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "lines.linewidth": 1.4,
    "lines.markersize": 5,
    "hatch.linewidth": 0.4,
    # The same report gives the same bytes.
    "svg.hashsalt": "lightsweep",
})


# A path's colour says how it finds its lights, its line which family it is of: twins share the colour. Other paths than these get
# the colours that are left.
PATH_COLORS = {
    "forward": "#000000", "deferred": "#000000",
    "forward_prepass": "#777777",
    "forward_multipass": "#E69F00", "deferred_scissor": "#E69F00",
    "deferred_volumes": "#D55E00", "light_prepass": "#CC79A7",
    "forward_tiled": "#0072B2", "deferred_tiled": "#0072B2",
    "forward_clustered": "#009E73", "deferred_clustered": "#009E73",
    "visibility": "#56B4E9", "auto": "#7F0000",
}
FAMILY_LINES = {"forward": "-", "deferred": "--"}
OTHER_FAMILY_LINE = ":"
PATH_MARKERS = dict(zip(PATH_COLORS, MARKERS))


def _all_different(paths, table, choices):
    """{path: its entry in the table, or a choice that no path of the table has, as far as they go}"""
    left = [choice for choice in choices if choice not in {table[path] for path in paths if path in table}] or choices
    others = [path for path in paths if path not in table]
    return {path: table[path] for path in paths if path in table} | {
        path: left[i % len(left)] for i, path in enumerate(others)}


class ArmStyles:
    """Colour by path; a marker for each arm; the line by layout, light lists, HDR format, skips, guards and sums where they
    differ, else by the path's family. The colours go by `paths`, which all the pictures of a report share; the rest tells the `arms` of
    one apart."""

    def __init__(self, paths, arms):
        arms = list(dict.fromkeys(arms))
        variants = list(dict.fromkeys(self._variant(arm) for arm in arms
                                      if arm.layout or arm.skip != EVERY_SKIP or switches_of(arm)))
        several = len(arms) > len({arm.path for arm in arms})
        self._color = _all_different(paths, PATH_COLORS, LINE_COLORS)
        self._line = {variant: LINES[i % len(LINES)] for i, variant in enumerate(variants)} if several else None
        markers = _all_different([arm.path for arm in arms], PATH_MARKERS, MARKERS)
        self._marker = {arm: MARKERS[i % len(MARKERS)] if several else markers[arm.path] for i, arm in enumerate(arms)}

    @staticmethod
    def _variant(arm):
        return arm.layout, arm.light_lists, arm.hdr, arm.skip, arm.guards, arm.sums

    def color(self, arm):
        return self._color[arm.path]

    def marker(self, arm):
        return self._marker[arm]

    def line(self, arm):
        """Keyword arguments for `plot`."""
        family = FAMILY_LINES.get(arm.path.split("_")[0], OTHER_FAMILY_LINE)
        look = family if self._line is None else self._line.get(self._variant(arm), "-")
        return {"color": self.color(arm), "marker": self.marker(arm), "linestyle": look}


def _footer(report):
    """Where the numbers come from: no picture goes without."""
    environment, run = report["environment"], report["run"]
    commit = f" ({run['git_commit'][:10]})" if run["git_commit"] else ""
    parts = [f"{environment['gl_renderer']} on {environment['cpu']}, {environment['cores']} cores"]
    if "timer" in report:  # a stress run times nothing
        floor = report["noise"]["floor"]
        noise = "unknown" if floor is None else f"{100 * floor:.1f} %"
        parts += [f"timer: {report['timer']['method']}", f"noise floor: {noise}", "intervals: 95 %"]
    return "  |  ".join([*parts, f"lightsweep {run['version']}{commit}"])


def panel_grid(report, title, columns, width_in, height_in, rows=1, heights=None):
    """A figure of that height with `columns` axes of that width side by side, in so many rows, as a list. `heights`: of the rows,
    in proportion."""
    width = max(width_in * columns, MIN_WIDTH_IN)
    figure, axes = pyplot.subplots(rows, columns, figsize=(width, height_in), squeeze=False, layout="constrained",
                                   height_ratios=heights)
    figure.suptitle(title, x=0.01, ha="left", fontweight="bold")
    letters = int(width * 72 / (0.54 * FOOTER_POINTS))
    figure.supxlabel(textwrap.fill(_footer(report), letters), fontsize=FOOTER_POINTS, color=FAINT, x=0.01, ha="left")
    return figure, list(axes.flat)


def legend_below_title(figure, handles, title_lines=1):
    """In one line, in the room that a title's last line, left empty, keeps."""
    top = 1 - 0.2 * title_lines / figure.get_figheight()
    figure.legend(handles=handles, loc="upper left", bbox_to_anchor=(0.005, top), ncols=len(handles), fontsize=7.5,
                  handlelength=1.6, columnspacing=1.2)


def save(figure, folder, name):
    """Writes NAME.png and NAME.svg and returns their paths."""
    files = []
    for kind, metadata in (("png", {}), ("svg", {"Date": None})):
        files.append(folder / f"{name}.{kind}")
        figure.savefig(files[-1], metadata=metadata)
    pyplot.close(figure)
    return files


def light_axis(axes, counts):
    """Light counts on a logarithmic axis that has a place for 0."""
    counts = sorted(set(counts))
    if counts[0] == 0:
        axes.set_xscale("symlog", base=2, linthresh=1, linscale=1)
    else:
        axes.set_xscale("log", base=2)
    step = -(-len(counts) // 9)  # at most nine labels; the largest count always has one
    axes.set_xticks(counts[::-1][::step][::-1])
    axes.xaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_locator(ticker.NullLocator())
    if len(counts) > 6:
        axes.tick_params(axis="x", labelsize=7.5)
    axes.set_xlabel("lights")


def round_ticks(low, high):
    """Four round numbers or more between two positive ones, as evenly spread over a logarithmic axis as can be."""
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)))
    for steps in ((1,), (1, 3), (1, 2, 5), (1, 1.5, 2, 3, 5, 7)):
        ticks = [step * 10.0**decade for decade in decades for step in steps]
        ticks = [tick for tick in ticks if low <= tick <= high]
        if len(ticks) >= 4:
            return ticks
    ticks = ticker.MaxNLocator(7, steps=(1, 2, 2.5, 5, 10)).tick_values(low, high)
    return [tick for tick in ticks if low <= tick <= high]


def log_axis(axis, low, high):
    """A logarithmic axis from a little below `low` to a little above `high`, for wide and narrow ranges alike."""
    room = max((high / low) ** 0.05, 1.04)
    low, high = low / room, high * room
    axis.axes.set(**{f"{axis.axis_name}scale": "log", f"{axis.axis_name}lim": (low, high)})
    axis.set_major_locator(ticker.FixedLocator(round_ticks(low, high)))
    axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(ticker.NullLocator())


def log_axis_from_zero(axis, values):
    """A logarithmic axis for what is 0 or more, with a place for 0 below the smallest other value if there is a 0."""
    positive = [value for value in values if value > 0]
    if positive and len(positive) == len(values):
        log_axis(axis, min(values) / 1.1, max(values) * 1.1)
        return
    axes, name = axis.axes, axis.axis_name
    if not positive:
        axes.set(**{f"{name}lim": (-1, 1), f"{name}ticks": [0]})
        return
    threshold = 10.0 ** math.floor(math.log10(min(positive)))
    getattr(axes, f"set_{name}scale")("symlog", linthresh=threshold, linscale=0.4)
    axes.set(**{f"{name}lim": (-0.3 * threshold, 1.5 * max(values))})
    axis.set_major_locator(ticker.FixedLocator([0, *round_ticks(min(positive), max(positive) * 1.4)]))
    axis.set_minor_locator(ticker.NullLocator())
    axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))


def thin_ticks(axis, most):
    """Every so many-th of the ticks, so that no more than `most` are left."""
    low, high = sorted(axis.get_view_interval())
    ticks = [tick for tick in axis.get_majorticklocs() if low <= tick <= high]
    axis.set_major_locator(ticker.FixedLocator(ticks[::-(-len(ticks) // most)]))
