#!/usr/bin/env python3
"""Draws a report: time and evaluations over lights, ratio to forward, time per pass, against error, field errors, maps, skips.

Usage: plot.py REPORT [--out DIR] [--error METRIC] [--lights N,...]      one figure each per scene; writes PNG and SVG (into the
report's folder unless told) and prints their paths; what cannot be drawn is said on stderr. The maps are looked for in the report's
folder.
Exit code 2 on bad input. Debian: python3-matplotlib.
"""

import argparse
import functools
import pathlib
import re
import sys

from plotting import field_errors, flip_maps, over_lights, per_pass, skips, time_error
from plotting import report as data
from plotting import style


def file_words(scenes):
    """{scene: its word in file names}, each different: two files may have one stem."""
    words = {}
    for scene in scenes:
        word = base = re.sub(r"[^A-Za-z0-9_.-]+", "_", data.name_of(scene)) or "scene"
        number = 1
        while word in words.values():
            number += 1
            word = f"{base}-{number}"
        words[scene] = word
    return words


def figures_of(report, arguments):
    """{name: what draws it from (report, scene, cells, paths)}"""
    of_skips = {"skips": skips.draw} if report.get("skips") else {}  # few reports have any
    return {
        "time_over_lights": over_lights.draw_time,
        "ratio_to_forward": over_lights.draw_ratio,
        "evaluations_over_lights": over_lights.draw_evaluations,
        "time_per_pass": functools.partial(per_pass.draw, counts=arguments.lights),
        "time_against_error": functools.partial(time_error.draw, metric=arguments.error),
        "field_errors": field_errors.draw,
        "flip_maps": functools.partial(flip_maps.draw, folder=arguments.report.parent / "maps"),
    } | of_skips


def draw_all(report, figures, folder):
    """Yields (files, None) for each figure, or (nothing, a line on what is missing)."""
    scenes = data.scenes(report)
    if not scenes:
        yield [], "no cell was measured: nothing to draw"
    words = file_words(scenes)
    paths = list(dict.fromkeys(cell["params"]["path"] for cells in scenes.values() for cell in cells))
    for scene, cells in scenes.items():
        for name, draw in figures.items():
            figure, why_not = draw(report, scene, data.without_single_skips(cells), paths)
            if figure is None:
                yield [], f"no {name} of {data.name_of(scene)}: {why_not}"
            else:
                yield style.save(figure, folder, f"{name}_{words[scene]}"), None


def light_counts(text):
    """[1, 256] of '1,256'"""
    return [int(word) for word in text.split(",")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("report", type=pathlib.Path, metavar="REPORT")
    parser.add_argument("--out", type=pathlib.Path, metavar="DIR", help="where the pictures go (default: beside the report)")
    parser.add_argument("--error", choices=time_error.METRICS, default="flip_mean",
                        help="of time_against_error: of display values against the reference (default: %(default)s)")
    parser.add_argument("--lights", type=light_counts, default=[], metavar="N,...",
                        help="of time_per_pass: at these light counts (default: the largest of each size)")
    arguments = parser.parse_args()
    folder = arguments.out or arguments.report.parent
    try:
        report = data.load(arguments.report)
        folder.mkdir(parents=True, exist_ok=True)
        for files, missing in draw_all(report, figures_of(report, arguments), folder):
            for file in files:
                print(file)
            if missing:
                print(f"plot.py: {missing}", file=sys.stderr)
    except data.ReportError as error:
        print(f"plot.py: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"plot.py: {error.filename or folder}: {error.strerror}", file=sys.stderr)
        return 2
    except (KeyError, TypeError, AttributeError) as error:
        print(f"plot.py: {arguments.report}: not a sound report ({type(error).__name__}: {error}); "
              "scripts/check_report.py says where", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
