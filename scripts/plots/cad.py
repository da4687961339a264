"""CAD files: a ball on its way over a part, and the direction of its force."""
import math

from plots.look import BLUE, GREY, MM, RED, ROOT, canvas, column, draw_way, save, style

RADIUS = 0.0015
PART = ROOT / "scenes" / "examples" / "flange.step"
# Of the finger, mm.
CORNERS = [(-29, 7.2), (-26.2, 7.2), (-24.5, 5), (-22, 4.2), (-19.5, 5), (-17.8, 7.2), (-14.6, 7.2), (-12.3, 8.3),
           (-11.2, 10.5), (-11.2, 19)]


def outline():
    """Of the part in the plane of the picture, mm: (x, height) from the left end to the bore."""
    hollow = [(-22 + 5 * math.sin(a), 10 - 5 * math.cos(a)) for a in [math.acos(0.4) * (i / 30 - 1) for i in range(61)]]
    fillet = [(-15 + 3 * math.sin(a), 11 - 3 * math.cos(a)) for a in [math.pi / 2 * i / 30 for i in range(31)]]
    return [(-30, 0), (-30, 8), *hollow, *fillet, (-12, 20), (-7, 20), (-7, 0)]


def finger_path(step=5e-5):
    points = []
    for (ax, az), (bx, bz) in zip(CORNERS, CORNERS[1:]):
        count = max(1, round(math.hypot(bx - ax, bz - az) / MM / step))
        points += [((ax + (bx - ax) * i / count) / MM, (az + (bz - az) * i / count) / MM, 0) for i in range(count)]
    above = [(points[0][0], 0.012 + (points[0][1] - 0.012) * i / 200, 0) for i in range(200)]
    return above + points


def over_a_flange(bench):
    """A finger some 1 mm beneath the surface of a part: hollow, fillet, edges."""
    scene = bench.scene([{"name": "flange", "file": str(PART), "transform": {"axis": {"x": 1}, "degrees": -90}}])
    rows = bench.trace(scene, finger_path(), "--radius", str(RADIUS), "--shade", "smooth")
    figure, (picture, force) = canvas(1, 2, 4.6)
    picture.fill(*zip(*outline()), color=GREY, alpha=0.3, lw=0)
    draw_way(picture, rows, "proxy", color=BLUE, lw=1.8, label="proxy, radius 1.5 mm")
    draw_way(picture, rows, "finger", color=RED, lw=1.2, label="finger")
    picture.set_ylim(0, 30)
    picture.legend(loc="upper left", framealpha=0)
    style(picture, "x (mm)", "height (mm)", "A section of a part from a STEP file")
    angle = [math.degrees(math.atan2(y, -x)) for x, y in zip(column(rows, "force_x"), column(rows, "force_y"))]
    touching = [i for i, row in enumerate(rows) if row["contacts"] > 0]
    force.plot([i / 1000 for i in touching], [angle[i] for i in touching], color=BLUE, lw=1.8)
    style(force, "time (s)", "angle of the force (degrees)", "Curved faces turn it smoothly, edges do not")
    worst = max(abs(row["force_z"]) for row in rows)
    save(figure, "cad.png", f"force out of the plane at most {worst:.1e} N")
