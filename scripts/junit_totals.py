#!/usr/bin/env python3
"""Prints "PASSED FAILED SKIPPED" of a JUnit XML file, the one report that ctest, Vitest and Playwright all write.

    scripts/junit_totals.py [--failed] REPORT.xml

Counts the test cases themselves, not the summaries, which the three fill in differently. With --failed it prints the
names of those that failed instead, each with the end of what it said. Exit code 2 when unreadable.
"""
import sys
import xml.etree.ElementTree as ElementTree


def totals(root):
    passed = failed = skipped = 0
    for case in root.iter("testcase"):
        if case.find("failure") is not None or case.find("error") is not None:
            failed += 1
        elif case.find("skipped") is not None or case.get("status") in ("disabled", "notrun"):
            skipped += 1
        else:
            passed += 1
    return passed, failed, skipped


def failures(root, most_lines=30):
    """Of each case that failed: its name, and the last lines of what is reported of it."""
    for case in root.iter("testcase"):
        faults = [part for part in case if part.tag in ("failure", "error")]
        if not faults:
            continue
        texts = [text for one in faults + case.findall("system-out") for text in (one.get("message"), one.text) if text]
        yield case.get("name"), "\n".join(texts).strip().splitlines()[-most_lines:]


def main(arguments):
    if not arguments or arguments[0] in ("-h", "--help"):
        print(__doc__)
        return 0 if arguments else 2
    path = arguments[-1]
    try:
        root = ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        print(f"junit_totals: {path}: {error}", file=sys.stderr)
        return 2
    if arguments[:-1] == ["--failed"]:
        for name, lines in failures(root):
            print(f"FAILED {name}", *lines, sep="\n  ")
        return 0
    if arguments[:-1]:
        print(__doc__)
        return 2
    print(*totals(root))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
