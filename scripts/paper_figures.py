"""The figures of the paper, drawn again from runs of `hl trace` on scenes written here (docs/paper.md shows them)."""
import csv
import json
import math
import subprocess

import matplotlib.pyplot as plt
from matplotlib.patches import Polygon, Rectangle

BLUE, RED, GREY, GREEN, ORANGE = "#2f6fb2", "#c0392b", "#5b6675", "#2e7d3a", "#b06a00"
SOLID = "#dfe5ec"
MM = 1000.0
RATE_HZ = 1000.0


def style(axes, x, y):
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.grid(alpha=0.25)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


class Bench:
    """Writes scenes and paths into a folder and runs hl trace on them."""

    def __init__(self, hl, folder):
        self.hl, self.folder, self.count = hl, folder, 0

    def name(self, ending):
        self.count += 1
        return self.folder / f"{self.count}{ending}"

    def scene(self, objects, textures=()):
        file = self.name(".hl.json")
        file.write_text(json.dumps({"textures": list(textures), "objects": objects}))
        return file

    def trace(self, scene, points, *options, rate_Hz=RATE_HZ):
        """Rows of the trace as dictionaries of numbers, one for each point of the finger's path."""
        path, out = self.name(".csv"), self.name(".csv")
        with path.open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["t", "x", "y", "z"])
            writer.writerows([i / rate_Hz, *p] for i, p in enumerate(points))
        subprocess.run([self.hl, "trace", str(scene), "--path", str(path), "--out", str(out), *map(str, options)],
                       check=True, stderr=subprocess.DEVNULL)
        with out.open() as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def column(rows, name, scale=1.0):
    return [scale * row[name] for row in rows]


def straight(a, b, step):
    """Points from a to b, `step` metres apart."""
    length = math.dist(a, b)
    n = max(1, round(length / step))
    return [tuple(p + (q - p) * i / n for p, q in zip(a, b)) for i in range(n + 1)]


def wall(a, b, half_width=0.05, **material):
    """A rectangle that stands on the line from a to b of the plane z = 0."""
    (ax, ay), (bx, by) = a, b
    return {"primitives": {"vertices": [ax, ay, half_width, bx, by, half_width, bx, by, -half_width, ax, ay, -half_width],
                           "texcoords": [0, 0, 1, 0, 1, 1, 0, 1],
                           "polygons": [{"vertices": [0, 1, 2, 3]}]}, "material": {"shade": "FLAT", **material}}


def loop(corners, **material):
    return [wall(a, b, **material) for a, b in zip(corners, corners[1:] + corners[:1])]


def prism(sides, radius):
    """A regular prism about z with radial vertex normals; face 0 looks along +x."""
    vertices, normals, polygons = [], [], []
    for i in range(sides):
        angle = math.pi / sides * (2 * i + 1)
        c, s = math.cos(angle), math.sin(angle)
        for z in (-0.05, 0.05):
            vertices += [radius * c, radius * s, z]
            normals += [c, s, 0]
        a, b = 2 * i, 2 * ((i + 1) % sides)
        polygons.append({"vertices": [a, b, b + 1, a + 1]})
    return {"primitives": {"vertices": vertices, "normals": normals, "polygons": polygons}}


def corners_of(sides, radius):
    return [(radius * math.cos(math.pi / sides * (2 * i + 1)), radius * math.sin(math.pi / sides * (2 * i + 1)))
            for i in range(sides)]


def save(figure, folder, name):
    figure.savefig(folder / name, dpi=100)
    plt.close(figure)
    print(f"docs/figures/{name}")


def proxy_path(bench, folder):
    """Figure 1: the finger goes straight through an obstacle; the proxy goes around as far as that brings it nearer."""
    box = [(-0.02, -0.012), (0.012, -0.02), (0.024, 0.004), (0.004, 0.018), (-0.024, 0.008)]
    scene = bench.scene(loop(box))
    points = straight((-0.04, 0.016, 0), (0.0, -0.004, 0), 1e-4) + straight((0, -0.004, 0), (0.038, 0.012, 0), 1e-4)[1:]
    rows = bench.trace(scene, points, "--radius", 0.002)
    figure, axes = plt.subplots(figsize=(7.5, 4.6), layout="constrained")
    axes.add_patch(Polygon([(MM * x, MM * y) for x, y in box], closed=True, facecolor=SOLID, edgecolor=GREY))
    for row in rows[::12]:
        axes.plot([MM * row["finger_x"], MM * row["proxy_x"]], [MM * row["finger_y"], MM * row["proxy_y"]], color=GREY, lw=0.5)
    axes.plot(column(rows, "finger_x", MM), column(rows, "finger_y", MM), color=RED, lw=1.4, label="finger")
    axes.plot(column(rows, "proxy_x", MM), column(rows, "proxy_y", MM), color=BLUE, lw=2, label="proxy (r = 2 mm)")
    for row in rows[:: len(rows) // 14]:
        axes.add_patch(plt.Circle((MM * row["proxy_x"], MM * row["proxy_y"]), 2, fill=False, color=BLUE, lw=0.7))
    axes.set_aspect("equal")
    axes.set_title("Figure 1: the proxy follows the finger and never enters the obstacle")
    axes.legend(frameon=False, loc="upper left")
    style(axes, "x (mm)", "y (mm)")
    save(figure, folder, "paper_1_proxy.png")


def penalty_plate(y, thickness, stiffness):
    """Force of a penalty method on a finger at height y in a plate from -thickness to 0: out by the nearest side."""
    if not -thickness < y < 0:
        return 0.0
    return stiffness * -y if -y < thickness / 2 else -stiffness * (y + thickness)


def penalty_cubes(x, y, side, stiffness):
    """Force of two cubes side by side, each pushing out by its own nearest face."""
    force = [0.0, 0.0]
    for low, high in ((-side, 0.0), (0.0, side)):
        if not (low < x < high and -side < y < 0):
            continue
        depth, axis, sign = min((-y, 1, 1), (x - low, 0, -1), (high - x, 0, 1), (y + side, 1, -1))
        force[axis] += sign * stiffness * depth
    return force


def penalty(bench, folder):
    """Figure 2: a thin plate and two touching cubes, beside a penalty method."""
    figure, (plate, cubes) = plt.subplots(1, 2, figsize=(11, 4.3), layout="constrained")
    thickness, stiffness = 0.002, 1000
    scene = bench.scene([wall((-0.03, 0), (0.03, 0)), wall((-0.03, -thickness), (0.03, -thickness))])
    rows = bench.trace(scene, straight((0, 0.002, 0), (0, -0.008, 0), 2e-5), "--radius", 1e-4)
    depth = [-MM * row["finger_y"] for row in rows]
    plate.plot(depth, column(rows, "force_y"), color=BLUE, lw=2, label="proxy")
    plate.plot(depth, [penalty_plate(row["finger_y"], thickness, stiffness) for row in rows], color=RED, lw=1.4, label="penalty")
    plate.axvspan(0, MM * thickness, color=SOLID)
    plate.set_title("Through a plate of 2 mm: no pop-through")
    plate.legend(frameon=False)
    style(plate, "depth of the finger (mm)", "force out of the plate (N)")

    side, press = 0.03, 0.004
    boxes = [[(-side, -side), (0, -side), (0, 0), (-side, 0)], [(0, -side), (side, -side), (side, 0), (0, 0)]]
    scene = bench.scene([part for box in boxes for part in loop(box)])
    points = straight((-0.012, 0.002, 0), (-0.012, -press, 0), 1e-4) + straight((-0.012, -press, 0), (0.012, -press, 0), 1e-4)
    rows = bench.trace(scene, points, "--radius", 1e-4)[60:]
    x = column(rows, "finger_x", MM)
    forces = [penalty_cubes(row["finger_x"], row["finger_y"], side, stiffness) for row in rows]
    cubes.plot(x, column(rows, "force_y"), color=BLUE, lw=2, label="proxy, up")
    cubes.plot(x, column(rows, "force_x"), color=BLUE, lw=1.2, ls="--", label="proxy, sideways")
    cubes.plot(x, [f[1] for f in forces], color=RED, lw=1.4, label="penalty, up")
    cubes.plot(x, [f[0] for f in forces], color=RED, lw=1.2, ls="--", label="penalty, sideways")
    cubes.axvline(0, color=GREY, lw=0.8)
    cubes.set_title("Over the joint of two cubes, 4 mm deep: one surface")
    cubes.legend(frameon=False, fontsize=8)
    style(cubes, "finger along the cubes (mm)", "force (N)")
    save(figure, folder, "paper_2_penalty.png")


def passes(bench, folder):
    """Figure 5: the two passes on a plane whose normals lean, once a tick: each leaves sin^2(beta) of the error."""
    beta, depth, radius = math.radians(25), 0.01, 0.001
    lean = [math.sin(beta), math.cos(beta), 0]
    floor = {"primitives": {"vertices": [-0.1, 0, 0.1, 0.1, 0, 0.1, 0.1, 0, -0.1, -0.1, 0, -0.1], "normals": lean * 4,
                            "polygons": [{"vertices": [0, 1, 2, 3]}]}}
    finger = (0, radius - depth, 0)
    rows = bench.trace(bench.scene([floor]), [(0, 0.003, 0)] + [finger] * 7, "--radius", radius, "--shading-passes", "once",
                       "--ledger", "report")[1:]
    goal = depth * math.tan(beta)
    figure, (scene, error) = plt.subplots(1, 2, figsize=(11, 4.2), layout="constrained", gridspec_kw={"width_ratios": [1.4, 1]})
    scene.add_patch(Rectangle((-3, -12), 12, 12, facecolor=SOLID))
    scene.axhline(0, color=GREY)
    scene.plot(MM * finger[0], MM * finger[1], "o", color=RED, label="finger")
    scene.plot([MM * finger[0], MM * goal], [MM * finger[1], MM * radius], color=GREEN, lw=1, label="along the shaded normal")
    at = 0.0
    for i, row in enumerate(rows[:4]):
        # Pass 1 ends where the finger projects on the shaded plane through the last proxy.
        height = lean[0] * (at - finger[0]) + lean[1] * (radius - finger[1])
        first = (finger[0] + lean[0] * height, finger[1] + lean[1] * height)
        label = {"label": "pass 1"} if i == 0 else {}
        scene.plot([MM * at, MM * first[0]], [MM * radius, MM * first[1]], color=ORANGE, lw=1, **label)
        scene.plot([MM * first[0], MM * row["proxy_x"]], [MM * first[1], MM * radius], color=BLUE, lw=1, ls=":",
                   **({"label": "pass 2"} if i == 0 else {}))
        at = row["proxy_x"]
    scene.plot(column(rows, "proxy_x", MM), column(rows, "proxy_y", MM), "o", color=BLUE, ms=4, label="proxy, tick by tick")
    scene.set_aspect("equal")
    scene.set_ylim(-11, 3)
    scene.set_xlim(-3, 8)
    scene.set_title("Figure 5: two passes a tick, normals leaning by 25°")
    scene.legend(frameon=False, fontsize=8, loc="lower right")
    style(scene, "x (mm)", "y (mm)")
    ticks = range(len(rows))
    error.semilogy(ticks, [goal * MM] + [abs(goal - row["proxy_x"]) * MM for row in rows[:-1]], "o", color=BLUE, label="measured")
    error.semilogy(ticks, [goal * MM * math.sin(beta) ** (2 * i) for i in ticks], color=GREEN, label="sin²β each pass")
    error.set_title("Distance to the fixed point")
    error.legend(frameon=False)
    style(error, "ticks", "error (mm)")
    save(figure, folder, "paper_5_passes.png")


def around(radius, speed, turn=2 * math.pi, start=0.0):
    n = round(turn * radius / (speed / RATE_HZ))
    return [(radius * math.cos(start + turn * i / n), radius * math.sin(start + turn * i / n), 0) for i in range(n + 1)]


def ten_gon(bench, folder):
    """Figure 6: a finger on a circle in a ten-sided prism, flat and shaded, with the closed form."""
    size, rho, radius, alpha = 0.05, 0.045, 0.0025, math.pi / 10
    scene = bench.scene([prism(10, size)])
    points = straight((0.06, 0, 0), (rho, 0, 0), 1e-4) + around(rho, 0.1)[1:]
    lead = len(points) - len(around(rho, 0.1)) + 1
    figure, axes = plt.subplots(2, 2, figsize=(11, 9), layout="constrained", gridspec_kw={"height_ratios": [1.6, 1]})
    for i, (shade, title) in enumerate((("flat", "6a: flat"), ("smooth", "6b: force shaded"))):
        rows = bench.trace(scene, points, "--radius", radius, "--shade", shade, "--ledger", "report")[lead:]
        top, bottom = axes[0][i], axes[1][i]
        top.add_patch(Polygon([(MM * x, MM * y) for x, y in corners_of(10, size)], closed=True, facecolor=SOLID, edgecolor=GREY))
        for row in rows[::12]:
            top.plot([MM * row["finger_x"], MM * row["proxy_x"]], [MM * row["finger_y"], MM * row["proxy_y"]], color=BLUE, lw=0.5)
        top.plot(column(rows, "finger_x", MM), column(rows, "finger_y", MM), color=RED, lw=1, label="finger")
        top.plot(column(rows, "proxy_x", MM), column(rows, "proxy_y", MM), color=BLUE, lw=1.4, label="proxy")
        top.set_aspect("equal")
        top.set_title(f"Figure {title}")
        top.legend(frameon=False, loc="center")
        style(top, "x (mm)", "y (mm)")
        theta = [math.atan2(row["finger_y"], row["finger_x"]) for row in rows]
        error = [math.degrees(math.remainder(math.atan2(row["force_y"], row["force_x"]) - a, 2 * math.pi)) for row, a in zip(rows, theta)]
        quarter = len(rows) // 4
        bottom.plot([math.degrees(a) for a in theta[:quarter]], error[:quarter], color=BLUE, lw=1.6, label="measured")
        if shade == "flat":
            jump = math.degrees(math.asin(size * math.sin(alpha) / rho))
            bottom.axvline(jump, color=GREEN, lw=1, ls="--", label=f"asin(R sin 18° / ρ) = {jump:.2f}°")
        bottom.set_ylim(-25, 25)
        bottom.legend(frameon=False, loc="upper right", fontsize=8)
        bottom.set_title("direction of the force against radial")
        style(bottom, "finger's angle (degrees)", "off radial (degrees)")
    save(figure, folder, "paper_6_ten_gon.png")


def softness(bench, folder):
    """Figure 7: a soft surface lets the finger in; the proxy stays on it and the target goes between."""
    figure, (picture, force) = plt.subplots(1, 2, figsize=(11, 4), layout="constrained")
    points = straight((-0.01, 0.004, 0), (0.01, -0.006, 0), 1e-4)
    for s, colour in ((1.0, BLUE), (0.5, GREEN), (0.2, ORANGE)):
        rows = bench.trace(bench.scene([wall((-0.05, 0), (0.05, 0))]), points, "--radius", 1e-3, "--stiffness", s)
        picture.plot(column(rows, "target_x", MM), column(rows, "target_y", MM), color=colour, label=f"target, s = {s}")
        force.plot([-MM * row["finger_y"] + 1 for row in rows], column(rows, "force_y"), color=colour, label=f"s = {s}")
    picture.plot(column(rows, "finger_x", MM), column(rows, "finger_y", MM), color=RED, label="finger")
    picture.plot(column(rows, "proxy_x", MM), column(rows, "proxy_y", MM), color="black", lw=1, ls="--", label="proxy")
    picture.axhspan(-7, 0, color=SOLID)
    picture.set_title("Figure 7: softness moves the target, not the proxy")
    picture.legend(frameon=False, fontsize=8, loc="lower left")
    style(picture, "x (mm)", "y (mm)")
    force.set_title("Force at K = 1000 N/m")
    force.legend(frameon=False)
    style(force, "depth of the finger (mm)", "force (N)")
    save(figure, folder, "paper_7_softness.png")


def friction(bench, folder):
    """Tangential force against displacement, 1.8 N pressed, at four speeds, without and with viscosity."""
    depth, stiffness, mu_s, mu_d, radius = 0.001, 1800, 0.6, 0.4, 0.001
    scene = bench.scene([wall((-0.1, 0), (0.1, 0), half_width=0.1)])
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.2), layout="constrained", sharey=True)
    for plot, viscosity in zip(axes, (0, 2)):
        for speed, colour in ((0.01, BLUE), (0.05, GREEN), (0.1, ORANGE), (0.2, RED)):
            y = radius - depth
            points = [(-0.05, 0.003, 0), (-0.05, y, 0)] + straight((-0.05, y, 0), (-0.046, y, 0), speed / RATE_HZ)[1:]
            rows = bench.trace(scene, points, "--radius", radius, "--kp", stiffness, "--static-friction", mu_s,
                               "--dynamic-friction", mu_d, "--viscosity", viscosity)[1:]
            plot.plot([MM * (row["finger_x"] + 0.05) for row in rows], [-row["force_x"] for row in rows], color=colour,
                      label=f"{speed} m/s")
            expected = mu_d * stiffness * depth + viscosity * speed
            plot.axhline(expected, color=colour, lw=0.7, ls=":")
        plot.set_title(f"b = {viscosity} N s/m; dotted: μ_d f_n + b u")
        plot.legend(frameon=False)
        style(plot, "finger's displacement (mm)", "drag (N)")
    save(figure, folder, "paper_friction.png")


def energy(bench, folder):
    """Science's cycle: press in at the middle of a shaded face, slide to a corner, come out there."""
    size, rho, alpha = 0.05, 0.045, math.pi / 10
    scene = bench.scene([prism(10, size)])
    out = 0.056
    points = straight((out, 0, 0), (rho, 0, 0), 1e-4)
    points += around(rho, 0.1, alpha)[1:]
    points += straight((rho * math.cos(alpha), rho * math.sin(alpha), 0), (out * math.cos(alpha), out * math.sin(alpha), 0), 1e-4)[1:]
    figure, axes = plt.subplots(figsize=(8, 4.2), layout="constrained")
    for mode, colour, width in (("report", RED, 3), ("tank", GREEN, 1.5), ("strict", BLUE, 1.5)):
        rows = bench.trace(scene, points, "--radius", 1e-5, "--shade", "smooth", "--ledger", mode)
        touching = [row["injected_J"] if row["contacts"] > 0 else 0 for row in rows]
        total, sums = 0.0, []
        for joules in touching:
            total += max(0.0, joules)
            sums.append(1e3 * total)
        axes.plot(column(rows, "t"), sums, color=colour, lw=width, label=f"--ledger {mode}: {total * 1e3:.2f} mJ in all")
    axes.set_title("Energy added by shading: in at a face, to the corner, out (R = 50 mm, K = 1000 N/m)")
    axes.legend(frameon=False)
    style(axes, "time (s)", "energy added (mJ)")
    save(figure, folder, "paper_energy.png")


def texture(bench, folder):
    """Lines of friction 0.1 mm wide and 5 mm apart, at three speeds: none is missed."""
    y, radius = -0.001, 0.001
    lines = {"name": "lines", "procedural": {"kind": "lines", "size": 50, "duty": 0.02}}
    floor = wall((-0.1, 0), (0.1, 0), half_width=0.1, repeatU=40, repeatV=40,
                 textures=[{"texture": "lines", "quantity": "DYNAMIC_FRICTION", "low": 0, "high": 0.5}])
    scene = bench.scene([floor], [lines])
    figure, axes = plt.subplots(figsize=(9, 4.2), layout="constrained")
    for k, (speed, colour) in enumerate(((0.02, BLUE), (0.2, GREEN), (0.5, RED))):
        points = [(-0.0486, 0.003, 0), (-0.0486, y, 0)] + straight((-0.0486, y, 0), (-0.018, y, 0), speed / RATE_HZ)[1:]
        rows = bench.trace(scene, points, "--radius", radius)[1:]
        axes.plot(column(rows, "finger_x", MM), [-row["force_x"] + 1.5 * k for row in rows], color=colour,
                  label=f"{speed} m/s: {speed / RATE_HZ * MM:.2g} mm a tick")
    for i in range(6):
        axes.axvline(-45 + 5 * i, color=GREY, lw=0.6)
    axes.set_title("Lines of friction 0.1 mm wide, felt along the path (curves 1.5 N apart)")
    axes.set_ylim(-0.2, 5.4)
    axes.legend(frameon=False, loc="upper right", fontsize=8, ncols=3)
    style(axes, "finger along the floor (mm)", "drag (N)")
    save(figure, folder, "paper_texture.png")


def draw_all(hl, directory, folder):
    bench = Bench(hl, directory)
    for figure in (proxy_path, penalty, passes, ten_gon, softness, friction, energy, texture):
        figure(bench, folder)
