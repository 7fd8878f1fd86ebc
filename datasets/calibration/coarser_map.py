#!/usr/bin/env python3
"""A ROS map of binary PGM with larger cells: occupied if any of its cells is, free if most are.

    coarser_map.py MAP.yaml FACTOR OUT    # writes OUT.pgm and OUT.yaml
"""
import pathlib
import re
import sys

WALL, UNKNOWN, FREE = 0, 205, 254


def main():
    source, factor, out = pathlib.Path(sys.argv[1]), int(sys.argv[2]), pathlib.Path(sys.argv[3])
    yaml = source.read_text()
    image = source.parent / re.search(r"^image:\s*(\S+)", yaml, re.M)[1]
    data = image.read_bytes()
    head = re.match(rb"P5\s+(?:#[^\n]*\s+)*(\d+)\s+(\d+)\s+255\s", data)
    width, height = int(head[1]), int(head[2])
    rows = [data[head.end() + r * width : head.end() + (r + 1) * width] for r in range(height)]
    rows.reverse()  # the map's origin is its lower left corner
    coarse = []
    for r in range(0, height, factor):
        line = bytearray()
        for c in range(0, width, factor):
            cells = b"".join(row[c : c + factor] for row in rows[r : r + factor])
            free = sum(cell > 220 for cell in cells)
            if any(cell < 100 for cell in cells):
                line.append(WALL)
            else:
                line.append(FREE if 2 * free > factor * factor else UNKNOWN)
        coarse.append(bytes(line))
    pixels = b"".join(reversed(coarse))
    size = b"P5\n%d %d\n255\n" % (len(coarse[0]), len(coarse))
    pathlib.Path(f"{out}.pgm").write_bytes(size + pixels)
    cell = float(re.search(r"^resolution:\s*(\S+)", yaml, re.M)[1]) * factor
    yaml = re.sub(r"^image:.*", f"image: {out.name}.pgm", yaml, flags=re.M)
    pathlib.Path(f"{out}.yaml").write_text(re.sub(r"^resolution:.*", f"resolution: {cell:g}", yaml, flags=re.M))


if __name__ == "__main__":
    main()
