"""Figures 1 and 2 of the paper: the way of the proxy, and what penalty methods cannot do."""
from matplotlib.patches import Circle, Polygon, Rectangle

from plots.bench import loop, straight, wall
from plots.look import BLUE, GREY, MM, RED, SOLID, canvas, column, draw_arrow, draw_springs, draw_way, save, style


def draw_followed(axes, rows, radius, circles):
    draw_springs(axes, [row for row in rows[::10] if row["contacts"] > 0])
    draw_way(axes, rows, "finger", color=RED, lw=1.6, label="finger")
    draw_way(axes, rows, "proxy", color=BLUE, lw=2.2, label=f"proxy, r = {radius * MM:g} mm")
    for row in rows[::max(1, len(rows) // circles)]:
        axes.add_patch(Circle((MM * row["proxy_x"], MM * row["proxy_y"]), MM * radius, fill=False, color=BLUE, lw=0.7))
    axes.set_aspect("equal")


def proxy_path(bench):
    """Figure 1: straight through an obstacle, and into a pocket, through its wall and out over its rim."""
    figure, (through, pocket) = canvas(1, 2, 3.5, gridspec_kw={"width_ratios": [2, 1]})
    radius = 0.002
    rock = [(-0.024, -0.006), (-0.010, -0.016), (0.016, -0.014), (0.024, 0.002), (0.008, 0.017), (-0.014, 0.014)]
    rows = bench.trace(bench.obj(loop(rock)), straight((-0.042, 0.002), (0.042, 0.006), speed=0.1), "--radius", radius)
    through.add_patch(Polygon([(MM * x, MM * y) for x, y in rock], closed=True, facecolor=SOLID, edgecolor=GREY))
    draw_followed(through, rows, radius, 16)
    through.set(xlim=(-46, 46), ylim=(-18, 23))
    through.legend(loc="lower left")
    style(through, "x (mm)", "y (mm)", "Straight through an obstacle")

    walls = [wall((-0.012, 0.02), (-0.012, 0)), wall((-0.012, 0), (0.012, 0)), wall((0.012, 0), (0.012, 0.02))]
    points = straight((0, 0.028), (0, 0.012), (0.024, 0.006), (0.026, -0.006), (0.028, 0.028), speed=0.1)
    rows = bench.trace(bench.obj(walls), points, "--radius", radius)
    pocket.plot([-12, -12, 12, 12], [20, 0, 0, 20], color=GREY, lw=2.5)
    draw_followed(pocket, rows, radius, 18)
    pocket.set(xlim=(-15, 31), ylim=(-11, 30))
    style(pocket, "x (mm)", "y (mm)", "Through the wall of a pocket")
    save(figure, "paper_1_proxy.png")


STIFFNESS = 1000      # N/m, of both methods
RADIUS = 1e-4         # m, of the proxy: nearly a point, as the penalty method's finger is
THICKNESS = 0.002     # of the plate
SIDE = 0.03           # of the cubes


def penalty_plate(x, y):
    """Out by the nearest side of the plate."""
    if not -THICKNESS < y < 0:
        return (0.0, 0.0)
    return (0.0, STIFFNESS * -y) if -y < THICKNESS / 2 else (0.0, -STIFFNESS * (y + THICKNESS))


def penalty_cubes(x, y):
    """Two cubes side by side, each pushes out by its own nearest face."""
    force = [0.0, 0.0]
    for low, high in ((-SIDE, 0.0), (0.0, SIDE)):
        if low < x < high and -SIDE < y < 0:
            depth, axis, sign = min((-y, 1, 1), (x - low, 0, -1), (high - x, 0, 1), (y + SIDE, 1, -1))
            force[axis] += sign * STIFFNESS * depth
    return tuple(force)


def draw_force(axes, x_mm, y_mm, force, colour):
    """From the finger, 1 mm for 1 N; a ring where there is no force."""
    if max(abs(force[0]), abs(force[1])) < 0.01:
        axes.plot(x_mm, y_mm, "o", mfc="white", mec=colour, ms=8, zorder=3)
    else:
        draw_arrow(axes, (x_mm, y_mm), (x_mm + force[0], y_mm + force[1]), colour, arrowstyle="-|>", mutation_scale=9)


def sketch(axes, rows, law, shift_mm=0.25):
    """Fingers with both forces; the penalty's are drawn a little to the right of the proxy's."""
    for row in rows:
        x, y = MM * row["finger_x"], MM * row["finger_y"]
        axes.plot(x, y, "o", color="black", ms=3.5, zorder=5)
        draw_force(axes, x, y, (row["force_x"], row["force_y"]), BLUE)
        draw_force(axes, x + shift_mm, y, law(row["finger_x"], row["finger_y"]), RED)
    axes.set(aspect="equal", xlim=(-7.5, 7.5), ylim=(-5.6, 1.6), xticks=(-5, 0, 5), yticks=(-4, -2, 0))


def press(bench, scene, x, depth):
    return bench.trace(scene, straight((x, 0.002), (x, -depth), speed=0.02), "--radius", RADIUS)


def draw_forces(axes, way, rows, law, sideways=True):
    forces = [law(row["finger_x"], row["finger_y"]) for row in rows]
    axes.plot(way, column(rows, "force_y"), color=BLUE, lw=2.4, label="proxy, up")
    axes.plot(way, [f[1] for f in forces], color=RED, lw=1.5, label="penalty, up")
    if sideways:
        axes.plot(way, column(rows, "force_x"), color=BLUE, lw=1.4, ls="--", label="proxy, sideways")
        axes.plot(way, [f[0] for f in forces], color=RED, lw=1.4, ls="--", label="penalty, sideways")


def draw_plate(bench, picture, forces):
    scene = bench.obj([wall((-0.03, 0), (0.03, 0)), wall((-0.03, -THICKNESS), (0.03, -THICKNESS))])
    picture.add_patch(Rectangle((-8, -MM * THICKNESS), 16, MM * THICKNESS, facecolor=SOLID, edgecolor=GREY))
    sketch(picture, [press(bench, scene, x, d)[-1] for x, d in ((-0.005, 0.0008), (0, 0.0014), (0.005, 0.004))], penalty_plate)
    rows = press(bench, scene, 0, 0.008)
    draw_forces(forces, [-MM * row["finger_y"] for row in rows], rows, penalty_plate, sideways=False)
    forces.axvspan(0, MM * THICKNESS, color=SOLID)
    forces.legend(loc="upper left", framealpha=0)
    style(picture, "x (mm)", "y (mm)", "A plate of 2 mm")
    style(forces, "depth of the finger (mm)", "force (N)")


def draw_cubes(axes):
    for left in (-SIDE, 0):
        axes.add_patch(Rectangle((MM * left, -MM * SIDE), MM * SIDE, MM * SIDE, facecolor=SOLID, edgecolor=GREY))


def penalty(bench):
    """Figure 2: a thin plate, the joint of two cubes pressed, and dragged over."""
    figure, ((plate, joint, drag), (of_plate, of_joint, of_drag)) = canvas(2, 3, 5.6, gridspec_kw={"height_ratios": [1, 1.7]})
    draw_plate(bench, plate, of_plate)
    scene = bench.obj(loop([(-SIDE, -SIDE), (0, -SIDE), (0, 0), (-SIDE, 0)]) + loop([(0, -SIDE), (SIDE, -SIDE), (SIDE, 0), (0, 0)]))
    draw_cubes(joint)
    rows = press(bench, scene, -0.001, 0.005)
    sketch(joint, [rows[-1], press(bench, scene, -0.001, 0.0007)[-1]], penalty_cubes)
    draw_forces(of_joint, [-MM * row["finger_y"] for row in rows], rows, penalty_cubes)
    of_joint.legend(loc="upper left")
    style(joint, "x (mm)", "", "Pressed 1 mm beside a joint")
    style(of_joint, "depth of the finger (mm)", "")

    draw_cubes(drag)
    points = straight((-0.008, 0.001), (-0.008, -0.004), (0.008, -0.004), speed=0.02)
    rows = [row for row in bench.trace(scene, points, "--radius", RADIUS) if row["finger_y"] < -0.003999]
    sketch(drag, [min(rows, key=lambda row: abs(row["finger_x"] - x)) for x in (-0.006, -0.0025, 0.0025, 0.006)], penalty_cubes)
    draw_forces(of_drag, column(rows, "finger_x", MM), rows, penalty_cubes)
    style(drag, "x (mm)", "", "Dragged over it, 4 mm deep")
    style(of_drag, "finger along the cubes (mm)", "")
    save(figure, "paper_2_penalty.png",
         f"proxy over the joint: {min(column(rows, 'force_y')):.4f} to {max(column(rows, 'force_y')):.4f} N up, "
         f"at most {max(abs(v) for v in column(rows, 'force_x')):.1e} N sideways")
