#!/usr/bin/env python3
"""Draws a stress run: the error of each case over its parameter with bound, law and breakdown, and the breakdown tables.

Usage: plot_stress.py REPORT [--out DIR]      REPORT is a stress.json; writes PNG and SVG (into its folder unless told) and prints
their paths; what cannot be drawn is said on stderr.
Exit code 2 on bad input. Debian: python3-matplotlib.
"""

import argparse
import pathlib
import sys

from plotting import stress_curves, stress_data, stress_grid, style

FIGURES = {"stress_curves": stress_curves.draw, "breakdown": stress_grid.draw, "breakdown_others": stress_grid.draw_others}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("report", type=pathlib.Path, metavar="REPORT")
    parser.add_argument("--out", type=pathlib.Path, metavar="DIR", help="where the pictures go (default: beside the report)")
    arguments = parser.parse_args()
    folder = arguments.out or arguments.report.parent
    try:
        run = stress_data.load(arguments.report)
        folder.mkdir(parents=True, exist_ok=True)
        for name, draw in FIGURES.items():
            figure, why_not = draw(run)
            if figure is None:
                print(f"plot_stress.py: no {name}: {why_not}", file=sys.stderr)
                continue
            for file in style.save(figure, folder, name):
                print(file)
    except stress_data.ReportError as error:
        print(f"plot_stress.py: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"plot_stress.py: {error.filename or folder}: {error.strerror}", file=sys.stderr)
        return 2
    except (KeyError, TypeError, AttributeError) as error:
        print(f"plot_stress.py: {arguments.report}: not a sound stress run ({type(error).__name__}: {error}); "
              "scripts/check_report.py says where", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
