#!/usr/bin/env python3
"""Builds and runs the C program of README.md, without its minute of sleep.

    build_readme.py README --include DIR --library DIR [--compiler CC]
"""
import re
import subprocess
import tempfile
from pathlib import Path

from reader import compile_program, parse_arguments


def main():
    arguments = parse_arguments("cc")
    text = Path(arguments.document).read_text(encoding="utf-8")
    program = re.search(r"^```c\n(.*?)^```$", text, re.MULTILINE | re.DOTALL).group(1)
    # No error may be left, instead of the minute.
    program, replaced = re.subn(r"sleep\(60\);", "return (int)hlGetError();", program)
    if replaced != 1:
        raise SystemExit("the program does not sleep where it did")
    with tempfile.TemporaryDirectory() as folder:
        binary = compile_program(program, Path(folder, "triangle.c"), arguments)
        subprocess.run([str(binary)], check=True, timeout=300)


if __name__ == "__main__":
    main()
