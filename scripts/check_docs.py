#!/usr/bin/env python3
"""Fails on a line of the documents that is too long, on a link or picture that leads nowhere, and on a call or constant
of HL that there is not.

    scripts/check_docs.py [ROOT]

Looks at README.md, CONTRIBUTING.md, CHANGELOG.md and docs/*.md. A call or constant (hlName, HL_NAME) is in the public
headers; or, as a variable of the environment or of CMake, in the sources. Prints one line per fault; exit code 1.
"""
import argparse
import re
import sys
from pathlib import Path

MAX_COLUMNS = 120
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
NAME = re.compile(r"\b(?:hl[A-Z]\w*|HL_[A-Z0-9_]+)\b(?!\*)(?!=)")
NOT_ONLY_HEADERS = ("src", "apps", "tests", "scripts", "cmake")
# A table whose first column has this heading names there what HL does not have, or no longer.
NAMES_OF_OTHERS = ("was", "OpenHaptics")
EXAMPLES = {"HL_NAME"}
HEADER_OF_CSV = re.compile(r"^[\w,]+$")  # cannot be broken


def documents(root):
    return [root / "README.md", root / "CONTRIBUTING.md", root / "CHANGELOG.md", *sorted((root / "docs").glob("*.md"))]


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


def words_of(files):
    return {name for file in files if file.is_file()
            for name in NAME.findall(file.read_text(encoding="utf-8", errors="ignore"))}


def known_names(root):
    """Names in the headers, and what else the sources call HL_..., such as variables of the environment."""
    declared = words_of((root / "include").rglob("*"))
    others = words_of(file for folder in NOT_ONLY_HEADERS for file in (root / folder).rglob("*"))
    return declared | {name for name in others if name.startswith("HL_")} | EXAMPLES


def lines_of_own_names(text):
    """(number, line) of each line, without the cells that name calls of others."""
    of_others = False
    for number, line in enumerate(text.splitlines(), 1):
        cells = line.split("|")
        if len(cells) < 3 or cells[0]:
            of_others = False
        elif cells[1].strip() in NAMES_OF_OTHERS:
            of_others = True
        yield number, "|".join(cells[2:]) if of_others else line


def faults_of_names(path, root, known):
    for number, line in lines_of_own_names(path.read_text(encoding="utf-8")):
        for name in NAME.findall(line):
            if name not in known:
                yield f"{path.relative_to(root)}:{number}: {name} is in no header of include/hl"


def check(root):
    known = known_names(root)
    return [fault for path in documents(root) if path.exists()
            for fault in (*faults_of(path, root), *faults_of_names(path, root, known))]


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", nargs="?", default=Path(__file__).resolve().parent.parent, type=Path)
    faults = check(parser.parse_args(arguments).root)
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
