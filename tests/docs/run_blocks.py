#!/usr/bin/env python3
"""Every block of code in README.md, CONTRIBUTING.md and docs/*.md: built, run or at least looked at, as
tests/docs/blocks.py says.

    run_blocks.py ROOT --build DIR --include DIR --library DIR[:DIR] --hl FILE --hld FILE [--cc CC] [--cxx CXX]

Prints one line for each fault; exit code 1.
"""
import argparse
import ast
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

from blocks import blocks_of
from commands import Commands

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "examples"))
from run_example import Server  # noqa: E402

PATIENCE_S = 60
FRAMES = Path(__file__).resolve().parent / "frames"
DEFAULT_ADDRESS = "127.0.0.1:1997"
SERVES = re.compile(r"^(hl (?:touch|record)) ", re.MULTILINE)  # beside other tests: on a free port, without a browser


class Fault(Exception):
    """What is wrong with a block, in one line."""


def call(command, **more):
    try:
        done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, timeout=PATIENCE_S, check=False, **more)
    except subprocess.TimeoutExpired as late:
        raise Fault(f"{command[0]} does not end within {PATIENCE_S} s") from late
    if done.returncode != 0:
        raise Fault(f"{command[0]} ends with code {done.returncode}: {done.stdout}")
    return done.stdout


def white_png():
    """One pixel, for whatever picture a document names."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"\0\xff")) +
            chunk(b"IEND", b""))


class Runner:
    def __init__(self, arguments, folder):
        self.arguments = arguments
        self.folder = Path(folder)
        self.commands = Commands(arguments.root, {"hl": arguments.hl, "hld": arguments.hld})
        self.tests = self.names_of_tests()

    def names_of_tests(self):
        listed = json.loads(subprocess.run(["ctest", "--show-only=json-v1"], cwd=self.arguments.build, check=True,
                                           stdout=subprocess.PIPE).stdout)
        return {test["name"] for test in listed["tests"]}

    def compile(self, block, text, *more):
        source = self.folder / f"block.{block.kind}"
        source.write_text(text, encoding="utf-8")
        compiler = [self.arguments.cc] if block.kind == "c" else [self.arguments.cxx, "-std=c++20"]
        call([*compiler, "-Wall", "-Wextra", "-Werror", source, "-I" + self.arguments.include, *more])

    def frame(self, block):
        frame = (FRAMES / block.argument).read_text(encoding="utf-8")
        self.compile(block, frame.replace("/* block */", block.text), "-c", "-o", self.folder / "block.o")

    def by(self, block):
        if block.argument not in self.tests:
            raise Fault(f"there is no test {block.argument}")

    def look_at(self, block):
        if block.kind == "sh":
            call(["bash", "-n", "-c", block.text])
            faults = self.commands.faults_of(block.text)
            if faults:
                raise Fault("; ".join(faults))
        elif block.kind == "js" and shutil.which("node"):
            script = self.folder / "block.js"
            script.write_text(block.text, encoding="utf-8")
            call(["node", "--check", script])
        elif block.kind == "python":
            ast.parse(block.text)

    def run_c(self, block):
        libraries = self.arguments.library.split(":")
        paths = [word for folder in libraries for word in ("-L" + folder, "-Wl,-rpath," + folder)]
        self.compile(block, block.text, *paths, "-lhl", "-o", self.folder / "block")
        call([self.folder / "block"])

    def run_json(self, block):
        scene = self.folder / "block.hl.json"
        scene.write_text(block.text, encoding="utf-8")
        textures = [texture["file"] for texture in json.loads(block.text).get("textures", [])]
        for name in textures:
            (self.folder / name).write_bytes(white_png())
        call([self.arguments.hl, "info", scene])

    def run_package(self, block):
        """A program with the Python package. A recording for it is there."""
        package = Path(self.arguments.build) / "python"
        if not package.is_dir():
            self.look_at(block)
            return
        if "session.hlr" in block.text:
            call([self.arguments.hl, "record", "teapot", "--out", self.folder / "session.hlr", "--duration", "1",
                  "--no-open", "--port", "0"])
        call(["/usr/bin/python3", "-c", block.text], cwd=self.folder,
             env={**os.environ, "PYTHONPATH": str(package), "MPLBACKEND": "Agg"})

    def run_numpy(self, block):
        """A program that reads what a block before it has made."""
        call(["/usr/bin/python3", "-c", block.text], cwd=self.folder)

    def run_python(self, block):
        """A client of the server that the text names: its own one here. Until the server has said a few things."""
        if block.text.startswith("import numpy"):
            self.run_numpy(block)
            return
        if block.text.startswith("import hl"):
            self.run_package(block)
            return
        server = Server(self.arguments.hld, None, ())
        program = subprocess.Popen(["/usr/bin/python3", "-u", "-c", block.text.replace(DEFAULT_ADDRESS, server.address)],
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        try:
            output = ""
            while "frame_shown" not in output:
                line = program.stdout.readline()
                if not line:
                    raise Fault(f"it has ended: {output}")
                output += line
        finally:
            program.kill()
            program.wait()
            server.stop()

    def run_sh(self, block):
        self.look_at(block)
        path = os.pathsep.join([str(Path(self.arguments.hl).parent), os.environ["PATH"]])
        text = SERVES.sub(r"\1 --no-open --port 0 ", block.text)
        call(["bash", "-e", "-c", text], cwd=self.folder, env={**os.environ, "PATH": path})

    def run(self, block):
        runs = {"c": self.run_c, "cpp": self.run_c, "json": self.run_json, "python": self.run_python, "sh": self.run_sh}
        if block.kind not in runs:
            raise Fault(f"{block.kind} can not be run here: say so in a comment before it")
        runs[block.kind](block)

    def test(self, block):
        {"run": self.run, "frame": self.frame, "by": self.by, "not run": self.look_at}[block.how](block)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=Path)
    for name in ("build", "include", "library", "hl", "hld"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--cc", default="cc")
    parser.add_argument("--cxx", default="c++")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    documents = [arguments.root / "README.md", arguments.root / "CONTRIBUTING.md",
                 *sorted((arguments.root / "docs").glob("*.md"))]
    blocks = [block for document in documents
              for block in blocks_of(document.read_text(encoding="utf-8"), document.relative_to(arguments.root))]
    faults, counts = 0, {}
    with tempfile.TemporaryDirectory() as folder:
        runner = Runner(arguments, folder)
        for block in blocks:
            if block.kind == "text":
                continue
            counts[block.how] = counts.get(block.how, 0) + 1
            try:
                runner.test(block)
            except (Fault, SyntaxError, ValueError) as fault:
                print(f"{block.where}: {fault}")
                faults += 1
    print(", ".join(f"{how}: {count}" for how, count in sorted(counts.items())) + f"; {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
