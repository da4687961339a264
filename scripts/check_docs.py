#!/usr/bin/env python3
"""Fails on a line of the documents that is too long, and on a link or picture that leads nowhere.

    scripts/check_docs.py [ROOT]

Looks at README.md, CONTRIBUTING.md and docs/*.md. Prints one line per fault; exit code 1.
"""
import argparse
import re
import sys
from pathlib import Path

MAX_COLUMNS = 120
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
HEADER_OF_CSV = re.compile(r"^[\w,]+$")  # cannot be broken


def documents(root):
    return [root / "README.md", root / "CONTRIBUTING.md", *sorted((root / "docs").glob("*.md"))]


def faults_of(path, root):
    in_code = False
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        where = f"{path.relative_to(root)}:{number}"
        if line.startswith("```"):
            in_code = not in_code
        if len(line) > MAX_COLUMNS and not HEADER_OF_CSV.match(line):
            yield f"{where}: {len(line)} characters, and {MAX_COLUMNS} are the most"
        for target in [] if in_code else LINK.findall(line):
            if "://" not in target and not (path.parent / target).exists():
                yield f"{where}: {target} does not exist"


def check(root):
    return [fault for path in documents(root) if path.exists() for fault in faults_of(path, root)]


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", nargs="?", default=Path(__file__).resolve().parent.parent, type=Path)
    faults = check(parser.parse_args(arguments).root)
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
