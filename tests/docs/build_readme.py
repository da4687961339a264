#!/usr/bin/env python3
"""Builds and runs the C program of README.md, without its minute of sleep.

    build_readme.py README --include DIR --library DIR [--compiler CC]
"""
import argparse
import re
import subprocess
import tempfile
from pathlib import Path


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("document")
    parser.add_argument("--include", required=True)
    parser.add_argument("--library", required=True)
    parser.add_argument("--compiler", default="cc")
    arguments = parser.parse_args()
    text = Path(arguments.document).read_text(encoding="utf-8")
    program = re.search(r"^```c\n(.*?)^```$", text, re.MULTILINE | re.DOTALL).group(1)
    # No error may be left, instead of the minute.
    program, replaced = re.subn(r"sleep\(60\);", "return (int)hlGetError();", program)
    if replaced != 1:
        raise SystemExit("the program does not sleep where it did")
    with tempfile.TemporaryDirectory() as folder:
        source, binary = Path(folder, "triangle.c"), Path(folder, "triangle")
        source.write_text(program, encoding="utf-8")
        subprocess.run([arguments.compiler, "-Wall", "-Wextra", "-Werror", str(source), "-o", str(binary),
                        "-I" + arguments.include, "-L" + arguments.library, "-lhl", "-Wl,-rpath," + arguments.library],
                       check=True)
        subprocess.run([str(binary)], check=True, timeout=300)


if __name__ == "__main__":
    main()
