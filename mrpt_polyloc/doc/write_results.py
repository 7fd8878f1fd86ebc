#!/usr/bin/env python3
"""Writes results.md, and the rates in README.md's table of real sets, from summaries of polyloc-eval.

    write_results.py            writes both
    write_results.py --check    exits 1, naming what differs, if they are not what it would write
    write_results.py --take NAME SUMMARY.json COMMIT "NOTE"
                                keeps a summary as results/NAME.json, with the commit that it was
                                made of and a note on how (a loaded machine, say)

Times and the index columns of README.md are not touched: they need an idle machine.
"""
import json
import pathlib
import re
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
PAGE = HERE / "results.md"
README = HERE.parent.parent / "README.md"
KEPT = ("dataset", "method", "scans", "top1", "top5", "top20", "in_list", "unique_right",
        "median_error_m", "median_error_deg", "ms_median", "ms_p90", "ms_max", "status",
        "index_build_s", "index_mb", "cold_start_s", "stretches", "interval",
        "top1_less_first_method", "misses", "good")
REASONS = (("refused", "refused"), ("outside_free_space", "robot outside the map's free space"),
           ("rival_within_noise", "rival within noise"), ("behind_others", "listed behind others"),
           ("not_in_list", "not in the list"))


def take(name, path, commit, note):
    """Keeps of a summary what the pages need."""
    summary = json.loads(pathlib.Path(path).read_text())
    run = summary["run"]
    # Where the results lay is nobody's business.
    run["command"] = re.sub(r"-o \S+", "-o OUT", run["command"])
    kept = {"commit": commit, "note": note, "run": run}
    for key in ("results", "all"):
        kept[key] = [{k: entry[k] for k in KEPT if k in entry} for entry in summary[key]]
        for entry in kept[key]:
            if entry.get("good") is not None:
                entry["good"] = {k: entry["good"][k] for k in ("scans", "top1", "top20")}
    (HERE / "results").mkdir(exist_ok=True)
    (HERE / "results" / (name + ".json")).write_text(json.dumps(kept, indent=1) + "\n")


def percent(share, digits=1):
    return "none" if share is None else f"{100 * share:.{digits}f}"


def milliseconds(value):
    return f"{value:.0f}" if value >= 100 else f"{value:.1f}"


def row(cells):
    return "| " + " | ".join(cells) + " |\n"


def line_of(entry, name):
    low, high = entry["interval"]["top1"]
    good = entry.get("good")
    return row([name, entry["method"], str(entry["scans"]), percent(entry["top1"]),
                f"{percent(low)} to {percent(high)}", percent(entry["top20"]),
                percent(good["top1"]) if good else "", percent(entry["unique_right"]),
                f"{milliseconds(entry['ms_median'])} / {milliseconds(entry['ms_p90'])} / "
                f"{milliseconds(entry['ms_max'])}"])


def groups_of(results):
    """Plans of one entry of a list, NAME-PLAN, put together: shares weighed by scans, and no
    intervals or times, which do not add up."""
    groups = {}
    for entry in results:
        groups.setdefault((entry["dataset"].split("-")[0], entry["method"]), []).append(entry)
    text = ""
    for (name, method), entries in groups.items():
        if len(entries) == 1:  # no plans: a set of its own
            text += line_of(entries[0], entries[0]["dataset"])
            continue
        scans = sum(entry["scans"] for entry in entries)
        unique = sum(entry["status"]["unique"] for entry in entries)
        right = sum(entry["status"]["unique"] * (entry["unique_right"] or 0) for entry in entries)
        shares = [percent(sum(entry["scans"] * entry[key] for entry in entries) / scans)
                  for key in ("top1", "top20")]
        text += row([f"{name} ({len(entries)} plans)", method, str(scans), shares[0], "", shares[1],
                     "", percent(right / unique if unique else None), ""])
    return text


def section(name, kept):
    """One kept summary as a section of the page."""
    run = kept["run"]
    text = f"## {name}\n\n    {run['command']}\n\n"
    text += (f"Commit {kept['commit']}, version {run['version']}, {run['date'][:10]}, "
             f"{run['machine']}.\n{kept['note']}\n\n")
    text += row(["data set", "method", "scans", "top-1 %", "95 %", "top-20 %", "top-1 %, good rows",
                 "unique right %", "ms: half / 90 % / longest"]) + "|---" * 9 + "|\n"
    if len(kept["results"]) > 40:
        text += groups_of(kept["results"])
    else:
        text += "".join(line_of(entry, entry["dataset"]) for entry in kept["results"])
    for entry in kept["all"]:
        text += line_of(entry, "**all**")
    text += "\n"
    for entry in kept["all"]:
        misses = entry["misses"]
        if not sum(misses.values()):
            continue
        reasons = ", ".join(f"{misses[key]} {words}" for key, words in REASONS if misses[key])
        text += f"- Misses of {entry['method']}: {sum(misses.values())}, of them {reasons}.\n"
        if "top1_less_first_method" in entry:
            less = entry["top1_less_first_method"]
            low, high = less["interval"]
            text += (f"- {entry['method']} less {kept['all'][0]['method']}: "
                     f"{percent(less['difference'])} points (95 %: {percent(low)} to "
                     f"{percent(high)}).\n")
    return text + "\n"


def page():
    text = ("# Results\n\nWritten by `mrpt_polyloc/doc/write_results.py` from summaries of "
            "[polyloc-eval](../../apps/polyloc-eval/README.md)\nin `results/`; a test checks that "
            "this page and the README agree with them. Intervals are of a bootstrap over\n"
            "stretches of the drives. What baselines are, and where comparing with them is unfair, "
            "stands\n[there](../../apps/polyloc-eval/README.md#baselines).\n\n")
    for path in sorted((HERE / "results").glob("*.json")):
        text += section(path.stem, json.loads(path.read_text()))
    return "\n".join(wrapped(line) for line in text.rstrip("\n").split("\n")) + "\n"


def wrapped(line):
    """Prose of at most 100 columns; rows of tables and commands as they are."""
    if len(line) <= 100 or line.startswith(("|", "    ")):
        return line
    indent = "  " if line.startswith("- ") else ""
    return textwrap.fill(line, 100, subsequent_indent=indent, break_long_words=False,
                         break_on_hyphens=False)


def readme(text):
    """README.md with the rates of results/real.json in its table of real sets."""
    real = json.loads((HERE / "results" / "real.json").read_text())
    entries = {entry["dataset"]: entry for entry in real["results"]}
    entries["**all"] = real["all"][0]
    lines = text.split("\n")
    seen = set()
    for i, line in enumerate(lines):
        cells = line.split("|")
        name = cells[1].split(" (")[0].strip().rstrip("*") if len(cells) == 7 else ""
        if name not in entries:
            continue
        entry, bold = entries[name], "**" if name == "**all" else ""
        for cell, key in ((2, "top1"), (3, "top20")):
            cells[cell] = (f" {bold}{percent(entry['good'][key])} / {percent(entry[key])}{bold} ")
        lines[i] = "|".join(cells)
        seen.add(name)
    missing = set(entries) - seen
    if missing:
        sys.exit(f"README.md: no row of {', '.join(sorted(missing))}")
    return "\n".join(lines)


def main():
    if sys.argv[1:2] == ["--take"] and len(sys.argv) == 6:
        take(*sys.argv[2:])
    elif sys.argv[1:] in ([], ["--check"]):
        failed = False
        for path, text in ((PAGE, page()), (README, readme(README.read_text()))):
            if not sys.argv[1:]:
                path.write_text(text)
            elif not path.exists() or path.read_text() != text:
                print(f"{path}: differs from the summaries; run {pathlib.Path(__file__).name}")
                failed = True
        sys.exit(failed)
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
