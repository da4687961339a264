"""A hand that leads a robot to a wall over a line of 100 ms each way and 5 % loss, with and without passivity control."""
import csv
import subprocess
from pathlib import Path

from plots.look import BLUE, GREY, MM, ORANGE, RED, canvas, column, save, style

SECONDS = 9
PROGRAM = "teleop_run"  # of tests/control


def run(bench, control):
    program = Path(bench.hl).with_name(PROGRAM)
    done = subprocess.run([str(program), control, str(SECONDS)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"figures: {program}\n{done.stderr}")
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(done.stdout.splitlines())]


def over_a_line(bench):
    figure, axes = canvas(3, 2, 7.2, sharex=True, sharey="row")
    facts = []
    for row, (title, control) in zip(axes.T, (("Without control: a plain force", "off"), ("With it", "on"))):
        rows = run(bench, control)
        time = column(rows, "time_s")
        places, forces, energy = row
        places.axhline(-10, color=GREY, lw=1, ls="--", label="wall")
        places.plot(time, column(rows, "hand_m", MM), color=BLUE, label="hand")
        places.plot(time, column(rows, "robot_m", MM), color=ORANGE, label="robot")
        forces.plot(time, column(rows, "contact_N"), color=ORANGE, lw=1, label="wall on robot")
        forces.plot(time, column(rows, "felt_N"), color=BLUE, label="felt")
        energy.axhline(-20, color=GREY, lw=1, ls="--", label="the tanks: -20 mJ")
        energy.plot(time, column(rows, "network_J", 1e3), color=RED, label="put in less given")
        energy.set_yscale("symlog", linthresh=50)
        energy.set_yticks([0, -1e2, -1e3, -1e4])
        style(places, "", "place (mm)", title)
        style(forces, "", "force (N)")
        style(energy, "time (s)", "energy (mJ)")
        forces.set_ylim(-2, 40)
        places.legend(loc="upper right")
        forces.legend(loc="upper right")
        energy.legend(loc="center right")
        least = min(column(rows, "network_J", 1e3))
        facts.append(f"control {control}: {-least:.1f} mJ more given than put in")
    save(figure, "teleoperation.png", *facts)
