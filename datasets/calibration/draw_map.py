#!/usr/bin/env python3
"""Draws a floor of WKT polygons as a ROS map: a cell is free if all of it is, a wall one cell wide
stands around what is free, and the rest is unknown.

    draw_map.py FLOOR.wkt CELL OUT    # writes OUT.pgm and OUT.yaml
"""
import pathlib
import re
import sys

FINER = 4  # lines a cell, each way
WALL, UNKNOWN, FREE = 0, 205, 254


def fill(rings, width, height):
    """Even-odd: for each line of the finer grid a bytearray of 1 where its points are inside."""
    lines = []
    for row in range(height):
        y, crossings = row + 0.5, []
        for ring in rings:
            for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1]):
                if (y0 <= y) != (y1 <= y):
                    crossings.append(x0 + (y - y0) * (x1 - x0) / (y1 - y0))
        crossings.sort()
        line = bytearray(width)
        for start, end in zip(crossings[::2], crossings[1::2]):
            a, b = max(0, int(start + 0.5)), min(width, int(end + 0.5))
            line[a:b] = b"\1" * max(0, b - a)
        lines.append(line)
    return lines


def main():
    text, cell = pathlib.Path(sys.argv[1]).read_text(), float(sys.argv[2])
    out = pathlib.Path(sys.argv[3])
    rings = [
        [tuple(map(float, point.split())) for point in ring.split(",")]
        for ring in re.findall(r"\(([^()]+)\)", text)
    ]
    left = min(x for ring in rings for x, _ in ring) - 1.013  # off the lattice of the plan
    low = min(y for ring in rings for _, y in ring) - 1.021
    columns = int((max(x for ring in rings for x, _ in ring) - left + 1) / cell)
    rows = int((max(y for ring in rings for _, y in ring) - low + 1) / cell)
    fine = [[((x - left) / cell * FINER, (y - low) / cell * FINER) for x, y in ring] for ring in rings]
    lines = fill(fine, columns * FINER, rows * FINER)

    def is_free(row, column):
        part = slice(column * FINER, (column + 1) * FINER)
        return all(all(line[part]) for line in lines[row * FINER : (row + 1) * FINER])

    image = [bytearray([UNKNOWN] * columns) for _ in range(rows)]
    free = [(r, c) for r in range(rows) for c in range(columns) if is_free(r, c)]
    for row, column in free:
        for r in range(max(0, row - 1), min(rows, row + 2)):
            for c in range(max(0, column - 1), min(columns, column + 2)):
                image[r][c] = WALL
    for row, column in free:
        image[row][column] = FREE
    pixels = b"".join(bytes(line) for line in reversed(image))
    pathlib.Path(f"{out}.pgm").write_bytes(b"P5\n%d %d\n255\n" % (columns, rows) + pixels)
    pathlib.Path(f"{out}.yaml").write_text(
        f"image: {out.name}.pgm\nresolution: {cell}\norigin: [{left}, {low}, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )


if __name__ == "__main__":
    main()
