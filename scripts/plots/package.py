"""Pictures that the examples of the Python package draw."""
import os
import subprocess
import sys
from pathlib import Path

from . import look

ROOT = Path(__file__).resolve().parent.parent.parent


def _run(example, name):
    """Lets an example draw its picture."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "build/python"), "MPLBACKEND": "Agg"}
    subprocess.run([sys.executable, ROOT / "examples/python" / example, look.folder / f"{name}.png"], check=True,
                   env=environment, stdout=subprocess.DEVNULL)


def force(_bench):
    _run("01_a_force.py", "python_force")


def fingers(_bench):
    _run("02_many_fingers.py", "python_fingers")
