"""Fleets: what a sweep of traces says, over seeds."""
import shutil
import subprocess
from pathlib import Path

import numpy as np

from plots.look import BLUE, MM, RED, ROOT, canvas, save, style

EXAMPLE = ROOT / "examples" / "sweeps"


def friction(bench):
    """The largest gap between finger and proxy against friction, for two radii."""
    folder = Path(shutil.copytree(EXAMPLE, bench.folder / "sweeps"))
    command = [bench.hl, "sweep", str(folder / "friction.toml")]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"figures: {' '.join(command)}\n{done.stderr}")
    table = np.load(folder / "friction.sweep" / "result.npz")
    frictions = np.unique(table["dynamic_friction"])
    figure, axes = canvas(1, 1, 4.2)
    facts = []
    for radius, color in zip(np.unique(table["radius"]), (BLUE, RED)):
        gaps = np.array([table["gap_max_m"][(table["radius"] == radius) & (table["dynamic_friction"] == mu)] for mu in frictions])
        low, middle, high = MM * np.percentile(gaps, [10, 50, 90], axis=1)
        axes.fill_between(frictions, low, high, color=color, alpha=0.25, lw=0)
        axes.plot(frictions, middle, marker="o", ms=4, color=color, lw=1.8, label=f"radius of the proxy {MM * radius:g} mm")
        facts.append(f"radius {MM * radius:g} mm: {middle[0]:.2f} mm without friction, {middle[-1]:.2f} mm with {frictions[-1]:g}")
    axes.legend(loc="upper left")
    style(axes, "dynamic friction", "largest finger to proxy (mm)", f"{table['task'].size} traces across a rough surface")
    save(figure, "sweep.png", *facts)
