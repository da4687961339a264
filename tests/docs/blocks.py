"""The fenced blocks of a document, and what the comment before each says about its test.

Before a block may stand, as an HTML comment in the line above it:

    <!-- test: frame NAME -->       compiled within tests/docs/frames/NAME
    <!-- test: by NAME -->          the ctest of this name builds and runs it
    <!-- test: not run, REASON -->  only looked at: its syntax; of a command also whether program and options exist

Without one it is built and run. A block of text is no program, and has no comment.
"""
import re
from dataclasses import dataclass

FENCE = re.compile(r"^```(.*)$")
COMMENT = re.compile(r"^<!-- test: (?:(frame|by) ([\w.]+)|(not run), (\S.*)) -->$")
KINDS = ("c", "cpp", "csharp", "js", "json", "python", "sh", "text", "yaml")


@dataclass
class Block:
    where: str  # document:line of its fence
    kind: str
    text: str
    how: str = "run"  # "frame", "by", "not run"
    argument: str = ""


def how_of(line, where):
    """("run", "") where the line before a block is no comment about its test."""
    if not line.startswith("<!-- test:"):
        return "run", ""
    found = COMMENT.match(line)
    if not found:
        raise SystemExit(f"{where}: the comment is none of those in tests/docs/blocks.py")
    return (found.group(1), found.group(2)) if found.group(1) else (found.group(3), found.group(4))


def blocks_of(text, name):
    blocks, block, before = [], None, ""
    for number, line in enumerate(text.splitlines(), 1):
        fence = FENCE.match(line)
        if not fence:
            if block:
                block.text += line + "\n"
        elif block:
            blocks.append(block)
            block = None
        else:
            where = f"{name}:{number}"
            if fence.group(1) not in KINDS:
                raise SystemExit(f"{where}: ```{fence.group(1)} is none of {', '.join(KINDS)}")
            block = Block(where, fence.group(1), "", *how_of(before, where))
        before = line
    if block:
        raise SystemExit(f"{block.where}: the block has no end")
    return blocks
