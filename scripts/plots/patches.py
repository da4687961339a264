"""Patches: a ball on its way down a vase, a surface of revolution, and the direction of its force."""
import math

from plots.look import BLUE, GREEN, GREY, MM, RED, ROOT, canvas, column, draw_way, save, style

RADIUS = 0.002
SCENE = ROOT / "scenes" / "examples" / "patches.hl.json"
PROFILE = [(12, 0), (22, 5), (26, 18), (8, 28), (9, 42), (16, 48)]  # control points of the vase, mm
KNOTS = [0, 0, 0, 0, 1, 2, 3, 3, 3, 3]


def profile(t):
    """A point of the profile, mm, by de Boor's algorithm."""
    span = min(5, 3 + int(t))
    points = [PROFILE[span - 3 + r] for r in range(4)]
    for s in range(1, 4):
        for r in range(3, s - 1, -1):
            low, high = KNOTS[span - 3 + r], KNOTS[span + r + 1 - s]
            part = (t - low) / (high - low)
            points[r] = tuple((1 - part) * a + part * b for a, b in zip(points[r - 1], points[r]))
    return points[3]


def inside(t, depth):
    """The place at this depth beneath the surface, m, on its right side."""
    (ax, ay), (bx, by) = profile(max(0, t - 1e-4)), profile(min(3, t + 1e-4))
    x, y = profile(t)
    length = math.hypot(bx - ax, by - ay)
    return ((x - depth * (by - ay) / length) / MM, (y + depth * (bx - ax) / length) / MM, 0)


def down_a_vase(bench):
    """A finger 3 mm beneath the surface of a vase, from its rim to its foot."""
    path = [inside(2.9 - 2.7 * i / 1500, 3 - 10 * max(0, 1 - i / 100)) for i in range(1501)]
    figure, (picture, force) = canvas(1, 2, 4.6)
    outline = [profile(3 * i / 300) for i in range(301)]
    picture.fill_betweenx([y for _, y in outline], [-x for x, _ in outline], [x for x, _ in outline], color=GREY, alpha=0.3, lw=0)
    picture.plot(*zip(*PROFILE), color=GREEN, lw=0.8, marker="o", ms=3, label="control points of the profile")
    rows = bench.trace(SCENE, path, "--radius", str(RADIUS), "--shade", "smooth")
    draw_way(picture, rows, "proxy", color=BLUE, lw=1.8, label="proxy, radius 2 mm")
    draw_way(picture, rows, "finger", color=RED, lw=1.2, label="finger")
    touching = [i for i, row in enumerate(rows) if row["contacts"] > 0]
    angle = [math.degrees(math.atan2(y, x)) for x, y in zip(column(rows, "force_x"), column(rows, "force_y"))]
    force.plot([i / 1000 for i in touching], [angle[i] for i in touching], color=BLUE, lw=1.8)
    picture.set_ylim(-2, 62)
    picture.set_aspect("equal")
    picture.legend(loc="upper left", framealpha=0)
    style(picture, "x (mm)", "y (mm)", "A NURBS surface of 54 control points")
    style(force, "time (s)", "angle of the force (degrees)", "It turns as the surface does")
    save(figure, "patches.png", f"force out of the plane at most {max(abs(row['force_z']) for row in rows):.1e} N")
