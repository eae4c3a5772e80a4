"""How every picture looks: colours that the colour-blind can tell apart, each with a marker of its own, and axes."""

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot, ticker  # noqa: E402  (the backend comes first)

# Okabe and Ito, "Color Universal Design", 2008; without yellow, which is too light for lines on white.
COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*", "<", ">", "p", "h")
LINES = ("-", "--", ":", "-.")
HATCHES = ("", "///", "...", "\\\\\\", "xx", "++", "--")
FAINT = "#666666"
NS_PER_MS = 1e6

matplotlib.rcParams.update({
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
    "hatch.linewidth": 0.5,
    # The same report gives the same bytes.
    "svg.hashsalt": "lightsweep",
})


class ArmStyles:
    """Colour by path, line by layout, and a marker for each arm of its own, the same in every panel."""

    def __init__(self, arms):
        arms = list(dict.fromkeys(arms))
        paths = list(dict.fromkeys(arm.path for arm in arms))
        variants = list(dict.fromkeys((arm.layout, arm.hdr) for arm in arms if arm.layout))
        self._color = {path: COLORS[i % len(COLORS)] for i, path in enumerate(paths)}
        self._line = {variant: LINES[i % len(LINES)] for i, variant in enumerate(variants)}
        self._marker = {arm: MARKERS[i % len(MARKERS)] for i, arm in enumerate(arms)}

    def color(self, arm):
        return self._color[arm.path]

    def line(self, arm):
        """Keyword arguments for `plot`."""
        return {"color": self.color(arm), "marker": self._marker[arm],
                "linestyle": self._line.get((arm.layout, arm.hdr), "-")}


def panel_grid(count, width_in, height_in, title):
    """A figure with `count` axes side by side, as a list."""
    figure, axes = pyplot.subplots(1, count, figsize=(max(width_in * count, 6.5), height_in), squeeze=False,
                                   layout="constrained")
    figure.suptitle(title, x=0.01, ha="left", fontweight="bold")
    return figure, list(axes.flat)


def footer(report):
    """Where the numbers come from: no picture goes without."""
    environment, run = report["environment"], report["run"]
    commit = f" ({run['git_commit'][:10]})" if run["git_commit"] else ""
    floor = report["noise"]["floor"]
    noise = "unknown" if floor is None else f"{100 * floor:.1f} %"
    return (f"{environment['gl_renderer']} on {environment['cpu']}, {environment['cores']} cores  |  "
            f"timer: {report['timer']['method']}  |  noise floor: {noise}  |  intervals: 95 %  |  "
            f"lightsweep {run['version']}{commit}")


def save(figure, report, folder, name):
    """Writes NAME.png and NAME.svg and returns their paths."""
    figure.supxlabel(footer(report), fontsize=6.5, color=FAINT, x=0.01, ha="left")
    files = []
    for kind, metadata in (("png", {}), ("svg", {"Date": None})):
        files.append(folder / f"{name}.{kind}")
        figure.savefig(files[-1], dpi=150, metadata=metadata)
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
    axes.set_xlabel("lights")


def log_axis(axis, low, high):
    """A logarithmic axis whose ticks are round numbers, for wide and narrow ranges alike."""
    axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    low, high = low / 1.06, high * 1.06
    axis.axes.set(**{f"{axis.axis_name}lim": (low, high)})
    if high / low > 5:
        axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5) if high / low < 1e3 else (1,)))
    else:
        ticks = ticker.MaxNLocator(5, steps=(1, 2, 2.5, 5, 10)).tick_values(low, high)
        axis.set_major_locator(ticker.FixedLocator([tick for tick in ticks if low <= tick <= high]))
    axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:.3g}"))
    axis.set_minor_locator(ticker.NullLocator())
