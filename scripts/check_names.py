#!/usr/bin/env python3
"""Fails where two sources of a folder of src give the same name to two things of their own (in unnamed namespaces).

    scripts/check_names.py [ROOT]

The sources of a folder are compiled together, some at a time natively and all at once for a browser, and only what
stands in one of these groups would be noticed by the compiler. Functions may share a name when their parameters differ
in type. Prints one line per fault; exit code 1.
"""
import re
import sys
import tree_check

OPENS = re.compile(r"^(?:inline )?namespace(?: ([\w:]+))? \{")
CLOSES = re.compile(r"^\}  // namespace")
VALUE = re.compile(r"^(?:inline |static |thread_local )*(?:constexpr|const) [^()]*?\b(\w+)(?:\[[^\]]*\])* ?[={;]")
TYPE = re.compile(r"^(?:(?:struct|class|enum class|enum) (\w+)\b[^;]*$|using (\w+) =)")
FUNCTION = re.compile(r"^[A-Za-z][\w:<>,&* \[\]]*?[ &*](\w+)\(")
# These include themselves, once for each instruction set, each time in another namespace.
VECTOR_SOURCE = "hwy/foreach_target.h"


def split_parameters(text):
    """The parameters of a list, split at its commas outside brackets."""
    parts, depth, start = [], 0, 0
    for at, letter in enumerate(text):
        depth += (letter in "(<[{") - (letter in ")>]}")
        if letter == "," and depth == 0:
            parts.append(text[start:at])
            start = at + 1
    return [part.strip() for part in parts + [text[start:]] if part.strip()]


def parameter_types(text, start):
    """The types of the parameters of the list whose bracket opens before `start`."""
    depth, end = 1, start
    while end < len(text) and depth > 0:
        depth += (text[end] == "(") - (text[end] == ")")
        end += 1
    types = []
    for parameter in split_parameters(text[start:end - 1]):
        declared = re.sub(r"\s*=.*", "", parameter, flags=re.S)
        types.append(re.sub(r"(?<=[\w>&*]) ?\b\w+$", "", " ".join(declared.split())) or declared)
    return ", ".join(types)


def name_defined(lines, index):
    """What line `index`, of a namespace, defines: a name, for a function with the types of its parameters; or None."""
    line = lines[index]
    for pattern in (VALUE, TYPE):
        match = pattern.match(line)
        if match:
            return next(group for group in match.groups() if group)
    match = FUNCTION.match(line)
    if match is None or line.endswith(";"):
        return None
    text = "\n".join(lines[index:index + 20])
    return f"{match.group(1)}({parameter_types(text, match.end())})"


def private_names(path):
    """(name with its namespaces, line number) of all that stands in unnamed namespaces of a source."""
    lines = path.read_text(encoding="utf-8").splitlines()
    spaces = []
    for index, line in enumerate(lines):
        opened = OPENS.match(line)
        if opened:
            spaces.append(opened.group(1) or "")
        elif CLOSES.match(line) and spaces:
            spaces.pop()
        elif "" in spaces:
            name = name_defined(lines, index)
            if name:
                yield "::".join([space for space in spaces if space] + [name]), index + 1


def check_folder(directory, root):
    first = {}
    for path in sorted(directory.rglob("*.cpp")):
        if VECTOR_SOURCE in path.read_text(encoding="utf-8"):
            continue
        for name, number in private_names(path):
            other, line = first.setdefault(name, (path, number))
            if other != path:
                yield f"{path.relative_to(root)}:{number}: {name} is in {other.relative_to(root)}:{line} too"


def check(root):
    """All faults of the folders of src, and of those beside it that are compiled in the same way."""
    folders = sorted(path for path in (root / "src").iterdir() if path.is_dir()) + [root / "scenes", root / "web"]
    return [fault for folder in folders if folder.is_dir() for fault in check_folder(folder, root)]


def main(arguments):
    return tree_check.main("check_names", __doc__, check, arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
