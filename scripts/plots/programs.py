"""Pictures beyond the paper's figures: a trace around the teapot, and the time of a tick."""
import csv
import math

from plots.bench import RATE_HZ
from plots.look import BLUE, BROWN, GREEN, GREY, MM, ORANGE, PINK, PURPLE, RED, canvas, column, save, style

TEAPOT_SIDE_M = 0.1   # the teapot's largest side: a small real one
SPEED_M_S = 0.1       # a calm stroking hand
STIFFNESS_N_M = 1000
CENTRE_Y_M = -0.005       # of the finger's half ellipse, where the body is widest
ARC_M = (0.027, 0.0175)   # its half axes along z and y: a few millimetres inside the body
START_M = 0.055           # the finger comes from and leaves to this distance from the axis


def teapot_path():
    """In from the side, inside the body down and under the bottom to the other side, and out, in the plane x = 0."""
    across, down = ARC_M
    corners = [(START_M, CENTRE_Y_M)]
    corners += [(across * math.cos(a), CENTRE_Y_M - down * math.sin(a)) for a in (math.pi * i / 720 for i in range(721))]
    corners.append((-START_M, CENTRE_Y_M))
    step = SPEED_M_S / RATE_HZ
    points, left = [corners[0]], 0.0
    for (z0, y0), (z1, y1) in zip(corners, corners[1:]):
        length = math.hypot(z1 - z0, y1 - y0)
        at = step - left
        while at <= length:
            points.append((z0 + (z1 - z0) * at / length, y0 + (y1 - y0) * at / length))
            at += step
        left = length - (at - step)
    return [(0.0, y, z) for z, y in points]


def trace(bench):
    """Finger, proxy and force across the teapot's body."""
    rows = bench.trace("teapot", teapot_path(), "--fit", TEAPOT_SIDE_M, "--kp", STIFFNESS_N_M)
    figure, (section, force) = canvas(2, 1, 8, gridspec_kw={"height_ratios": [1, 1.5]})
    for row in rows[::15]:
        section.plot([row["finger_z"] * MM, row["proxy_z"] * MM], [row["finger_y"] * MM, row["proxy_y"] * MM], color=GREY, lw=0.6)
    section.plot(column(rows, "finger_z", MM), column(rows, "finger_y", MM), color=RED, lw=1.5, label="finger")
    section.plot(column(rows, "proxy_z", MM), column(rows, "proxy_y", MM), color=BLUE, lw=2, label="proxy")
    section.set_aspect("equal")
    section.legend(loc="upper center")
    style(section, "z (mm)", "y (mm)", "Teapot, section across the body")

    names = ("force_x", "force_y", "force_z")
    for name, colour in zip(names, (GREY, GREEN, ORANGE)):
        force.plot(column(rows, "t"), column(rows, name), lw=1.2, color=colour, label=name.replace("_", " "))
    force.plot(column(rows, "t"), [math.hypot(*(row[name] for name in names)) for row in rows], lw=2, color="black", label="magnitude")
    force.legend(loc="lower left", ncols=2)
    style(force, "time (s)", "force (N)", f"Force at K = {STIFFNESS_N_M} N/m, finger at {SPEED_M_S} m/s")
    save(figure, "trace.png")


HIERARCHIES = (("none", GREY, "every primitive tested"), ("spheres", BLUE, "sphere tree"), ("bvh", GREEN, "wide BVH"))
PEERS = (("embree", ORANGE, "Embree"), ("cgal", PURPLE, "CGAL"), ("fcl", BROWN, "FCL"), ("bullet", PINK, "Bullet"))
QUESTIONS = (("near", "-.", "closest point within 1.01 r"), ("nearest", "--", "closest point"),
             ("finger", "-", "closest point to the finger"), ("impact", "--", "swept sphere"))
LEGEND = 0.16             # of the picture's height
RADII = {"fixed": "r = {:g} mm", "scaled": "r = {:.2g} mean edges",
         "zoomed": "r and motion scaled"}


def draw_line(axes, rows, key, *line, **options):
    if rows:
        axes.plot([float(row["primitives"]) for row in rows], [float(row[key]) for row in rows], *line, marker="o", ms=4, lw=1.8, **options)


def draw_tick_times(axes, rows):
    """HL's whole ticks, and one query of each peer on the same places."""
    for hierarchy, colour, name in HIERARCHIES:
        chosen = [row for row in rows if row["question"] == "tick" and row["hierarchy"] == hierarchy]
        draw_line(axes, chosen, "p999_us", ":", color=colour, label=f"{name}, p99.9")
        draw_line(axes, chosen, "p50_us", "-", color=colour, label=f"{name}, median")
    for who, colour, name in PEERS:
        for question, line, text in QUESTIONS:
            chosen = [row for row in rows if (row["who"], row["question"]) == (who, question)]
            draw_line(axes, chosen, "p50_us", line, color=colour, label=f"{name}, {text}, median")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.axhline(1000, color=RED, lw=1)
    axes.annotate("1 kHz: a tick every 1000 µs", (0.62, 1000), xycoords=("axes fraction", "data"), xytext=(0, 4),
                  textcoords="offset points", ha="center", color=RED)


def radius_text(rows):
    row = rows[0]
    measure = 1e3 * float(row["radius_m"]) if row["radius"] == "fixed" else float(row["radius_m"]) / float(row["mean_edge_m"])
    return RADII[row["radius"]].format(measure)


def tick_times(file):
    """The tick against the number of triangles, on logarithmic axes, one panel for each kind of radius that was measured."""
    with file.open() as source:
        rows = [row for row in csv.DictReader(source)
                if row["scene"] == "terrain" and row["motion"] == "sliding" and row["surface"] in ("plain", "")]
    panels = [chosen for chosen in ([row for row in rows if row["radius"] == radius] for radius in RADII) if chosen]
    figure, all_axes = canvas(1, len(panels), 6.4, sharey=True, squeeze=False)
    for axes, chosen in zip(all_axes[0], panels):
        draw_tick_times(axes, chosen)
        style(axes, "triangles", "time (µs)" if axes is all_axes[0][0] else "", f"Terrain, {radius_text(chosen)}")
    handles, labels = all_axes[0][0].get_legend_handles_labels()
    figure.get_layout_engine().set(rect=(0, LEGEND, 1, 1 - LEGEND))
    figure.legend(handles, labels, loc="lower center", ncols=3)
    save(figure, "bench.png")
