#!/usr/bin/env python3
"""Runs polyloc-travel over a list of maps with each strategy, and writes a table of what came of it.

    study.py LIST -o DIR [--program polyloc-travel] [--runs 17] [--seed 1]
             [--strategies greedy,nearest,majority,random] [--maps NAME,NAME...]
    study.py LIST -o DIR --table        only the table of what is there

A line of LIST is a name, a map, and options of polyloc-travel; ${VARIABLES} of the environment are
expanded, `#` starts a comment, and `FILE.tsv.gz:NAME` is the plan of that name in such a file. One
process after another; DIR/NAME/STRATEGY/ keeps what it wrote and the CPU seconds it took
(cpu_s.txt). What is there already is not run again. All strategies start from the same places.
"""
import argparse
import csv
import gzip
import math
import os
import pathlib
import resource
import shlex
import subprocess
import sys

STRATEGIES = ("greedy", "nearest", "majority", "random")


def read_list(path):
    """[(name, map, options)] of a list. Maps are looked for from the list's folder on."""
    entries = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        words = shlex.split(os.path.expandvars(line), comments=True)
        if not words:
            continue
        if len(words) < 2:
            sys.exit(f"{path}:{number}: a name and a map are needed")
        entries.append((words[0], words[1], words[2:]))
    return entries


def map_file(name, text, list_path, out):
    """The map of a line as a file that polyloc-travel reads."""
    archive, colon, plan = text.partition(".tsv.gz:")
    if not colon:
        return list_path.parent / text
    wkt = out / "maps" / (name + ".wkt")
    if not wkt.exists():
        with gzip.open(list_path.parent / (archive + ".tsv.gz"), "rt") as lines:
            plans = dict(line.rstrip("\n").split("\t", 1) for line in lines)
        if plan not in plans:
            sys.exit(f"{archive}.tsv.gz: there is no plan {plan}")
        wkt.parent.mkdir(parents=True, exist_ok=True)
        wkt.write_text(plans[plan] + "\n")
    return wkt


def cpu_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(arguments, out):
    """All runs that are not there yet, map by map, so that strategies can be compared early."""
    entries = read_list(arguments.list)
    for name, text, options in entries:
        if arguments.maps and name not in arguments.maps.split(","):
            continue
        for strategy in arguments.strategies.split(","):
            folder = out / name / strategy
            if (folder / "cpu_s.txt").exists():
                continue
            command = [arguments.program, "--map", str(map_file(name, text, arguments.list, out)),
                       "-n", str(arguments.runs), "--seed", str(arguments.seed),
                       "--strategy", strategy, *options, "-o", str(folder)]
            before = cpu_of_children()
            if subprocess.run(command, stdout=subprocess.DEVNULL).returncode != 0:
                sys.exit("failed: " + shlex.join(command))
            (folder / "cpu_s.txt").write_text(f"{cpu_of_children() - before:.2f}\n")
            print(f"{name} {strategy}: {cpu_of_children() - before:.0f} s", flush=True)


def rows_of(folder):
    with open(folder / "runs.csv", newline="") as file:
        return list(csv.DictReader(file))


def quantile(values, share):
    """By linear interpolation between order statistics, as polyloc-travel's."""
    ordered = sorted(values)
    if not ordered:
        return math.nan
    place = share * (len(ordered) - 1)
    below = math.floor(place)
    above = min(below + 1, len(ordered) - 1)
    return ordered[below] + (place - below) * (ordered[above] - ordered[below])


def line_of(label, rows):
    count = len(rows)
    ended = {outcome: [row for row in rows if row["outcome"] == outcome]
             for outcome in ("localized", "wrong", "indistinguishable", "gave_up")}
    right = sum(int(row["indistinguishable_right"]) for row in rows)
    driven = [row for row in ended["localized"] if row["ambiguous_at_start"] == "1"]
    metres = [float(row["travel_m"]) for row in driven]
    scans = [float(row["scans"]) for row in driven]
    ratios = [float(row["travel_m"]) / float(row["tour_m"]) for row in driven
              if row["tour_m"] and float(row["tour_m"]) > 0]
    ambiguous = sum(row["ambiguous_at_start"] == "1" for row in rows)
    well = 100.0 * (len(ended["localized"]) + right) / count
    ratio = f"{quantile(ratios, 0.5):.2f} ({len(ratios)})" if ratios else "none"
    cells = [label, count, ambiguous, len(ended["localized"]), len(ended["wrong"]),
             f"{len(ended['indistinguishable'])} ({right})", len(ended["gave_up"]),
             f"{well:.1f}", sum(int(row["collisions"]) for row in rows),
             f"{quantile(metres, 0.5):.1f} / {quantile(metres, 0.9):.1f}",
             f"{quantile(scans, 0.5):.0f} / {quantile(scans, 0.9):.0f}", ratio]
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def table(list_path, out, strategies):
    """Of each strategy over the maps that have runs of all, then of each map with the first."""
    head = ("runs", "ambiguous at first", "localized", "wrong", "indistinguishable (right)",
            "gave up", "well ended %", "collisions", "metres, median / p90",
            "scans, median / p90", "over the shortest tour")
    names = [name for name, _, _ in read_list(list_path)]
    whole = [name for name in names
             if all((out / name / s / "cpu_s.txt").exists() for s in strategies)]
    print(f"{len(whole)} of {len(names)} maps\n")
    print("| strategy | " + " | ".join(head) + " |\n" + "|---" * (len(head) + 1) + "|")
    for strategy in strategies:
        rows = [row for name in whole for row in rows_of(out / name / strategy)]
        if rows:
            print(line_of(strategy, rows))
    print("\n| map | " + " | ".join(head) + " |\n" + "|---" * (len(head) + 1) + "|")
    for name in whole:
        print(line_of(name, rows_of(out / name / strategies[0])))
    cpu = sum(float((out / name / s / "cpu_s.txt").read_text())
              for name in whole for s in strategies)
    print(f"\n{cpu:.0f} CPU seconds")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("list", type=pathlib.Path)
    parser.add_argument("-o", dest="out", type=pathlib.Path, required=True)
    parser.add_argument("--program", default="polyloc-travel")
    parser.add_argument("--runs", type=int, default=17)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--strategies", default=",".join(STRATEGIES))
    parser.add_argument("--maps", default="")
    parser.add_argument("--table", action="store_true")
    arguments = parser.parse_args()
    if not arguments.table:
        run(arguments, arguments.out)
    table(arguments.list, arguments.out, arguments.strategies.split(","))


if __name__ == "__main__":
    main()
