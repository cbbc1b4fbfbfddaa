#!/usr/bin/env python3
"""Draws what the benchmark programs measured: CSV in, SVG out, logarithmic axes.

Knows the columns of bench_convergence (error against seconds and against the count, with bands
over seeds; bias and spread apart), bench_scaling (time and memory) and the curve of bench_target
(error told against error there is). Writes FILE-*.svg beside every FILE.csv, or into --output.
"""
import argparse
import csv
import math
from pathlib import Path
from xml.sax.saxutils import escape

COLOURS = ("#1b6ca8", "#d1495b", "#3a7d44", "#8a5a9e", "#e08e0b", "#4d4d4d", "#2a9d9d", "#b5651d",
           "#7a8c1f", "#c2528b", "#5566cc")
DASHES = ("", "7 4", "2 3")
WIDTH, HEIGHT = 760, 520
LEFT, RIGHT, TOP, BOTTOM = 80, 250, 46, 58


class Series:
    """Points (x, y), with an optional band (low, high) each."""

    def __init__(self, name, dash=0):
        self.name, self.dash, self.points = name, dash, []

    def add(self, x, y, low=math.nan, high=math.nan):
        if x > 0 and y > 0 and math.isfinite(x) and math.isfinite(y):
            self.points.append((x, y, low, high))


class Axis:
    """Logarithmic, from a pixel to another."""

    def __init__(self, values, begin, end):
        low, high = math.log10(min(values)), math.log10(max(values))
        margin = 0.04 * max(high - low, 0.3)
        if high - low < 0.3:
            low, high = low - 0.15, high + 0.15
        self.low, self.high, self.begin, self.end = low - margin, high + margin, begin, end

    def at(self, value):
        share = (math.log10(value) - self.low) / (self.high - self.low)
        return self.begin + share * (self.end - self.begin)

    def ticks(self):
        """Decades, with 2 and 5 between them where there are few, and with all where there is one."""
        decades = self.high - self.low
        steps = (1,) if decades > 4 else (1, 2, 5) if decades > 1 else range(1, 10)
        for exponent in range(math.floor(self.low), math.ceil(self.high)):
            for step in steps:
                value = step * 10.0 ** exponent
                if self.low <= math.log10(value) <= self.high:
                    yield value


def number(value):
    if 1e-3 <= value < 1e4:
        return f"{value:g}"
    mantissa, exponent = f"{value:e}".split("e")
    mantissa = f"{float(mantissa):g}"
    return ("" if mantissa == "1" else mantissa + "·") + f"10^{int(exponent)}"


def text(x, y, words, anchor="middle", size=12, turn=None):
    extra = f' transform="rotate({turn} {x:.1f} {y:.1f})"' if turn is not None else ""
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}"{extra}>'
            f"{escape(words)}</text>")


def path(places, style):
    return f'<polyline points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in places)}" {style}/>'


def curve(series, colour, x_axis, y_axis):
    parts = []
    banded = [p for p in series.points if p[2] > 0 and math.isfinite(p[3])]
    if len(banded) > 1:
        edge = [(x_axis.at(x), y_axis.at(high)) for x, _, _, high in banded]
        edge += [(x_axis.at(x), y_axis.at(low)) for x, _, low, _ in reversed(banded)]
        corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in edge)
        parts.append(f'<polygon points="{corners}" fill="{colour}" fill-opacity="0.15"/>')
    places = [(x_axis.at(x), y_axis.at(y)) for x, y, _, _ in series.points]
    dash = f' stroke-dasharray="{DASHES[series.dash]}"' if DASHES[series.dash] else ""
    parts.append(path(places, f'fill="none" stroke="{colour}" stroke-width="1.8"{dash}'))
    parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.6" fill="{colour}"/>' for x, y in places]
    return parts


def plot(file, title, x_label, y_label, all_series):
    """\\param all_series of equal first words ("NAME: ...") share a colour"""
    all_series = [s for s in all_series if s.points]
    if not all_series:
        return
    xs = [p[0] for s in all_series for p in s.points]
    ys = [p[1] for s in all_series for p in s.points]
    ys += [v for s in all_series for p in s.points for v in p[2:] if v > 0 and math.isfinite(v)
           and v > min(ys) / 10]
    right, bottom = WIDTH - RIGHT, HEIGHT - BOTTOM
    x_axis, y_axis = Axis(xs, LEFT, right), Axis(ys, bottom, TOP)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
             f'viewBox="0 0 {WIDTH} {HEIGHT}" font-family="DejaVu Sans, Helvetica, sans-serif">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
             f'<clipPath id="inside"><rect x="{LEFT}" y="{TOP}" width="{right - LEFT}" '
             f'height="{bottom - TOP}"/></clipPath>']
    for value in x_axis.ticks():
        x = x_axis.at(value)
        parts.append(path([(x, TOP), (x, bottom)], 'stroke="#ddd"'))
        parts.append(text(x, bottom + 17, number(value), size=11))
    for value in y_axis.ticks():
        y = y_axis.at(value)
        parts.append(path([(LEFT, y), (right, y)], 'stroke="#ddd"'))
        parts.append(text(LEFT - 7, y + 4, number(value), "end", 11))
    parts.append('<g clip-path="url(#inside)">')
    colours, legend = {}, []
    for series in all_series:
        key = series.name.split(": ")[0]
        colour = colours.setdefault(key, COLOURS[len(colours) % len(COLOURS)])
        parts += curve(series, colour, x_axis, y_axis)
        legend.append((series, colour))
    parts.append("</g>")
    parts.append(f'<rect x="{LEFT}" y="{TOP}" width="{right - LEFT}" height="{bottom - TOP}" '
                 'fill="none" stroke="#444"/>')
    for i, (series, colour) in enumerate(legend):
        y = TOP + 12 + 19 * i
        dash = f' stroke-dasharray="{DASHES[series.dash]}"' if DASHES[series.dash] else ""
        parts.append(path([(right + 12, y - 4), (right + 38, y - 4)],
                          f'stroke="{colour}" stroke-width="2"{dash}'))
        parts.append(text(right + 44, y, series.name, "start", 11))
    parts.append(text((LEFT + right) / 2, 26, title, size=15))
    parts.append(text((LEFT + right) / 2, HEIGHT - 14, x_label))
    parts.append(text(20, (TOP + bottom) / 2, y_label, turn=-90))
    file.write_text("\n".join(parts + ["</svg>", ""]), encoding="utf-8")
    print(file)


def value(row, column):
    try:
        return float(row[column])
    except ValueError:
        return math.nan


def groups(rows, *columns):
    """Rows by what they have in those columns, in order of appearance."""
    found = {}
    for row in rows:
        found.setdefault(tuple(row[c] for c in columns), []).append(row)
    return found


def plot_convergence(stem, rows):
    for (scene,), of_scene in groups(rows, "scene").items():
        by_method = {k[0]: v for k, v in groups(of_scene, "method").items()}
        for kind in ("image", "leaf"):
            seconds, counts, parts = [], [], []
            for method, own in by_method.items():
                time, count = Series(method), Series(method)
                bias, spread = Series(method + ": bias"), Series(method + ": spread", 1)
                for r in own:
                    e = [value(r, f"{kind}_{what}") for what in ("error", "low", "high")]
                    time.add(value(r, "bake_seconds") + value(r, "render_seconds")
                             if kind == "image" else value(r, "bake_seconds"), *e)
                    count.add(value(r, "count"), *e)
                    bias.add(value(r, "count"), value(r, f"{kind}_bias"))
                    spread.add(value(r, "count"), value(r, f"{kind}_spread"))
                seconds.append(time)
                counts.append(count)
                parts += [bias, spread]
            error = f"{kind} error, relative RMS"
            count = "directions (reference: paths a pixel)"
            base = f"{stem}-{scene}-{kind}"
            plot(Path(base + "-seconds.svg"), scene, "seconds, bake and picture"
                 if kind == "image" else "seconds of the bake", error, seconds)
            plot(Path(base + "-count.svg"), scene, count, error, counts)
            plot(Path(base + "-parts.svg"), scene + ": bias and spread over seeds", count, error,
                 parts)


def plot_scaling(stem, rows):
    for (name,), own in groups(rows, "series").items():
        direction, first_shot = Series("a direction"), Series("first shot")
        geometry, peak, allowed = Series("geometry"), Series("peak"), Series("bound", 1)
        linear = Series("in proportion", 2)
        for r in own:
            x = value(r, "value")
            direction.add(x, value(r, "seconds_per_direction"))
            first_shot.add(x, value(r, "seconds_first_shot"))
            geometry.add(x, value(r, "seconds_geometry"))
            peak.add(x, value(r, "peak_mb"))
            allowed.add(x, value(r, "mb_allowed"))
            least = value(own[0], "seconds_per_direction")
            linear.add(x, least * x / value(own[0], "value") if name != "threads"
                       else least * value(own[0], "value") / x)
        label = name.replace("_", " ")
        times = [direction, first_shot] if name == "light_samples" else [direction]
        if name in ("triangles", "leaves"):
            times.append(geometry)
        if name in ("triangles", "threads"):
            times.append(linear)
        plot(Path(f"{stem}-{name}-seconds.svg"), "time against " + label, label, "seconds", times)
        plot(Path(f"{stem}-{name}-memory.svg"), "memory against " + label, label,
             "peak [10^6 bytes]", [peak] + ([allowed] if name != "bins" else []))


def plot_curve(stem, rows):
    series = []
    for (scene,), own in groups(rows, "scene").items():
        true, told = Series(scene + ": true"), Series(scene + ": reported", 1)
        for r in own:
            true.add(value(r, "directions"), value(r, "error"))
            if value(r, "reported") < 1.0:
                told.add(value(r, "directions"), value(r, "reported"))
        series += [true, told]
    plot(Path(f"{stem}.svg"), "error told and error there is", "directions",
         "relative error of the leaves", series)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("csv", nargs="+", type=Path)
    parser.add_argument("-o", "--output", type=Path, help="folder (default: beside the CSV)")
    arguments = parser.parse_args()
    for file in arguments.csv:
        with open(file, newline="", encoding="utf-8") as stream:
            rows = list(csv.DictReader(stream))
        if not rows:
            parser.error(f"{file}: no rows")
        stem = (arguments.output or file.parent) / file.stem
        if "series" in rows[0]:
            plot_scaling(stem, rows)
        elif "image_error" in rows[0]:
            plot_convergence(stem, rows)
        elif "reported" in rows[0] and "spread" in rows[0]:
            plot_curve(stem, rows)
        else:
            parser.error(f"{file}: columns of no benchmark that is known here")


if __name__ == "__main__":
    main()
