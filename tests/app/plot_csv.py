"""Plots columns of one of `helical export`'s tables over time as an SVG: ten lines, whatever Python there is."""
import csv
import sys


def plot(table, columns, out):
    with open(table, newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    time = [float(row["time_s [s]"]) for row in rows]
    with open(out, "w", encoding="utf-8") as svg:
        svg.write('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 -1 60 2">')
        for column in columns:
            points = " ".join(f"{t!r},{-float(row[column])!r}" for t, row in zip(time, rows))
            svg.write(f'<polyline fill="none" stroke="navy" stroke-width="0.01" points="{points}"/>')
        svg.write("</svg>")


if __name__ == "__main__":
    plot(sys.argv[1], sys.argv[3:], sys.argv[2])
