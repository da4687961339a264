"""Figures 5 and 6 of the paper, force shading, and the energy that it adds."""
import math

from matplotlib.patches import Circle, Polygon, Rectangle

from plots.bench import around, corners_of, prism, straight
from plots.look import (BLUE, GREEN, GREY, MM, ORANGE, RED, SOLID, canvas, column, draw_arrow, draw_springs, draw_way,
                        save, style)

SIDES = 10
SIZE = 0.05           # m, circumradius of the prism
RHO = 0.9 * SIZE      # of the finger's circle
RADIUS = 0.05 * SIZE  # of the proxy
ALPHA = math.pi / SIDES
INNER = SIZE * math.cos(ALPHA)
JUMP = math.asin(SIZE * math.sin(ALPHA) / RHO)  # past the middle of a face, where the flat prism lets go
SPEED = 0.1           # m/s


def leaning_floor(beta):
    """A floor whose vertex normals lean by beta."""
    lean = (math.sin(beta), math.cos(beta), 0.0)
    return [[(x, 0.0, z, lean) for x, z in ((-0.05, 0.05), (0.05, 0.05), (0.05, -0.05), (-0.05, -0.05))]]


def after_pass_1(at, finger, beta, radius):
    """Computed from the algorithm: the finger projected on the shaded plane through the proxy at `at`."""
    lean = (math.sin(beta), math.cos(beta))
    height = lean[0] * (at - finger[0]) + lean[1] * (radius - finger[1])
    return finger[0] + lean[0] * height, finger[1] + lean[1] * height


def draw_passes(axes, rows, finger, beta, radius, goal):
    axes.add_patch(Rectangle((-3, -4), 8, 4, facecolor=SOLID))
    axes.axhline(0, color=GREY)
    axes.plot(MM * finger[0], MM * finger[1], "o", color=RED, ms=7, label="finger")
    axes.plot([MM * finger[0], MM * goal], [MM * finger[1], MM * radius], color=GREEN, lw=1.4,
              label="fixed point: the finger is\nalong the shaded normal")
    at, y = 0.0, MM * radius
    for row in rows[:2]:
        axes.add_patch(Circle((MM * at, y), y, fill=False, color=BLUE, lw=0.9))
        first = tuple(MM * p for p in after_pass_1(at, finger, beta, radius))
        draw_arrow(axes, (MM * at, y), first, ORANGE, arrowstyle="->")
        draw_arrow(axes, first, (MM * row["proxy_x"], MM * row["proxy_y"]), BLUE, arrowstyle="->")
        at = row["proxy_x"]
    axes.plot([], [], color=ORANGE, lw=1.8, label="pass 1, on the shaded plane\n(computed)")
    axes.plot([], [], color=BLUE, lw=1.8, label="pass 2, on the true plane")
    axes.plot([0, *column(rows, "proxy_x", MM)], [y, *column(rows, "proxy_y", MM)], "o", color=BLUE, ms=5, label="proxy after each tick")
    for i, x in enumerate([0, *column(rows[:2], "proxy_x", MM)]):
        axes.annotate(f"{i}", (x, y), xytext=(0, 6), textcoords="offset points", ha="center", color=BLUE)
    axes.set(aspect="equal", xlim=(-1.3, 4.6), ylim=(-2.7, 2.2))


def passes(bench):
    """Figure 5: the two passes on a plane whose normals lean, once a tick: each leaves sin^2(beta) of the error."""
    beta, depth, radius = math.radians(25), 0.003, 0.001
    finger = (0.0, radius - depth)
    points = [(0.0, 0.003, 0.0)] + [(*finger, 0.0)] * 7
    rows = bench.trace(bench.obj(leaning_floor(beta)), points, "--radius", radius, "--shade", "smooth",
                       "--shading-passes", "once", "--ledger", "report")[1:]
    goal = depth * math.tan(beta)
    errors = [goal] + [abs(goal - row["proxy_x"]) for row in rows]
    figure, (scene, error) = canvas(1, 2, 4.4, gridspec_kw={"width_ratios": [1.5, 1]})
    draw_passes(scene, rows, finger, beta, radius, goal)
    scene.legend(loc="lower right", framealpha=0)
    style(scene, "x (mm)", "y (mm)", "Two passes a tick, normals lean by 25°")
    ticks = range(len(errors))
    error.semilogy(ticks, [MM * e for e in errors], "o", color=BLUE, label="measured")
    error.semilogy(ticks, [MM * goal * math.sin(beta) ** (2 * i) for i in ticks], color=GREEN, label="sin²β = 0.179 each tick")
    error.legend()
    style(error, "ticks", "distance to the fixed point (mm)", "How fast it converges")
    save(figure, "paper_5_passes.png", f"first ratio {errors[1] / errors[0]:.6f}, sin^2 beta {math.sin(beta) ** 2:.6f}, "
         f"offset {MM * goal:.4f} mm")


def angle_of(row):
    return math.atan2(row["finger_y"], row["finger_x"])


def off_radial(row):
    """Direction of the force less the finger's own, in degrees."""
    return math.degrees(math.remainder(math.atan2(row["force_y"], row["force_x"]) - angle_of(row), 2 * math.pi))


def flat_form(theta):
    """Closed form of the flat ten-gon, a finger that comes from theta = 0: along the normal of the face held."""
    face = 2 * ALPHA * max(0, math.ceil((theta - JUMP) / (2 * ALPHA)))
    return math.degrees(face - theta)


def shaded_form(theta):
    """Closed form of the shaded ten-gon: off radial on a face, and the corner's normal on the arc about a corner."""
    delta = math.remainder(theta, 2 * ALPHA)
    if abs(delta) > ALPHA - math.asin(RADIUS * math.sin(ALPHA) / RHO):
        return math.degrees(math.copysign(ALPHA, delta) - delta)
    along = RHO * INNER * math.sin(delta) / (RHO * math.cos(delta) - RADIUS)
    return math.degrees(math.atan(along / INNER) - delta)


def draw_ten_gon(axes, rows, title):
    axes.add_patch(Polygon([(MM * x, MM * y) for x, y in corners_of(SIDES, SIZE)], closed=True, facecolor=SOLID, edgecolor=GREY))
    draw_springs(axes, rows[::24], color=BLUE, lw=0.9)
    draw_way(axes, rows, "finger", color=RED, lw=1.2, label="finger")
    draw_way(axes, rows, "proxy", color=BLUE, lw=1.6, label="proxy")
    axes.plot([], [], color=BLUE, lw=0.9, label="force, from finger to proxy")
    axes.set_aspect("equal")
    axes.legend(loc="center", framealpha=0)
    style(axes, "x (mm)", "y (mm)", title)


def forces_N(rows):
    return [math.hypot(row["force_x"], row["force_y"]) for row in rows]


def ten_gon_facts(flat, shaded, once):
    errors, degrees = [off_radial(row) for row in flat], [math.degrees(angle_of(row)) for row in flat]
    at = max(range(1, len(errors) // 8), key=lambda i: errors[i] - errors[i - 1])
    turn = errors[at] - errors[at - 1] + degrees[at] - degrees[at - 1]
    worst = max(abs(off_radial(row) - shaded_form(angle_of(row))) for row in shaded)
    late = max(abs(off_radial(a) - off_radial(b)) for a, b in list(zip(once, shaded))[30:])
    return (f"flat: the force turns by {turn:.4f} degrees between {degrees[at - 1]:.3f} and {degrees[at]:.3f}; "
            f"asin(R sin 18 / rho) = {math.degrees(JUMP):.3f}",
            f"shaded: at most {max(abs(off_radial(row)) for row in shaded):.3f} degrees off radial, "
            f"{worst:.1e} from the closed form; once a tick {late:.3f} from the converged",
            f"force flat {min(forces_N(flat)):.2f} to {max(forces_N(flat)):.2f} N, "
            f"shaded {min(forces_N(shaded)):.2f} to {max(forces_N(shaded)):.2f} N at 1000 N/m")


def draw_directions(axes, degrees, curves, forms):
    for rows, colour, name in curves:
        axes.plot(degrees, [off_radial(row) for row in rows[:len(degrees)]], color=colour, lw=2.2, label=name)
    for i, form in enumerate(forms):
        axes.plot(degrees, [form(math.radians(a)) for a in degrees], color="black", lw=1, ls="--", label=None if i else "closed form")


def ten_gon(bench):
    """Figure 6: a finger on a circle in a ten-sided prism, flat and shaded, with the closed forms."""
    scene = bench.obj(prism(SIDES, SIZE))
    lead = straight((0.06, 0), (RHO, 0), speed=SPEED)

    def feel(*options):
        rows = bench.trace(scene, lead + around(RHO, SPEED), "--radius", RADIUS, "--ledger", "report", *options)
        return rows[len(lead) - 1:]

    flat, shaded = feel("--shade", "flat"), feel("--shade", "smooth")
    once = feel("--shade", "smooth", "--shading-passes", "once")
    figure, ((of_flat, of_shaded), (both, close)) = canvas(2, 2, 8, gridspec_kw={"height_ratios": [1.7, 1]})
    draw_ten_gon(of_flat, flat, "6a: flat")
    draw_ten_gon(of_shaded, shaded, "6b: force shaded")

    degrees = [360 * i / (len(flat) - 1) for i in range(len(flat) // 4)]
    both.plot([math.degrees(JUMP)] * 2, [-24, 19], color=GREY, lw=1, ls=":", label=f"asin(R sin 18° / ρ) = {math.degrees(JUMP):.2f}°")
    draw_directions(both, degrees, [(flat, RED, "flat"), (shaded, BLUE, "shaded")], [flat_form, shaded_form])
    both.set_ylim(-24, 34)
    both.legend(ncols=2, loc="upper center")
    style(both, "finger's angle (degrees)", "off radial (degrees)", "Direction of the force")
    draw_directions(close, degrees, [(once, ORANGE, "once a tick"), (shaded, BLUE, "converged")], [shaded_form])
    close.set_ylim(-1.5, 2.2)
    close.legend(ncols=3, loc="upper center")
    style(close, "finger's angle (degrees)", "off radial (degrees)", "6b alone, enlarged")
    save(figure, "paper_6_ten_gon.png", *ten_gon_facts(flat, shaded, once))


CYCLES = 3


def cycle_points(speed):
    """In at the middle of face 0, along the circle to the corner, out there, and back outside."""
    def corner(radius):
        return radius * math.cos(ALPHA), radius * math.sin(ALPHA)

    out = 0.056
    cycle = straight((out, 0), (RHO, 0), speed=speed) + around(RHO, speed, ALPHA)
    cycle += straight(corner(RHO), corner(out), (out + 0.004, 0.01), (out, 0), speed=speed)[1:]
    return cycle[:-1]


def sums_mJ(rows):
    total, sums = 0.0, []
    for row in rows:
        total += max(0.0, row["injected_J"])
        sums.append(1e3 * total)
    return sums


def last_slide(rows, ticks):
    return [row for row in rows[-ticks:] if row["contacts"] > 0 and math.hypot(row["finger_x"], row["finger_y"]) < RHO + 1e-6]


def most_alternating_N(rows):
    """The largest change of the sideways force from one tick to the next."""
    return max(abs(b["force_y"] - a["force_y"]) for a, b in zip(rows[40:], rows[41:]))


def energy(bench):
    """What shading adds over three cycles under each ledger, and what the finger feels meanwhile."""
    scene = bench.obj(prism(SIDES, SIZE))

    def feel(points, mode):
        return bench.trace(scene, points, "--radius", 1e-5, "--shade", "smooth", "--ledger", mode)

    cycle, facts = cycle_points(SPEED), []
    formula_mJ = 500 * ((SIZE - RHO) ** 2 - (INNER - RHO) ** 2) * 1e3
    figure, (added, felt) = canvas(1, 2, 4.6, gridspec_kw={"width_ratios": [1.2, 1]})
    for mode, colour, width in (("report", RED, 2.6), ("tank", GREEN, 1.6), ("strict", BLUE, 2)):
        rows = feel(cycle * CYCLES, mode)
        sums, slide = sums_mJ(rows), last_slide(rows, len(cycle))
        added.plot(column(rows, "t"), sums, color=colour, lw=width, label=f"--ledger {mode}: {sums[-1]:.2f} mJ")
        felt.plot([math.degrees(angle_of(row)) for row in slide], [off_radial(row) for row in slide], color=colour, lw=width, label=mode)
        facts.append(f"{mode} {sums[len(cycle) - 1]:.3f} mJ in one cycle, {sums[-1]:.3f} in {CYCLES}; "
                     f"last slide: sideways force changes by at most {most_alternating_N(slide):.4f} N a tick")
    for i in range(1, CYCLES + 1):
        added.axhline(i * formula_mJ, color="black", lw=0.9, ls=":", label=f"formula, {formula_mJ:.2f} mJ a cycle" if i == 1 else None)
    added.set_ylim(-1, 42)
    added.legend(loc="upper left")
    style(added, "time (s)", "energy added, summed (mJ)", "In at a face, to the corner, out: three times")
    felt.plot([0, 18], [0, -18], color="black", lw=1, ls="--", label="flat object, closed form")
    felt.legend(loc="lower left")
    style(felt, "finger's angle (degrees)", "force off radial (degrees)", "The last slide to the corner")
    slow = sums_mJ(feel(cycle_points(SPEED / 20), "report"))[-1]
    save(figure, "paper_energy.png", *facts, f"one cycle at {SPEED / 20} m/s: {slow:.3f} mJ; formula {formula_mJ:.3f} mJ")
