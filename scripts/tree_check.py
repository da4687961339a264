"""What the checks of the source tree have in common: a root, one line for each fault, and the exit code."""
import sys
from pathlib import Path


def main(name, document, check, arguments):
    """Runs check(root) and prints its faults; the exit code: 0 without, 1 with some, 2 where there is no tree."""
    if arguments and arguments[0] in ("-h", "--help"):
        print(document)
        return 0
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent
    if not (root / "src").is_dir():
        print(f"{name}: error: {root} has no folder src", file=sys.stderr)
        return 2
    faults = check(root)
    for fault in faults:
        print(fault)
    return 1 if faults else 0
