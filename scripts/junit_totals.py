#!/usr/bin/env python3
"""Prints "PASSED FAILED SKIPPED" of a JUnit XML file, the one report that ctest, Vitest and Playwright all write.

    scripts/junit_totals.py REPORT.xml

Counts the test cases themselves, not the summaries, which the three fill in differently. Exit code 2 when unreadable.
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


def main(arguments):
    if len(arguments) != 1 or arguments[0] in ("-h", "--help"):
        print(__doc__)
        return 0 if arguments else 2
    try:
        root = ElementTree.parse(arguments[0]).getroot()
    except (OSError, ElementTree.ParseError) as error:
        print(f"junit_totals: {arguments[0]}: {error}", file=sys.stderr)
        return 2
    print(*totals(root))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
