"""Figure 7 of the paper, softness; friction and textures."""
import math

from matplotlib.patches import Circle, Polygon

from plots.bench import RATE_HZ, straight, wall
from plots.look import BLUE, GREEN, GREY, MM, ORANGE, RED, SOLID, canvas, column, draw_way, save, style

MU_S, MU_D = 0.6, 0.4
STIFFNESS = 1800      # N/m
DEPTH = 0.001         # m: 1.8 N
RADIUS = 0.001
FRICTION = ("--radius", RADIUS, "--kp", STIFFNESS, "--static-friction", MU_S, "--dynamic-friction", MU_D)


def floor_file(bench):
    return bench.obj([wall((-0.1, 0.0), (0.1, 0.0))])


def softness(bench):
    """Figure 7: a soft surface lets the finger in; the proxy stays on it and the target goes between."""
    figure, (picture, force) = canvas(1, 2, 4.2)
    scene, largest = floor_file(bench), []
    points = straight((-0.01, 0.004), (0.01, -0.006), speed=0.1)
    picture.axhspan(-7, 0, color=SOLID)
    for s, colour in ((1.0, BLUE), (0.5, GREEN), (0.2, ORANGE)):
        rows = bench.trace(scene, points, "--radius", RADIUS, "--stiffness", s)
        draw_way(picture, rows, "target", color=colour, lw=2.4 if s == 1 else 1.8, label=f"target, s = {s:g}")
        force.plot([MM * (RADIUS - row["finger_y"]) for row in rows], column(rows, "force_y"), color=colour, lw=2, label=f"s = {s:g}")
        largest.append(f"s = {s:g}: {rows[-1]['force_y']:.4f} N")
    draw_way(picture, rows, "proxy", color="black", lw=1.2, ls="--", label="proxy, for every s")
    draw_way(picture, rows, "finger", color=RED, lw=1.8, label="finger")
    picture.set_ylim(-7, 5)
    picture.legend(loc="lower left", framealpha=0)
    style(picture, "x (mm)", "y (mm)", "Softness moves the target, not the proxy")
    force.legend()
    style(force, "finger below the proxy (mm)", "force (N)", "Force at K = 1000 N/m")
    save(figure, "paper_7_softness.png", ", ".join(largest) + " at 7 mm")


def pull_angle(row):
    """Of the pull on the proxy against the floor's normal, in degrees; positive where the finger is ahead."""
    return math.degrees(math.atan2(row["finger_x"] - row["proxy_x"], row["proxy_y"] - row["finger_y"]))


def pull_before(rows, i):
    """The same in row i, seen from where the proxy was a tick before."""
    return pull_angle({**rows[i], "proxy_x": rows[i - 1]["proxy_x"]})


def draw_moment(axes, row, mu, colour, name):
    """The proxy, the finger, and the cone of friction about the normal."""
    x, y, reach = MM * row["proxy_x"], MM * row["proxy_y"], 1.3
    axes.add_patch(Polygon([(x, y), (x - reach * mu, y - reach), (x + reach * mu, y - reach)], closed=True, facecolor=colour, alpha=0.25))
    axes.add_patch(Circle((x, y), MM * RADIUS, fill=False, color=BLUE, lw=1))
    axes.plot([x, MM * row["finger_x"]], [y, MM * row["finger_y"]], color="black", lw=1.2)
    axes.plot(x, y, "o", color=BLUE, ms=5)
    axes.plot(MM * row["finger_x"], MM * row["finger_y"], "o", color=RED, ms=5)
    axes.annotate(name, (x, y + 1.1), ha="center", va="bottom")


def stick_slip_points(y, speed):
    """In, 5 mm along the floor, a rest of 0.1 s, and 3 mm back."""
    points = straight((0, 0.003), (0, y), speed=0.1) + straight((0, y), (0.005, y), speed=speed)[1:]
    return points + [points[-1]] * 100 + straight((0.005, y), (0.002, y), speed=speed)[1:]


def draw_angles(axes, rows):
    axes.plot(column(rows, "t"), [pull_angle(row) for row in rows], color="black", lw=1.8)
    for mu, colour, name in ((MU_S, GREEN, "μ_s"), (MU_D, ORANGE, "μ_d")):
        angle = math.degrees(math.atan(mu))
        axes.axhline(angle, color=colour, lw=1.2, ls="--", label=f"±atan {name} = ±{angle:.2f}°")
        axes.axhline(-angle, color=colour, lw=1.2, ls="--")
    axes.legend(loc="center", bbox_to_anchor=(0.38, 0.42))
    style(axes, "time (s)", "pull (degrees)", "Angle of the pull against the normal")


def friction_cone(bench):
    """The finger goes out of the friction cone, rests, and comes back through it."""
    y = RADIUS - DEPTH
    rows = bench.trace(floor_file(bench), stick_slip_points(y, 0.02), *FRICTION)
    rows = [row for row in rows if row["finger_y"] < y + 1e-9]
    slip = next(i for i, row in enumerate(rows) if row["proxy_x"] > 1e-9)
    back = next(i for i in range(slip, len(rows)) if rows[i]["proxy_x"] < rows[i - 1]["proxy_x"] - 1e-9)
    stuck, sliding = rows[slip - 1], rows[slip + 80]

    figure, axes = canvas(2, 2, 4.8, gridspec_kw={"width_ratios": [1.35, 1]})
    grid = axes[0][0].get_gridspec()
    for unused in axes[:, 0]:
        unused.remove()
    picture, ways, angles = figure.add_subplot(grid[:, 0]), axes[0][1], axes[1][1]
    picture.axhspan(-0.7, 0, color=SOLID)
    picture.axhline(0, color=GREY)
    draw_moment(picture, stuck, MU_S, GREEN, f"μ_s = 0.6\nholds up to {pull_angle(stuck):.2f}°")
    draw_moment(picture, sliding, MU_D, ORANGE, f"μ_d = 0.4\nslides at {pull_angle(sliding):.2f}°")
    picture.set(aspect="equal", xlim=(-1.5, 3.6), ylim=(-0.7, 2.7))
    style(picture, "x (mm)", "y (mm)", "Finger (red), proxy (blue) and friction cones")
    ways.plot(column(rows, "t"), column(rows, "finger_x", MM), color=RED, lw=1.8, label="finger")
    ways.plot(column(rows, "t"), column(rows, "proxy_x", MM), color=BLUE, lw=1.8, label="proxy")
    ways.legend(loc="lower center")
    style(ways, "", "x (mm)", "Stick, slide, stick, slide back")
    draw_angles(angles, rows)
    save(figure, "paper_friction_cone.png",
         f"stuck at {pull_angle(stuck):.3f} degrees, slips when the finger is at {pull_before(rows, slip):.3f}; "
         f"atan mu_s = {math.degrees(math.atan(MU_S)):.3f}",
         f"slides at {pull_angle(sliding):.3f}; atan mu_d = {math.degrees(math.atan(MU_D)):.3f}; "
         f"back: stuck at {pull_angle(rows[back - 1]):.3f}, slips at {pull_before(rows, back):.3f}")


def word_for_word(rows):
    """Drag under the paper's rules taken literally at b = 0, for the same finger: stuck inside the static cone, else the
    velocity of equation (3), which is not limited, so that the proxy goes to where the finger is."""
    at, drags = rows[0]["finger_x"], []
    for row in rows:
        if abs(row["finger_x"] - at) > MU_S * DEPTH:
            at = row["finger_x"]
        drags.append(STIFFNESS * (row["finger_x"] - at))
    return drags


def friction(bench):
    """Drag against displacement, 1.8 N pressed, at four speeds, without and with viscosity."""
    scene, start, y = floor_file(bench), -0.05, RADIUS - DEPTH
    figure, plots = canvas(1, 2, 4.8, sharey=True)
    facts = []

    def slide(speed, viscosity):
        points = [(start, 0.003, 0.0)] + straight((start, y), (start + 0.004, y), speed=speed)
        rows = bench.trace(scene, points, *FRICTION, "--viscosity", viscosity)[1:]
        return rows, [MM * (row["finger_x"] - start) for row in rows]

    for plot, viscosity in zip(plots, (0, 2)):
        for speed, colour in ((0.01, BLUE), (0.05, GREEN), (0.1, ORANGE), (0.2, RED)):
            rows, way = slide(speed, viscosity)
            drag, expected = [-row["force_x"] for row in rows], MU_D * STIFFNESS * DEPTH + viscosity * speed
            plot.axhline(expected, color=colour, lw=1, ls=":")
            plot.plot(way, drag, color=colour, lw=1.8, label=f"{speed:g} m/s → {drag[-1]:.3f} N")
            facts.append(f"b = {viscosity}, {speed:g} m/s: {drag[-1]:.5f} N, expected {expected:.5f}, peak {max(drag):.3f}")
        style(plot, "finger's displacement (mm)", "drag (N)", f"b = {viscosity} N s/m; dotted: μ_d f_n + b u")
    rows, way = slide(0.05, 0)
    literal = word_for_word(rows)
    plots[0].plot(way, literal, color=GREY, lw=0.8, zorder=1, label="equation (3) word for\nword, 0.05 m/s (computed)")
    facts.append(f"word for word, 0.05 m/s: from {min(literal[20:]):.3f} to {max(literal):.3f} N, mean {sum(literal) / len(literal):.3f} N")
    for plot in plots:
        plot.set_ylim(-0.42, 1.2)
        plot.legend(loc="lower right", ncols=2)
    plots[1].set_ylabel("")
    save(figure, "paper_friction.png", *facts)


def textured_floor(repeat, texture):
    """0.2 m along x, where u goes from 0 to 1."""
    return {"primitives": {"vertices": [v for corner in wall((-0.1, 0.0), (0.1, 0.0)) for v in corner],
                           "texcoords": [0, 0, 1, 0, 1, 1, 0, 1], "polygons": [{"vertices": [0, 1, 2, 3]}]},
            "material": {"repeatU": repeat, "repeatV": repeat, "textures": [texture]}}


def lines_felt(rows):
    """How often the drag rises from nothing."""
    return sum(1 for a, b in zip(rows, rows[1:]) if a["force_x"] > -1e-6 >= b["force_x"])


def texture(bench):
    """Lines of friction 0.1 mm wide and 5 mm apart, at three speeds: none is missed."""
    image = {"name": "lines", "procedural": {"kind": "lines", "size": 50, "duty": 0.02}}
    feels = {"texture": "lines", "quantity": "DYNAMIC_FRICTION", "low": 0, "high": 0.5}
    scene, y, start = bench.scene([textured_floor(40, feels)], [image]), -0.001, -0.0486
    figure, plots = canvas(3, 1, 5.4, sharex=True, sharey=True)
    facts = []
    for plot, (speed, colour) in zip(plots, ((0.02, BLUE), (0.2, GREEN), (0.5, RED))):
        points = [(start, 0.003, 0.0)] + straight((start, y), (-0.018, y), speed=speed)
        rows = bench.trace(scene, points, "--radius", RADIUS)[1:]
        for i in range(6):
            plot.axvline(-45 + 5 * i + 0.05, color=ORANGE, lw=1, alpha=0.7, label=None if i else "lines, 0.1 mm wide")
        drag = [-row["force_x"] for row in rows]
        plot.plot(column(rows, "finger_x", MM), drag, color=colour, lw=1.8, label=f"{speed:g} m/s, {speed / RATE_HZ * MM:g} mm a tick")
        plot.set_ylim(-0.1, 1.7)
        plot.legend(loc="upper right", ncols=2, framealpha=1)
        style(plot, "", "drag (N)")
        facts.append(f"{speed:g} m/s: {lines_felt(rows)} of 6 lines, strongest {max(drag):.3f} N")
    plots[0].set_title("Lines of friction μ_d = 0.5, pressed with 2 N")
    plots[-1].set_xlabel("finger along the floor (mm)")
    save(figure, "paper_texture.png", *facts)


def snap(bench):
    """Force against the finger's place beside a point that takes it from 1 mm and lets go at 2 N: in, through, and out."""
    release = 2.0
    scene = bench.scene([{"primitives": {"vertices": [0, 0.05, 0], "points": [0]},
                          "snaps": [{"points": [0, 0, 0], "capture": 0.001, "releaseN": release}]}])
    rows = bench.trace(scene, straight((-3e-3, 0.0), (3e-3, 0.0), speed=0.01), "--radius", str(RADIUS))
    place = [MM * row["finger_x"] for row in rows]
    force = [row["force_x"] for row in rows]
    figure, plot = canvas(1, 1, 4.0)
    for most in (-release, release):
        plot.axhline(most, color=GREY, lw=1, ls=":")
    plot.plot(place, force, color=BLUE, lw=1.8)
    style(plot, "finger's place, from left to right (mm)", "force on the finger (N)",
          "A point that takes the finger from 1 mm and lets go at 2 N, K = 1000 N/m")
    pulled = min(force)
    save(figure, "snap.png", f"taken with {max(force):.4f} N; let go after {-pulled:.4f} N at {place[force.index(pulled)]:.4f} mm")


def piercing(bench):
    """Force against the needle's depth: through skin of 1.5 N into tissue that holds back, and out again."""
    values = [5.5 - i for _ in range(2) for i in range(12) for _ in range(2)]  # matter below y = 0
    matter = [{"value": -0.001}, {"value": 0, "resistanceN": 0.2, "dragNsM": 20}]
    volume = {"size": [2, 12, 2], "spacing": [0.05, 0.002, 0.05], "iso": 0, "values": values, "matter": matter}
    scene = bench.scene([{"name": "tissue", "volume": volume, "material": {"strengthN": 1.5}}])
    top, bottom = (0.0, 0.005), (0.0, -0.010)
    rows = bench.trace(scene, straight(top, bottom, speed=0.02) + straight(bottom, top, speed=0.02))
    depth = [-MM * row["finger_y"] for row in rows]
    force = [row["force_y"] for row in rows]
    figure, plot = canvas(1, 1, 4.0)
    plot.plot(depth, force, color=BLUE, lw=1.8)
    style(plot, "depth of the needle (mm)", "force on it (N)", "Through a surface of 1.5 N, then 0.2 N + 20 N s/m at 20 mm/s; K = 1000 N/m")
    save(figure, "piercing.png", f"pierced at {max(force):.4f} N; out again at {min(force):.4f} N")


def adhesion(bench):
    """Force against the finger's height over a floor of adhesion 1 N: down, 0.5 mm in, and up until it lets go."""
    scene, most = floor_file(bench), 1.0
    down, up = (0.0, RADIUS + 1.5e-3), (0.0, RADIUS - 0.5e-3)
    rows = bench.trace(scene, straight(down, up, speed=0.01) + straight(up, (0.0, RADIUS + 2e-3), speed=0.01),
                       "--adhesion", str(most))
    height = [MM * (row["finger_y"] - RADIUS) for row in rows]
    force = [row["force_y"] for row in rows]
    figure, plot = canvas(1, 1, 4.0)
    plot.axhline(-most, color=GREY, lw=1, ls=":")
    plot.plot(height, force, color=BLUE, lw=1.8)
    style(plot, "finger's height above contact (mm)", "force on the finger (N)", "Adhesion of 1 N, K = 1000 N/m: down and up again")
    pulled = min(force)
    save(figure, "adhesion.png", f"strongest pull {-pulled:.4f} N at {height[force.index(pulled)]:.4f} mm; adhesion {most:g} N")
