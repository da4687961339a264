#!/usr/bin/env python3
"""Takes links out of installed documents that lead to what is not installed, as sources: their words stay.

    scripts/installed_links.py FOLDER

FOLDER is README.md with docs, examples and what else is installed beside them. Changes its *.md files in place.
"""
import argparse
import re
import sys
from pathlib import Path

CODE = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"(?<!!)\[([^\[\]]+)\]\(([^()#\s]+)(#[^()\s]*)?\)")


def without_dead_links(text, folder):
    """The text of a document in `folder`; blocks of code stay as they are."""
    def kept(link):
        alive = "://" in link[2] or (folder / link[2]).exists()
        return link[0] if alive else link[1]

    parts = CODE.split(text)
    return "".join(part if i % 2 else LINK.sub(kept, part) for i, part in enumerate(parts))


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    for path in sorted(parser.parse_args(arguments).folder.rglob("*.md")):
        text = path.read_text(encoding="utf-8")
        path.write_text(without_dead_links(text, path.parent), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
