"""Pictures of the page: one of each example while it is touched, of a scene, and films."""
import asyncio
import io
import tempfile
from pathlib import Path

from PIL import Image

from plots import look
from plots.browser import Browser, Program, built, server

PICTURE = (1280, 720, 0.8)   # the page's size and the picture's for one of it
CLIENT = (480, 560, 1)       # of a page that is the client itself
FILM = (1280, 720, 1)
LONG_S = 600                 # an example goes on until its picture is taken
SHOWN = "window.__hl && __hl.triangles + __hl.objects > 0"
# Felt, and for long enough that the plots show something.
TOUCHED = "window.__hl && __hl.force_N && Math.hypot(...['x', 'y', 'z'].map((axis) => __hl.force_N[axis])) > 0.3"
PLOTS_S = 4
FILM_S, FILM_QUALITY = 10, 60

EXAMPLES = ["01_sphere", "02_teapot_with_material", "03_lines_and_points", "04_hierarchy", "05_moving_paddle",
            "06_textures", "07_events_buttons", "08_browser", "10_client", "11_web_client", "13_client"]


def report(path):
    print(path.relative_to(look.ROOT) if path.is_relative_to(look.ROOT) else path)


def command_of(name, programs, address):
    url = f"hl://{address}"
    if name == "08_browser":
        return [built(programs, f"examples/{name}"), look.ROOT / "tests/examples/square.x3d", url, LONG_S]
    if name == "10_client":
        return ["/usr/bin/python3", look.ROOT / "examples/10_client.py", f"ws://{address}/hl", LONG_S]
    if name == "13_client":
        return ["mono", built(programs, "../tests/csharp/13_client.exe"), url, LONG_S]  # the tests build it
    return [built(programs, f"examples/{name}"), url, LONG_S]


def path_of(name):
    return look.folder / "examples" / f"{name}.png"


def write(png, path, method=Image.Quantize.MEDIANCUT):
    picture = Image.open(io.BytesIO(png)).convert("RGB")
    path.parent.mkdir(parents=True, exist_ok=True)
    picture.quantize(look.COLOURS, method, dither=Image.Dither.NONE).save(path, optimize=True)
    report(path)


async def picture_of(name, programs):
    if name == "11_web_client":  # the page is the client
        with server(built(programs, "hld"), look.ROOT / "examples") as served:
            async with Browser(*CLIENT) as browser:
                page = f"http://{served.found.group(1)}/11_web_client.html"
                await browser.open(page, "document.getElementById('touched').textContent.startsWith('touching')")
                write(await browser.picture(), path_of(name))
        return
    with server(built(programs, "hld")) as served:
        address = served.found.group(1)
        with Program(command_of(name, programs, address)):
            async with Browser(*PICTURE) as browser:
                await browser.open(f"http://{address}/", SHOWN)
                await asyncio.sleep(PLOTS_S)
                await browser.wait_for(TOUCHED)
                write(await browser.picture(), path_of(name))


async def picture_of_scene(scene, programs):
    touch = [built(programs, "hl"), "touch", scene, "--no-open", "--port", "0", "--explore", "off"]
    with Program(touch, r"page: (http://\S+/)") as served:
        async with Browser(*PICTURE) as browser:
            await browser.open(served.found.group(1), SHOWN)
            await asyncio.sleep(PLOTS_S)
            return await browser.picture()


async def picture_of_shared(address):
    async with Browser(*PICTURE) as browser:
        await browser.open(f"http://{address}/", SHOWN)
        await browser.wait_for("window.__hl && __hl.remoteHands.length === 2")
        await asyncio.sleep(PLOTS_S)
        return await browser.picture()


def shared(programs):
    """Three servers: one with a scene, one with nothing but a hand, and the one whose page is seen."""
    def sharing(name):
        return ["--share", "gallery", "--share-name", name, "--port", "0"]

    touch = [built(programs, "hl"), "touch", "workshop", "--no-open", *sharing("anna")]
    idle = [built(programs, "hld"), "--explore", "on", *sharing("carl")]
    seen = [built(programs, "hld"), "--explore", "on", *sharing("bert")]
    with Program(touch, "page: "), Program(idle, "event=ready"), Program(seen, r"address=http://(\S+)/") as served:
        png = asyncio.run(picture_of_shared(served.found.group(1)))
    # Colours of servers are of few pixels, and differ.
    write(png, look.folder / "shared_page.png", Image.Quantize.MAXCOVERAGE)


def parts(programs):
    for name, picture in (("parts", "bodies_of_parts"), ("hollow", "hollow_bodies")):
        scene = look.ROOT / f"scenes/examples/{name}.hl.json"
        write(asyncio.run(picture_of_scene(scene, programs)), look.folder / f"{picture}.png")


def depth(programs):
    write(asyncio.run(picture_of_scene("depth:table", programs)), look.folder / "depth_page.png")


def textured_heights(programs):
    scene = look.ROOT / "scenes/examples/textured_heights.hl.json"
    write(asyncio.run(picture_of_scene(scene, programs)), look.folder / "textured_heights.png")


def painted(programs):
    scene = look.ROOT / "scenes/examples/painted.hl.json"
    write(asyncio.run(picture_of_scene(scene, programs)), look.folder / "painted.png")


# From where the hand comes to the scan, and where it is then held, m: 5 mm within a bone.
BEGIN_M, HELD_M = (-0.075, 0.037, 0.041), (-0.0295, 0.0207, 0.0161)
BONE_HU = 370


async def skin_and_bone(programs, path):
    touch = [built(programs, "hl"), "touch", "ct:phantom:161", "--no-open", "--port", "0", "--hand-path", path]
    pictures = []
    with Program(touch, r"page: (http://\S+/)") as served:
        async with Browser(*PICTURE) as browser:
            await browser.open(served.found.group(1), SHOWN)
            for iso in (None, BONE_HU):
                if iso is not None:
                    await browser.value_of(f"document.getElementById('iso-1').value = {iso}")
                    await browser.value_of("document.getElementById('iso-1').dispatchEvent(new Event('input'))")
                await asyncio.sleep(PLOTS_S)
                await browser.wait_for(TOUCHED)
                picture = Image.open(io.BytesIO(await browser.picture())).convert("RGB")
                pictures.append(picture.crop((0, 0, round(0.74 * picture.width), picture.height)))
    return pictures


def scan(programs):
    """The hand stays where it is; what it touches changes with the iso value."""
    with tempfile.TemporaryDirectory() as directory:
        path = Path(directory) / "held.csv"
        rows = [(0, *BEGIN_M), (2, *HELD_M), (LONG_S, *HELD_M)]
        path.write_text("t,x,y,z\n" + "".join(",".join(map(str, row)) + "\n" for row in rows))
        left, right = asyncio.run(skin_and_bone(programs, path))
    write_beside(left, right, look.folder / "scan_page.png")


def write_beside(left, right, path):
    both = Image.new("RGB", (left.width + right.width, left.height))
    both.paste(left, (0, 0))
    both.paste(right, (left.width, 0))
    stored = io.BytesIO()
    both.save(stored, "PNG")
    write(stored.getvalue(), path)


# How a hand comes to the teapot and stays, m, with the stylus turned (w x y z) and its gripper open, rad.
PEN = [(0, 0.02, 0.01, 0.12, 1, 0, 0, 0, 0), (3, 0.02, 0.01, 0.12, 1, 0, 0, 0, 0),
       (5, 0.02, 0.01, 0.03, 0.85, -0.45, -0.1, 0.2, 0.5)]


async def picture_of_stylus(device, programs, path):
    touch = [built(programs, "hl"), "touch", "teapot", "--no-open", "--port", "0", "--device", device, "--hand-path", path]
    with Program(touch, r"page: (http://\S+/)") as served:
        async with Browser(*PICTURE) as browser:
            await browser.open(served.found.group(1), SHOWN)
            await asyncio.sleep(PEN[-1][0])
            await browser.wait_for(TOUCHED)
            await asyncio.sleep(1)
            picture = Image.open(io.BytesIO(await browser.picture())).convert("RGB")
            return picture.crop((round(0.24 * picture.width), 0, round(0.74 * picture.width), picture.height))


def stylus(programs):
    """A pen, and one with a gripper."""
    with tempfile.TemporaryDirectory() as directory:
        path = Path(directory) / "pen.csv"
        rows = [*PEN, (LONG_S, *PEN[-1][1:])]
        header = "t,x,y,z,qw,qx,qy,qz,gripper_rad\n"
        path.write_text(header + "".join(",".join(map(str, row)) + "\n" for row in rows))
        pictures = [asyncio.run(picture_of_stylus(device, programs, path)) for device in ("sim", "sim:omega7")]
    write_beside(*pictures, look.folder / "stylus.png")


def gallery(programs, names=None):
    for name in names or EXAMPLES:
        asyncio.run(picture_of(name, programs))


async def frames_of(browser):
    """Pictures, and of each the time until the next, ms."""
    frames = [(time_s, Image.open(io.BytesIO(jpeg)).convert("RGB")) async for time_s, jpeg in browser.frames(FILM_S)]
    times_s = [time_s for time_s, _ in frames]
    return [picture for _, picture in frames[:-1]], [round(1e3 * (b - a)) for a, b in zip(times_s, times_s[1:])]


async def film_of(programs, scene, begin, options):
    touch = [built(programs, "hl"), "touch", scene, "--no-open", "--port", "0", *options]
    with Program(touch, r"page: (http://\S+/)") as served:
        async with Browser(*FILM) as browser:
            await browser.open(served.found.group(1), SHOWN)
            await browser.wait_for(begin)
            return await frames_of(browser)


def film(programs, scene="teapot", name="film", begin=TOUCHED, options=()):
    frames, durations_ms = asyncio.run(film_of(programs, scene, begin, options))
    path = look.folder / f"{name}.webp"
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=durations_ms, loop=0,
                   quality=FILM_QUALITY, method=4)
    report(path)
    print(f"    {len(frames)} frames in {FILM_S} s, {path.stat().st_size // 1000} kB")


# Where the hand goes in the workshop: s, m. It tips the dominoes, opens the door, presses a button, hits the blocks.
BEGIN_S = 4.5  # the page is open by then
TOUR = [(0, -0.15, 0.05, 0.075), (1, -0.15, 0.02, 0.075), (1.8, -0.115, 0.022, 0.075), (2.2, -0.13, 0.06, 0.06),
        (3.2, -0.08, 0.06, -0.02), (3.7, -0.082, 0.035, -0.03), (5.2, -0.085, 0.033, -0.08), (5.7, -0.06, 0.08, -0.03),
        (6.4, 0.02, 0.05, 0.03), (7.1, 0.02, 0.0, 0.03), (7.6, 0.02, 0.06, 0.02), (8.2, -0.02, 0.03, -0.02),
        (9.5, -0.02, 0.03, -0.075), (10, -0.02, 0.1, 0)]


def workshop(programs):
    with tempfile.TemporaryDirectory() as directory:
        path = Path(directory) / "tour.csv"
        rows = [(0, *TOUR[0][1:]), *((BEGIN_S + time_s, *place) for time_s, *place in TOUR)]
        path.write_text("t,x,y,z\n" + "".join(",".join(map(str, row)) + "\n" for row in rows))
        film(programs, "workshop", "workshop", SHOWN, ("--hand-path", path))
