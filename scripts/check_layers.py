#!/usr/bin/env python3
"""Fails on an #include or a CMake link against the layers of HL, on a cycle of includes, and on source files over 500
lines.

    scripts/check_layers.py [ROOT]

A folder may use itself and folders of lower levels, never one beside or above it. Within a folder too no two units, a
header with the source of the same name, may use each other, by whatever way. Prints one line per fault; exit code 1.
"""
import re
import sys
from pathlib import Path

import tree_check

LEVELS = {
    "base": 0,
    "geometry": 1, "wire": 1, "device": 1,
    "surfaces": 2,
    "scene": 3, "control": 3,
    "proxy": 4, "bodies": 4, "scenes": 4,
    "io": 5,
    "touch": 6, "cad": 6, "vdb": 6,
    "record": 7, "tools": 7, "ros": 7,
    "session": 8, "batch": 8, "fleet": 8,
    "share": 9,
    "page": 10, "monitor": 10,
    "http": 11, "client": 11, "dds": 11,
    "bench": 12,
    "apps": 13, "python": 13,
}
# The proxy knows no threads, devices or messages, and the servo knows no scene, although their levels would allow it.
NEVER = {"proxy": {"device", "control", "wire"}, "control": {"geometry", "wire"}, "scene": {"wire", "device"}}
# Targets and generated headers that are not named after their folder.
TARGET_FOLDERS = {"hl_proto": "wire", "hl_json": "base", "hl_url": "base", "hl_websocket": "wire", "hl": "apps", "hld": "apps", "hl_cad_program": "apps", "hl_vdb_program": "apps", "hl_ros_program": "apps", "hl_share_program": "apps", "hl_share_wire": "share", "hl_share_types": "dds", "hl_ros_wire": "ros", "hl_ros_keys": "ros", "hl_ros2_types": "dds", "hl_frames": "session", "hl_batch_shared": "batch", "hl_inproc_link": "client", "hl_websocket_link": "client",
                  "hl_links": "client"}
HEADER_FOLDERS = {"hl.pb.h": "wire", "recording.pb.h": "wire", "fleet.pb.h": "wire", "share.pb.h": "wire"}
# CMake's own words inside a link list, and the target that only carries compiler flags.
NOT_FOLDERS = {"hl_flags"}

SOURCE_SUFFIXES = {".h", ".hpp", ".cpp", ".cc"}
MAX_LINES = 500

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')
LINK_CALL = re.compile(r"\b(hl_library|target_link_libraries)\s*\(([^)]*)\)")


def folder_dirs(root):
    """(folder name, directory) of every layer that exists."""
    for name in LEVELS:
        directory = root / name if name in ("apps", "bench", "scenes", "python") else root / "src" / name
        if directory.is_dir():
            yield name, directory


def fault_of(user, used):
    """Why folder `user` may not use folder `used`; None when it may."""
    if user == used:
        return None
    if used in NEVER.get(user, ()):
        return f"{user} must know nothing of {used}"
    if LEVELS[used] >= LEVELS[user]:
        return f"{user} (level {LEVELS[user]}) uses {used} (level {LEVELS[used]})"
    return None


def folder_of_include(path):
    """The layer an include path names; None for a header of the folder itself or of another library."""
    if path in HEADER_FOLDERS:
        return HEADER_FOLDERS[path]
    first = path.split("/", 1)[0]
    return first if "/" in path and first in LEVELS else None


def check_source(folder, path, label):
    lines = path.read_text(encoding="utf-8").splitlines()
    if len(lines) > MAX_LINES:
        yield f"{label}: {len(lines)} lines, more than {MAX_LINES}: split it by idea"
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        if ".." in Path(match.group(1)).parts:
            yield f"{label}:{number}: include by the path from src/, not by '..'"
            continue
        used = folder_of_include(match.group(1))
        fault = fault_of(folder, used) if used else None
        if fault:
            yield f"{label}:{number}: {fault}: {line.strip()}"


def folder_of_target(target):
    if target in NOT_FOLDERS:
        return None
    if target in TARGET_FOLDERS:
        return TARGET_FOLDERS[target]
    name = target.removeprefix("hl_")
    return name if target.startswith("hl_") and name in LEVELS else None


def check_cmake(folder, path, label):
    text = re.sub(r"#.*", "", path.read_text(encoding="utf-8"))
    for match in LINK_CALL.finditer(text):
        words = match.group(2).split()
        linked = words[words.index("LINK") + 1:] if "LINK" in words else words[1:]
        if match.group(1) == "hl_library" and "LINK" not in words:
            linked = []
        number = text.count("\n", 0, match.start()) + 1
        for target in linked:
            used = folder_of_target(target)
            fault = fault_of(folder, used) if used else None
            if fault:
                yield f"{label}:{number}: {fault}: links {target}"


def units_used(root):
    """The units that each one includes, by their names without ending, such as proxy/tick."""
    uses = {}
    for folder, directory in folder_dirs(root):
        for path in directory.rglob("*"):
            if path.suffix not in SOURCE_SUFFIXES:
                continue
            unit = f"{folder}/{path.relative_to(directory).with_suffix('')}"
            used = (match.group(1) for match in map(INCLUDE.match, path.read_text(encoding="utf-8").splitlines()) if match)
            uses.setdefault(unit, set()).update(str(Path(one).with_suffix("")) for one in used)
    return {unit: sorted(used & uses.keys() - {unit}) for unit, used in uses.items()}


def check_cycles(uses):
    """One fault for each way that leads back to a unit it has passed, found depth first."""
    done, way = set(), []

    def visit(unit):
        if unit in way:
            yield "a cycle of includes: " + " -> ".join(way[way.index(unit):] + [unit])
        elif unit not in done:
            way.append(unit)
            for used in uses[unit]:
                yield from visit(used)
            way.pop()
            done.add(unit)

    for unit in sorted(uses):
        yield from visit(unit)


def check(root):
    """All faults of the tree at `root`, in the order of the folders."""
    faults = []
    for folder, directory in folder_dirs(root):
        for path in sorted(directory.rglob("*")):
            label = path.relative_to(root)
            if path.suffix in SOURCE_SUFFIXES:
                faults.extend(check_source(folder, path, label))
            elif path.name == "CMakeLists.txt":
                faults.extend(check_cmake(folder, path, label))
    faults.extend(check_cycles(units_used(root)))
    return faults


def main(arguments):
    return tree_check.main("check_layers", __doc__, check, arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
