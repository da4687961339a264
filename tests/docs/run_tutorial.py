#!/usr/bin/env python3
"""Builds and runs the programs of docs/first-scene.md as a reader would, and checks that they print what it says.

    run_tutorial.py DOCUMENT --include DIR --library DIR [--compiler CXX]

The first ```cpp block is a whole program. Each later one replaces the functions it has in common with the program so far
and adds the others before main; then it is compiled and run, until it has printed the lines of the ```text block that
follows, whose numbers may differ.
"""
import re
import subprocess
import tempfile
from pathlib import Path

from reader import compile_program, parse_arguments

DURATIONS_S = [5, 20, 80]
BLOCK = re.compile(r"^```(cpp|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
# A function as the house's layout has it: it begins in the first column and ends with a brace there, or on its line.
FUNCTION = re.compile(r"^(?:void|int) (\w+)\([^\n]*\) \{(?:\}|\n.*?^\})\n", re.MULTILINE | re.DOTALL)


def with_functions(program, block):
    """`program` with the functions of `block` in the place of its own."""
    for function in FUNCTION.finditer(block):
        own = next((f for f in FUNCTION.finditer(program) if f.group(1) == function.group(1)), None)
        if own:
            program = program[:own.start()] + function.group(0) + program[own.end():]
        else:  # before the first function, so that all others may call it
            first = FUNCTION.search(program).start()
            program = program[:first] + function.group(0) + "\n" + program[first:]
    return program


def line_pattern(line):
    return "[-0-9.]+".join(re.escape(part) for part in re.split(r"-?\d+(?:\.\d+)?", line))


def run_until_printed(binary, expected):
    for seconds in DURATIONS_S:
        output = subprocess.run([str(binary), "inproc:", str(seconds)], stdout=subprocess.PIPE, text=True, check=True,
                                timeout=seconds + 300).stdout
        lacking = [line for line in expected if not re.search("^" + line_pattern(line) + "$", output, re.MULTILINE)]
        if not lacking:
            return
    raise SystemExit(f"not printed: {lacking}\n{output}")


def main():
    arguments = parse_arguments("c++")
    program, steps = "", 0
    with tempfile.TemporaryDirectory() as folder:
        for kind, text in BLOCK.findall(Path(arguments.document).read_text(encoding="utf-8")):
            if kind == "cpp":
                program = with_functions(program, text) if program else text
                binary = compile_program(program, Path(folder, "scene.cpp"), arguments, "-std=c++20")
                steps += 1
            else:
                run_until_printed(binary, text.splitlines())
                print(f"step {steps}: builds and prints what the document says")
    if steps < 4:
        raise SystemExit("the document has lost its programs")


if __name__ == "__main__":
    main()
