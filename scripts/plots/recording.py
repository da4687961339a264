"""The picture of a black box: force, speed and state before a fault."""
import csv
import math
import subprocess

from plots.look import BLUE, GREEN, GREY, ORANGE, RED, canvas, column, save, style

STATE_COLOURS = {"off": GREY, "arming": ORANGE, "on": GREEN, "fault": RED, "waiting": BLUE}
SPEED_LIMIT_M_S = 0.15   # of the run that is drawn
# Of the hand, t x y z: it presses on a plane, strokes it, presses more, and pulls away faster than it may.
HAND_PATH = ((0, 0, 0.01, 0), (1.5, 0, -0.008, 0), (3, 0.03, -0.008, 0), (4.5, 0, -0.02, 0), (4.6, -0.05, 0.05, 0), (6, -0.05, 0.05, 0))
WINDOW_STEPS = 25        # of the mean that makes a speed from encoder counts readable


def steps_of(bench, file):
    """Rows of the servo steps of a recording."""
    out = bench.new_file(".csv")
    done = subprocess.run([bench.hl, "replay", str(file), "--csv", str(out)], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"figures: {file} can not be replayed: {done.stdout}{done.stderr}")
    with out.open() as source:
        return [{key: value if key in ("state", "fault") else float(value) for key, value in row.items()}
                for row in csv.DictReader(source)]


def provoked_fault(bench):
    """A black box of a hand that moves faster than it may."""
    path, folder = bench.new_file(".csv"), bench.new_file("_boxes")
    path.write_text("t,x,y,z\n" + "".join(",".join(map(str, row)) + "\n" for row in HAND_PATH))
    command = [bench.hl, "touch", "plane:2000", "--no-open", "--port", "0", "--scale", "1", "--hand-path", str(path),
               "--duration", str(HAND_PATH[-1][0]), "--speed-limit", str(SPEED_LIMIT_M_S), "--black-box", str(folder)]
    subprocess.run(command, capture_output=True, text=True, check=True)
    boxes = sorted(folder.glob("*.hlr"))
    if not boxes:
        raise SystemExit("figures: no fault came: " + " ".join(command))
    return boxes[0]


def smooth(values):
    half = WINDOW_STEPS // 2
    return [sum(values[max(0, i - half):i + half + 1]) / len(values[max(0, i - half):i + half + 1]) for i in range(len(values))]


def draw_states(axes, rows, times):
    """Bands of the states behind the curve, each named where it begins."""
    begin = 0
    for i in range(1, len(rows) + 1):
        if i < len(rows) and rows[i]["state"] == rows[begin]["state"]:
            continue
        state = rows[begin]["state"]
        axes.axvspan(times[begin], times[i - 1], color=STATE_COLOURS[state], alpha=0.12, lw=0)
        axes.annotate(state, (times[begin], 0.96), xycoords=("data", "axes fraction"), xytext=(3, 0), textcoords="offset points",
                      va="top", color=STATE_COLOURS[state])
        begin = i


def black_box(bench, file=None):
    rows = steps_of(bench, file or provoked_fault(bench))
    fault = next(i for i in range(len(rows) - 1, -1, -1) if rows[i]["state"] != "fault") + 1
    times = [row["t"] - rows[min(fault, len(rows) - 1)]["t"] for row in rows]
    forces = [math.hypot(row["force_x"], row["force_y"], row["force_z"]) for row in rows]
    figure, (force, depth, speed) = canvas(3, 1, 7.6, sharex=True)
    reason = rows[-1]["fault"] or "no fault"
    draw_states(force, rows, times)
    force.plot(times, forces, color="black", lw=1.2)
    style(force, "", "force (N)", f"Black box: {reason}")
    depth.plot(times, [1e3 * row["touching"] * math.dist([row["finger_" + a] for a in "xyz"], [row["proxy_" + a] for a in "xyz"])
                       for row in rows], color=BLUE, lw=1.2)
    style(depth, "", "finger to proxy (mm)")
    speed.plot(times, smooth(column(rows, "speed")), color=GREY, lw=1.2)
    style(speed, "time to the fault (s)", "speed of the finger (m/s)")
    save(figure, "black_box.png", f"{len(rows)} steps, {reason}; largest force {max(forces):.2f} N")
