#!/usr/bin/env python3
"""Makes from hl.h and hl_types.h what binds their calls to Python: the C++ source, and the stub with types and docs.

    generate_calls.py INCLUDE_FOLDER STUB_OF_THE_OTHERS CALLS_CPP CALLS_PYI

Calls whose arguments are numbers, or a vector of a fixed size, are bound by what is made here; those with arrays, texts
or callbacks are bound by src/array_calls.cpp, and their types stand in STUB_OF_THE_OTHERS.
"""
import re
import sys
import textwrap
from pathlib import Path
from typing import NamedTuple, Optional

SCALARS = {"HLenum": "int", "HLboolean": "bool", "HLbitfield": "int", "HLint": "int", "HLuint": "int", "HLsizei": "int",
           "HLfloat": "float", "HLdouble": "float"}
# Vectors of a fixed size, by the end of the name of their call.
VECTOR_SIZES = {"2fv": 2, "2dv": 2, "3fv": 3, "3dv": 3, "Matrixf": 16, "Matrixd": 16}
# What waits must let other threads run, and arrays are given to the call that draws them.
BY_HAND = {"hlFinish", "hlFinishTimeout", "hlPoll", "hlDrawArrays", "hlDrawElements", "hlHeightField", "hlVolume",
           "hlVolumeMatter", "hlDepthFrame", "hlNurbsSurface", "hlPointCloud", "hlPointColors",
           "hlImplicit"}
# What Python does not need: errors are exceptions, and arrays are arguments. docs/python.md names them.
LEFT_OUT = {"hlGetError", "hlErrorFunc", "hlGetConnectError", "hlVertexPointer", "hlNormalPointer", "hlTexCoordPointer",
            "hlEnableClientState", "hlDisableClientState"}


class Argument(NamedTuple):
    type: str
    name: str


class Call(NamedTuple):
    result: str
    name: str
    arguments: list
    doc: str


def plain(comment: str) -> str:
    """The text of a C comment."""
    return " ".join(re.sub(r"^\s*\*\s?", "", line) for line in comment.strip().splitlines()).strip()


def calls(header: str) -> list:
    """Every call of a header, in its order, with the comment before or behind it."""
    found = re.finditer(r"(?:/\*\*(?!<)((?:(?!\*/).)*)\*/\s*)?^HL_API ([^;(]*?)(\w+)\(([^;]*)\);(?:[ \t]*/\*\*<(.*?)\*/)?",
                        header, re.MULTILINE | re.DOTALL)
    result = []
    for match in found:
        before, kind, name, words, behind = match.groups()
        arguments = [] if words.strip() == "void" else [
            Argument(*re.fullmatch(r"(.*?)(\w+)", " ".join(word.split())).groups()) for word in words.split(",")]
        arguments = [Argument(argument.type.strip(), argument.name) for argument in arguments]
        result.append(Call(kind.strip(), name, arguments, plain(before or behind or "")))
    return result


def vector_of(call: Call) -> Optional[tuple]:
    """(type of a number, how many) when the call takes one vector of a fixed size."""
    if len(call.arguments) != 1:
        return None
    match = re.fullmatch(r"const (HLfloat|HLdouble)\*", call.arguments[0].type)
    size = next((size for end, size in VECTOR_SIZES.items() if call.name.endswith(end)), None)
    return (match.group(1), size) if match and size else None


def is_plain(call: Call) -> bool:
    """Whether numbers are all that goes in and out."""
    return (call.name not in BY_HAND and (call.result == "void" or call.result in SCALARS)
            and all(argument.type in SCALARS for argument in call.arguments))


def constants(types: str) -> list:
    """(name, value, number of values where it has several) of each constant."""
    found = []
    for block in re.finditer(r"/\*\*((?:(?!\*/).)*)\*/\s*enum \{(.*?)\};", types, re.DOTALL):
        is_query = block.group(1).lstrip().startswith("hlGet*v")
        for name, value, comment in re.findall(r"(HL_\w+) = (\w+),?(?:[ \t]*/\*\*<((?:(?!\*/).)*)\*/)?",
                                               block.group(2), re.DOTALL):
            count = re.match(r"\s*(\d+)\b" if is_query else r"\s*(?:hlGet\w+dv, )?(\d+);", comment)
            found.append((name, int(value, 0), int(count.group(1)) if count else 1))
    return found


def quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def source(bound: list, numbers: list) -> str:
    lines = ["// Made by python/generate_calls.py from hl.h and hl_types.h.", '#include "calls.h"', "",
             "void bindPlainCalls(pybind11::module_& module) {"]
    for call in bound:
        names = "".join(f", pybind11::arg({quoted(argument.name)})" for argument in call.arguments)
        vector = vector_of(call)
        wrapper = f"checkedVector<{vector[1]}>(&{call.name})" if vector else f"checked(&{call.name})"
        lines.append(f"  module.def({quoted(call.name)}, {wrapper}{names}, {quoted(call.doc)});")
    lines += ["}", "", "void bindConstants(pybind11::module_& module) {"]
    lines += [f"  module.attr({quoted(name)}) = {value}U;" for name, value, _ in numbers]
    lines += ["}", "", "std::size_t valuesOf(HLenum query) {", "  switch (query) {"]
    lines += [f"    case {name}: return {count};" for name, _, count in numbers if count > 1]
    return "\n".join(lines + ["    default: return 1;", "  }", "}", ""])


def stub(bound: list, numbers: list, others: str) -> str:
    lines = [others.rstrip(), ""]
    lines += [f"{name}: Final[int]" for name, _, _ in numbers]
    for call in bound:
        vector = vector_of(call)
        words = ", ".join(f"{argument.name}: {'Sequence[float]' if vector else SCALARS[argument.type]}"
                          for argument in call.arguments)
        lines.append(f"def {call.name}({words}) -> {SCALARS.get(call.result, 'None')}:")
        lines.append(textwrap.indent('"""' + "\n".join(textwrap.wrap(call.doc, 112)) + '"""', "    "))
    return "\n".join(lines) + "\n"


def main() -> None:
    include, others, cpp, pyi = (Path(argument) for argument in sys.argv[1:])
    numbers = constants((include / "hl/hl_types.h").read_text(encoding="utf-8"))
    bound = [call for call in calls((include / "hl/hl.h").read_text(encoding="utf-8"))
             if call.name not in LEFT_OUT and (vector_of(call) or is_plain(call))]
    cpp.write_text(source(bound, numbers), encoding="utf-8")
    pyi.write_text(stub(bound, numbers, others.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
