#!/usr/bin/env python3
"""count_results.py REPORT FOLDER: prints how many tests passed, failed and were skipped.

REPORT is ctest's (--output-junit). Where a test of ctest is half an executable of GoogleTest's
(POLYLOC_TESTS_TOGETHER), its own report, FOLDER/NAME.xml, says how its tests went; a process that
failed without such a report, or with one that knows of no failure, is one failure more.
"""
import sys
import xml.etree.ElementTree as ElementTree
from collections import Counter
from pathlib import Path


def outcome_by_ctest(test):
    status = test.get("status")
    if status == "run":
        return "passed"
    return "failed" if status == "fail" else "skipped"


def outcome_by_googletest(test):
    if test.find("failure") is not None:
        return "failed"
    is_skipped = test.find("skipped") is not None or test.get("status") == "notrun"
    return "skipped" if is_skipped else "passed"


def count(report, folder):
    counts = Counter()
    for process in ElementTree.parse(report).iter("testcase"):
        own = Path(folder, process.get("name") + ".xml")
        outcome = outcome_by_ctest(process)
        if not own.exists():
            counts[outcome] += 1
            continue
        inside = Counter(map(outcome_by_googletest, ElementTree.parse(own).iter("testcase")))
        if outcome == "failed" and not inside["failed"]:
            inside["failed"] = 1
        counts += inside
    return counts


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: count_results.py REPORT FOLDER")
    counts = count(sys.argv[1], sys.argv[2])
    if not counts.total():
        sys.exit(f"{sys.argv[1]}: no tests were found")
    print(counts["passed"], counts["failed"], counts["skipped"])


if __name__ == "__main__":
    main()
