#!/usr/bin/env python3
"""A corridor with rooms of chance on both sides, each behind a door, as WKT.

    office_plan.py SEED LENGTH > office.wkt
"""
import random
import sys

WALL = 0.15  # thickness [m]
CORRIDOR = 2.2  # width [m]


def rooms(chance, length, y, outwards):
    """The border of one side, from left to right; outwards: 1 up, -1 down."""
    border, x = [], 0.3
    while True:
        width, depth = chance.uniform(2.6, 6.5), chance.uniform(3.5, 6.5)
        if x + width > length - 0.3:
            return border
        door = x + chance.uniform(0.2, width - 1.2)
        near, far = y + outwards * WALL, y + outwards * (WALL + depth)
        border += [(door, y), (door, near), (x, near), (x, far)]
        if chance.random() < 0.5:  # a pillar at the outer wall
            left = x + chance.uniform(0.3, width / 2)
            front = far - outwards * chance.uniform(0.3, 1.2)
            border += [(left, far), (left, front), (left + 0.6, front), (left + 0.6, far)]
        border += [(x + width, far), (x + width, near), (door + 0.9, near), (door + 0.9, y)]
        x += width + WALL


def main():
    chance, length = random.Random(int(sys.argv[1])), float(sys.argv[2])
    lower = rooms(chance, length, 0.0, -1)
    upper = rooms(chance, length, CORRIDOR, 1)
    ring = [(0.0, 0.0), *lower, (length, 0.0), (length, CORRIDOR), *reversed(upper), (0.0, CORRIDOR)]
    print("POLYGON ((" + ", ".join(f"{x:.3f} {y:.3f}" for x, y in ring + ring[:1]) + "))")


if __name__ == "__main__":
    main()
