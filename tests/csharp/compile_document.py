#!/usr/bin/env python3
"""Compiles the C# of docs/csharp.md: the whole script against the stub of Unity, the lines of use within a function.

    compile_document.py MCS DOCUMENT CLIENT STUB
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

AROUND_LINES = """using System;
using HL;
static class Lines {{
    static void Use(TouchMesh mesh, double[] matrix) {{
{}
    }}
}}
"""


def main(mcs, document, client, stub):
    blocks = re.findall(r"^```csharp\n(.*?)^```$", Path(document).read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    if len(blocks) < 2:
        raise SystemExit("the document has lost its C#")
    with tempfile.TemporaryDirectory() as folder:
        for number, block in enumerate(blocks):
            source = Path(folder, f"block{number}.cs")
            source.write_text(block if "class" in block else AROUND_LINES.format(block), encoding="utf-8")
            subprocess.run([mcs, "-langversion:7", "-warnaserror", "-target:library", f"-out:{folder}/block.dll",
                            str(source), client, stub], check=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
