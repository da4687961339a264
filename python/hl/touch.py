"""A conversation with a haptic server: draw a scene in frames, and take what the device does and feels.

    with hl.connect("inproc:") as touch:
        with touch.frame():
            touch.draw(vertices, triangles)
        print(touch.state().force)

Servo and proxy run in the server's own threads, never in Python: a program that is slow, or waits, changes no force.
A Touch is used by the thread that opened it; another one can take it when that thread has ended.
"""

import asyncio
import contextlib
import math
import weakref
from dataclasses import dataclass
from types import TracebackType
from typing import Any, AsyncIterator, Callable, Dict, Iterator, List, Optional, Sequence, Tuple, Type, Union
from urllib.parse import quote, urlencode

import numpy as np
import numpy.typing as npt

from . import _hl, arguments, calls
from .arguments import Floats
from .batch import SURFACE
from .errors import InvalidOperationError, InvalidValueError

_SAFETY = {
    calls.HL_SAFETY_OFF: "off",
    calls.HL_SAFETY_ARMING: "arming",
    calls.HL_SAFETY_ON: "on",
    calls.HL_SAFETY_FAULT: "fault",
    calls.HL_SAFETY_WAITING: "waiting",
}
_LEDGERS = {"tank": calls.HL_LEDGER_TANK, "strict": calls.HL_LEDGER_STRICT, "report": calls.HL_LEDGER_REPORT}
_GRIPS = {"light": calls.HL_GRIP_LIGHT, "firm": calls.HL_GRIP_FIRM}
# Vertices of one primitive, where each has as many.
_CORNERS = {calls.HL_LINES: 2, calls.HL_TRIANGLES: 3, calls.HL_QUADS: 4}
_SHADINGS = {"flat": calls.HL_FLAT, "smooth": calls.HL_SMOOTH}
_EVENTS = {
    "touch": calls.HL_EVENT_TOUCH,
    "untouch": calls.HL_EVENT_UNTOUCH,
    "button": calls.HL_EVENT_BUTTON,
    "motion": calls.HL_EVENT_MOTION,
    "sleep": calls.HL_EVENT_SLEEP,
    "wake": calls.HL_EVENT_WAKE,
    "impact": calls.HL_EVENT_IMPACT,
}
_BODY_NUMBERS = {
    "mass": calls.HL_BODY_MASS,
    "density": calls.HL_BODY_DENSITY,
    "static_friction": calls.HL_BODY_STATIC_FRICTION,
    "dynamic_friction": calls.HL_BODY_DYNAMIC_FRICTION,
    "restitution": calls.HL_BODY_RESTITUTION,
}
_BODY_VECTORS = {"velocity": calls.HL_BODY_VELOCITY, "spin": calls.HL_BODY_SPIN}
_BODY_SHAPES = {
    "hull": calls.HL_BODY_HULL,
    "box": calls.HL_BODY_BOX,
    "ball": calls.HL_BODY_BALL,
    "capsule": calls.HL_BODY_CAPSULE,
    "cylinder": calls.HL_BODY_CYLINDER,
    "parts": calls.HL_BODY_PARTS,
}
_FIELDS = {"magnet": calls.HL_FIELD_MAGNET, "spring": calls.HL_FIELD_SPRING, "drag": calls.HL_FIELD_DRAG}
_JOINT_KINDS = {
    "ball": calls.HL_JOINT_BALL,
    "hinge": calls.HL_JOINT_HINGE,
    "slider": calls.HL_JOINT_SLIDER,
    "fixed": calls.HL_JOINT_FIXED,
    "distance": calls.HL_JOINT_DISTANCE,
}
_JOINT_NUMBERS = {
    "low": calls.HL_JOINT_LOW,
    "high": calls.HL_JOINT_HIGH,
    "rest": calls.HL_JOINT_REST,
    "spring": calls.HL_JOINT_SPRING,
    "damping": calls.HL_JOINT_DAMPING,
    "friction": calls.HL_JOINT_FRICTION,
}
_JOINT_VECTORS = {
    "anchor": calls.HL_JOINT_ANCHOR,
    "anchor_b": calls.HL_JOINT_ANCHOR_B,
    "axis": calls.HL_JOINT_AXIS,
}
_QUANTITIES = {**SURFACE, "height": calls.HL_HEIGHT}


@dataclass(frozen=True, eq=False)
class State:
    """The device and what it touches, at one time. World frame."""

    time: float  #: s, the server's clock
    age: float  #: s since it was taken here; infinite before the first
    finger: Floats  #: (3,), m
    proxy: Floats  #: (3,), m
    force: Floats  #: (3,), N at the hand
    contacts: int  #: how many; Touch.contacts() has them
    touched_object: int  #: that presses hardest; 0: none
    touched_name: int  #: its name; 0: none
    buttons: int  #: bit i is set while button i is down
    rotation: Floats  #: (4,), of the stylus: unit quaternion x y z w; 0 0 0 1: its shaft lies along +z, or has no wrist
    spin: Floats  #: (3,), rad/s: its angular velocity
    gripper: float  #: rad: how far the gripper is open
    grip_force: float  #: N with which the hand closes it; 0: the device does not report it
    snapped_object: int  #: whose snap holds the proxy; 0: none
    snapped_name: int  #: its name; 0: none
    snap_number: int  #: which of its snaps
    safety: str  #: "off", "arming", "on", "fault" or "waiting"
    servo_rate: float  #: Hz
    proxy_rate: float  #: Hz

    @property
    def touching(self) -> bool:
        return self.contacts > 0


def connect(url: str = "inproc:", **options: Any) -> "Touch":
    """Opens a conversation; waits until the server has welcomed it.

    url: "inproc:" (a server inside this process, with a simulated device), "hl://host[:port]", or "hls://..." with
        TLS.
    options: None is as if it were not there; name, token, device, master, keep, state_rate (Hz), timeout (s), ca, sim: as hl.h says of hlCreateContext.

    Raises ConnectError with the reason.
    """
    if not isinstance(url, str):
        raise InvalidValueError("url must be a text, such as inproc: or hl://127.0.0.1")
    if options:
        url += ("&" if "?" in url else "?") + urlencode(
            {key: _option(value) for key, value in options.items() if value is not None}, quote_via=quote)
    return Touch(_hl.Context(url))


def _option(value: Any) -> Any:
    return int(value) if isinstance(value, bool) else value


class Touch:
    """A conversation with a server, made by `connect`. Closes at the end of `with`.

    When the server has ended the conversation, every call but `close` raises ConnectionLostError with the reason; after
    the program's own `close` it is InvalidOperationError.
    """

    def __init__(self, context: _hl.Context) -> None:
        self._context = context
        self._is_in_frame = False
        self._functions: Dict[int, Callable[[_hl.Event], None]] = {}  # given to `on`, by kind

    def __enter__(self) -> "Touch":
        return self

    def __exit__(
        self,
        kind: Optional[Type[BaseException]],
        error: Optional[BaseException],
        where: Optional[TracebackType],
    ) -> None:
        self.close()

    def close(self) -> None:
        """Ends the conversation; twice is allowed. Its objects are gone, unless it was opened with keep=1.

        In a function given to `on` it raises InvalidOperationError, and the connection stays open.
        """
        self._context.close()

    def make_current(self) -> None:
        """Makes it the thread's current context, for `hl.calls`. The methods here do that themselves."""
        self._context.make_current()

    # ---- Frames

    @contextlib.contextmanager
    def frame(self, wait: bool = True) -> Iterator["Touch"]:
        """One frame: what is drawn inside becomes touchable all at once, and replaces the world of the frame before.

        A frame that draws nothing leaves the world, and changes only what it defines or updates. wait: until it is
        shown. After an exception inside, or where an hlBegin or hlNewObject has no end, nothing is sent: the world,
        objects and textures are as if the frame had not begun. The current material, name, matrix and textures stay as
        they were set.
        """
        self.make_current()
        if self._is_in_frame:
            raise InvalidOperationError("a frame is open: a frame cannot be within another one")
        self._is_in_frame = True
        try:
            yield self
        except BaseException:
            self._cancel_frame()
            raise
        finally:
            self._is_in_frame = False
        self.make_current()
        try:
            if wait:
                calls.hlFinish()
            else:
                calls.hlFlush()
        except InvalidOperationError:  # hlBegin or hlNewObject without its end: it must not stay open in the next frame
            self._cancel_frame()
            raise

    def _cancel_frame(self) -> None:
        with contextlib.suppress(InvalidOperationError):  # it was closed inside
            self.make_current()
            calls.hlCancelFrame()

    def clear(self) -> None:
        """Begins the frame with an empty world."""
        self.make_current()
        calls.hlClear()

    def frame_interval(self, seconds: float) -> None:
        """Objects move to their new places within this time, s; 0: at once; negative: as long as the last frame took."""
        self.make_current()
        calls.hlFrameInterval(arguments.number(seconds, "seconds"))

    # ---- Drawing

    def draw(
        self,
        vertices: npt.ArrayLike,
        indices: Optional[npt.ArrayLike] = None,
        *,
        normals: Optional[npt.ArrayLike] = None,
        texcoords: Optional[npt.ArrayLike] = None,
        mode: int = calls.HL_TRIANGLES,
    ) -> None:
        """Draws vertices, (n, 3) in m: triangles, or what `mode` says (HL_POINTS .. HL_POLYGON of hl.calls).

        indices: whole numbers below n, in a row or as one row of a primitive, as (m, 3) for triangles; None: the
        vertices in their order. normals, for smooth shading: (n, 3). texcoords: (n, 2).
        """
        self.make_current()
        mode = arguments.whole(mode, "mode")
        points = arguments.floats(vertices, "vertices")
        others = (_optional_floats(normals, "normals"), _optional_floats(texcoords, "texcoords"))
        if indices is None:
            calls.hlDrawArrays(mode, points, *others)
            return
        array = arguments.integers(indices, "indices")
        if points.ndim == 2 and points.shape[1] == 3:  # else the call says what is wrong with them
            _require_indices(array, len(points), mode)
        calls.hlDrawElements(mode, points, array.astype(np.uint32), *others)

    def heights(
        self,
        samples: npt.ArrayLike,
        spacing: Union[float, Tuple[float, float]] = 1.0,
        vertical_scale: float = 1.0,
        missing: Optional[float] = None,
    ) -> None:
        """Draws a height field, as hl.Scene(heights=...) has it: samples (rows, columns), metres between them."""
        self.make_current()
        array = arguments.heights(samples)
        across, down = arguments.steps(spacing, 2)
        calls.hlPushMatrix()
        try:
            calls.hlScaled(across, arguments.number(vertical_scale, "vertical_scale"), down)
            calls.hlHeightField(array, missing)
        finally:
            calls.hlPopMatrix()

    def volume(
        self,
        samples: npt.ArrayLike,
        iso: float,
        spacing: Union[float, Tuple[float, float, float]] = 1.0,
        missing: Optional[float] = None,
        matter: Optional[npt.ArrayLike] = None,
        below: bool = False,
    ) -> None:
        """Draws a surface of a volume, as hl.Scene(volume=...) has it: samples (z, y, x), metres between them along x,
        y and z. `matter`, of shape (n, 3), n at most 256: value, resistance (N) and drag (N s/m) by rising values, of
        what hinders the proxy within the volume. `below`: its matter is where samples are below `iso`."""
        self.make_current()
        array, value = arguments.volume(samples), arguments.number(iso, "iso")
        rows = np.empty((0, 3)) if matter is None else arguments.floats(matter, "matter")
        calls.hlVolumeMatter(rows)
        calls.hlVolumeSolid(calls.HL_BELOW if below else calls.HL_ABOVE)
        calls.hlPushMatrix()
        try:
            calls.hlScaled(*arguments.steps(spacing, 3))
            calls.hlVolume(array, value, missing)
        finally:
            calls.hlPopMatrix()

    def depth_frame(
        self,
        depths: npt.ArrayLike,
        camera: Sequence[float],
        scale: float = 0.001,
        join: float = 0.02,
        smoothing: float = 0.0,
    ) -> None:
        """Draws what a depth camera sees: depths of 16 bits (rows, columns) in units of `scale` metres, 0 for none;
        `camera` is fx, fy, cx, cy in pixels. It is at the origin and looks along -z with y up. Define its object anew
        for each frame, as hlDepthFrame states."""
        self.make_current()
        image = np.asarray(depths)
        if image.dtype != np.uint16:
            raise InvalidValueError("depths must be an array of uint16")
        numbers = [arguments.number(value, name) for value, name in
                   ((scale, "scale"), (join, "join"), (smoothing, "smoothing"))]
        calls.hlDepthFrame(np.ascontiguousarray(image), arguments.floats(camera, "camera"), *numbers)

    def points(
        self,
        points: npt.ArrayLike,
        normals: Optional[npt.ArrayLike] = None,
        surfels: Union[bool, float] = False,
        colors: Optional[npt.ArrayLike] = None,
    ) -> None:
        """Draws a cloud of points (n, 3), m, as hl.Scene(points=...) has it. Pages show `colors`: (n, 3) of uint8."""
        self.make_current()
        array = arguments.floats(points, "points")
        given = None if normals is None else arguments.floats(normals, "normals")
        shown = None if colors is None else np.asarray(colors)
        if shown is not None and (shown.dtype != np.uint8 or shown.shape != np.shape(array)):
            raise InvalidValueError("colors must be an array of uint8 with three for each point")
        calls.hlPointCloud(array, given, arguments.reach(surfels))
        if shown is not None:
            calls.hlPointColors(np.ascontiguousarray(shown))

    def implicit(self, solid: Union[str, Dict[str, Any]]) -> None:
        """Draws the surface of a solid that is written down, as hl.Scene(implicit=...) has it."""
        self.make_current()
        calls.hlImplicit(arguments.implicit(solid))

    def volume_surface(
        self, iso: float, spacing: Union[float, Tuple[float, float, float]] = 1.0, below: bool = False
    ) -> None:
        """Draws another surface of the volume that was drawn last in this object or world; nothing is sent again."""
        self.make_current()
        calls.hlVolumeSolid(calls.HL_BELOW if below else calls.HL_ABOVE)
        calls.hlPushMatrix()
        try:
            calls.hlScaled(*arguments.steps(spacing, 3))
            calls.hlVolumeSurface(arguments.number(iso, "iso"))
        finally:
            calls.hlPopMatrix()

    def volume_iso(self, number: int, iso: float, surface: int = 0) -> None:
        """Another iso value for a surface of a volume in the object with this number, with the next frame; `surface`
        counts those that its definition drew, from 0. Nothing is sent again or built."""
        self.make_current()
        calls.hlVolumeIso(
            arguments.whole(number, "the object's number"), arguments.whole(surface, "surface"),
            arguments.number(iso, "iso"))

    @contextlib.contextmanager
    def define(self, number: Optional[int] = None) -> Iterator[int]:
        """Defines an object, new or again, by what is drawn inside; gives its number, for `place`. After an exception
        inside, the object is as it was before."""
        self.make_current()
        number = calls.hlGenObjects(1)[0] if number is None else arguments.whole(number, "the object's number")
        calls.hlNewObject(number)
        try:
            yield number
        except BaseException:
            self.make_current()
            calls.hlCancelObject()
            raise
        self.make_current()
        calls.hlEndObject()

    def body(self, shape: str = "hull", fixed: bool = False, **parameters: Any) -> None:
        """Makes the object that is being defined a rigid body: each `place` of it is one, and goes on from where it is
        while it is placed as it was. The definition draws once, and places nothing.

        shape, by which it meets other bodies: "hull", "box", "ball", "capsule", "cylinder" or "parts", the hulls of the
        pieces of its mesh. fixed: it moves only with frames, and pushes. parameters: mass (kg) or density (kg/m^3), not
        both; static_friction, dynamic_friction, restitution (0..1); velocity (m/s) and spin (rad/s) with which it
        starts, (3,).
        """
        self.make_current()
        _check_names(parameters, _BODY_NUMBERS, _BODY_VECTORS, "a body")
        if "mass" in parameters and "density" in parameters:
            raise InvalidValueError("a body has a mass or density, not both: leave one out")
        calls.hlBodyi(calls.HL_BODY_SHAPE, _chosen(_BODY_SHAPES, shape, "shape of a body"))
        calls.hlBodyi(calls.HL_BODY_FIXED, bool(fixed))
        _set_parameters(parameters, _BODY_NUMBERS, calls.hlBodyd, _BODY_VECTORS, calls.hlBody3d)

    def snap(
        self, points: npt.ArrayLike, capture: float, release: float, normal: Optional[npt.ArrayLike] = None
    ) -> None:
        """Gives the object that is being defined a place to which the proxy goes when it comes as near as `capture`, m,
        and which lets go of it when it is pulled by more than `release`, N.

        points: (3,) a point, or (n, 3) the corners of a curve, m. normal: (3,), of the plane through the one point.
        """
        self.make_current()
        first, *others = _corners(points, normal)
        x, y, z = first
        near, most = arguments.number(capture, "capture"), arguments.number(release, "release")
        if normal is not None:
            nx, ny, nz = _vector(normal, "normal")
            calls.hlSnapPlane3d(x, y, z, nx, ny, nz, near, most)
            return
        calls.hlSnapPoint3d(x, y, z, near, most)
        for corner in others:
            calls.hlSnapLineTo3d(*corner)

    def field(
        self, kind: str, points: npt.ArrayLike, reach: float, strength: float, normal: Optional[npt.ArrayLike] = None
    ) -> None:
        """Gives the object that is being defined a field: "magnet" (strength in N), "spring" (N/m) or "drag" (N s/m)
        within `reach`, m, of its place.

        points: (3,) a point, or (n, 3) the corners of a curve, m. normal: (3,), of the plane through the one point.
        """
        self.make_current()
        first, *others = _corners(points, normal)
        x, y, z = first
        number = _chosen(_FIELDS, kind, "kind of a field")
        far, most = arguments.number(reach, "reach"), arguments.number(strength, "strength")
        if normal is not None:
            nx, ny, nz = _vector(normal, "normal")
            calls.hlFieldPlane3d(number, x, y, z, nx, ny, nz, far, most)
            return
        calls.hlFieldPoint3d(number, x, y, z, far, most)
        for corner in others:
            calls.hlFieldLineTo3d(*corner)

    def push_field(self, point: npt.ArrayLike, reach: float, force: npt.ArrayLike) -> None:
        """Gives the object that is being defined a constant force, (3,) in N, that falls to 0 at `reach`, m, of a point,
        (3,) in m."""
        self.make_current()
        x, y, z = _vector(point, "point")
        fx, fy, fz = _vector(force, "force")
        calls.hlFieldForce3d(x, y, z, arguments.number(reach, "reach"), fx, fy, fz)

    def gravity(self, acceleration: npt.ArrayLike) -> None:
        """Of all bodies, (3,) in m/s^2, from this frame on; (0, -9.81, 0) at first."""
        self.make_current()
        calls.hlGravity3d(*_vector(acceleration, "acceleration"))

    def place(self, number: int, pose: Optional[npt.ArrayLike] = None) -> None:
        """Puts an object into the world: (4, 4), from its frame to the world; None: as it is defined."""
        number = arguments.whole(number, "the object's number")
        with self.matrix(np.eye(4) if pose is None else pose):
            calls.hlCallObject(number)

    def join(
        self,
        joint: int,
        a: int,
        b: int = 0,
        kind: str = "ball",
        names: Tuple[int, int] = (0, 0),
        table: Optional[Tuple[npt.ArrayLike, npt.ArrayLike]] = None,
        collide: bool = False,
        **parameters: Any,
    ) -> None:
        """Joins two bodies of the world that this frame draws, or one to the world, as joint number `joint`. While
        number, kind and bodies stay the same from frame to frame, it goes on from where it is.

        a, b: numbers of objects that are bodies; b 0: the world. names: of their `place`; 0: the object is placed once.
        kind: "ball", "hinge", "slider", "fixed" or "distance". table: positions along the coordinate and the forces on
        a there. collide: whether the two also meet each other. parameters: anchor, anchor_b (m) and axis, (3,), in the
        frame of the matrix around; along the coordinate, in m and N, or rad and N m of a hinge: low, high, spring,
        rest, damping, friction.
        """
        self.make_current()
        _check_names(parameters, _JOINT_NUMBERS, _JOINT_VECTORS, "a joint")
        calls.hlJointi(calls.HL_JOINT_KIND, _chosen(_JOINT_KINDS, kind, "kind of joint"))
        calls.hlJointi(calls.HL_JOINT_COLLIDE, bool(collide))
        _set_parameters(parameters, _JOINT_NUMBERS, calls.hlJointd, _JOINT_VECTORS, calls.hlJoint3d)
        if table is not None:
            positions, forces = table
            calls.hlJointTable(arguments.floats(positions, "positions"), arguments.floats(forces, "forces"))
        name_a, name_b = (arguments.whole(name, "a name") for name in names)
        a, b = arguments.whole(a, "a"), arguments.whole(b, "b")
        calls.hlJoin(arguments.whole(joint, "the joint's number"), a, name_a, b, name_b)

    def update_vertices(
        self, number: int, vertices: npt.ArrayLike, first: int = 0, normals: Optional[npt.ArrayLike] = None
    ) -> None:
        """Moves the vertices of an object from number `first` on: (n, 3), m. What bends pushes the proxy."""
        self.make_current()
        calls.hlUpdateVertices(
            arguments.whole(number, "the object's number"),
            arguments.floats(vertices, "vertices"),
            arguments.whole(first, "first", most=2**31 - 1),
            _optional_floats(normals, "normals"),
        )

    def delete(self, *numbers: int) -> None:
        """Forgets objects."""
        self.make_current()
        calls.hlDeleteObjects([arguments.whole(number, "the object's number") for number in numbers])

    @contextlib.contextmanager
    def matrix(self, pose: npt.ArrayLike) -> Iterator[None]:
        """What is drawn inside is placed by this (4, 4) matrix, and by those around it."""
        array = arguments.floats(pose, "a pose")
        if array.shape != (4, 4):
            raise InvalidValueError(f"a pose must have the shape (4, 4), and has {array.shape}")
        self.make_current()
        calls.hlPushMatrix()
        try:
            calls.hlMultMatrixd(array.T.ravel().tolist())
            yield
        finally:
            self.make_current()
            calls.hlPopMatrix()

    @contextlib.contextmanager
    def name(self, number: int) -> Iterator[None]:
        """What is drawn inside has this name, which states and events report."""
        self.make_current()
        calls.hlPushName(arguments.whole(number, "a name"))
        try:
            yield
        finally:
            self.make_current()
            calls.hlPopName()

    # ---- Surface

    def material(self, **quantities: float) -> None:
        """Sets what is drawn next: stiffness (0..1), static_friction, dynamic_friction, viscosity (N s/m), stribeck
        (m/s), presliding (N/m), adhesion (N), compliance (m/N), strength (N)."""
        self.make_current()
        for key, value in quantities.items():
            calls.hlMateriald(_chosen(SURFACE, key, "quantity"), arguments.number(value, key))

    def shade(self, model: str) -> None:
        """"flat" or "smooth", for what is drawn next."""
        self.make_current()
        calls.hlShadeModel(_chosen(_SHADINGS, model, "shading"))

    @contextlib.contextmanager
    def surface(self, shade: Optional[str] = None, **quantities: float) -> Iterator[None]:
        """What is drawn inside has this surface; see material and shade."""
        self.make_current()
        calls.hlPushAttrib(calls.HL_SURFACE_BIT)
        try:
            self.material(**quantities)
            if shade is not None:
                self.shade(shade)
            yield
        finally:
            self.make_current()
            calls.hlPopAttrib()

    def make_texture(self, texels: npt.ArrayLike) -> int:
        """A texture, (height, width), the row of v = 0 first; uint8, or floats 0..1. Gives its number."""
        self.make_current()
        array = _texels(texels)
        number = calls.hlGenTextures(1)[0]
        calls.hlPushAttrib(calls.HL_TEXTURE_BIT)
        try:
            calls.hlBindTexture(calls.HL_TEXTURE_2D, number)
            calls.hlTexImage2D(array)
        finally:
            calls.hlPopAttrib()
        return number

    @contextlib.contextmanager
    def texture(self, number: int, quantity: str, low: float, high: float, unit: int = 0) -> Iterator[None]:
        """What is drawn inside, with texcoords, has a quantity that goes from `low`, where a texel is 0, to `high`.

        quantity: one of material's, or "height" (m): a bump map. Several quantities at once take several units.
        """
        self.make_current()
        calls.hlPushAttrib(calls.HL_TEXTURE_BIT)
        try:
            calls.hlActiveTexture(calls.HL_TEXTURE0 + arguments.whole(unit, "unit", most=31))
            calls.hlBindTexture(calls.HL_TEXTURE_2D, arguments.whole(number, "the texture's number"))
            calls.hlTexEnvi(
                calls.HL_TEXTURE_ENV, calls.HL_TEXTURE_QUANTITY, _chosen(_QUANTITIES, quantity, "quantity")
            )
            calls.hlTexEnvd(calls.HL_TEXTURE_ENV, calls.HL_TEXTURE_LOW, arguments.number(low, "low"))
            calls.hlTexEnvd(calls.HL_TEXTURE_ENV, calls.HL_TEXTURE_HIGH, arguments.number(high, "high"))
            calls.hlEnable(calls.HL_TEXTURE_2D)
            yield
        finally:
            self.make_current()
            calls.hlPopAttrib()

    # ---- Device: for the client that came first

    def proxy_radius(self, radius: float) -> None:
        """m in the world, > 0."""
        self.make_current()
        calls.hlProxyd(calls.HL_PROXY_RADIUS, arguments.number(radius, "radius"))

    def spring(self, stiffness: float) -> None:
        """K of the servo, N/m at the hand."""
        self.make_current()
        calls.hlSpringd(arguments.number(stiffness, "stiffness"))

    def workspace(self, origin: npt.ArrayLike, world_per_device: float) -> None:
        """The world's point at the device's origin, (3,) in m, and metres of the world for one metre of the hand."""
        self.make_current()
        x, y, z = _vector(origin, "origin")
        calls.hlWorkspaced(x, y, z, arguments.number(world_per_device, "world_per_device"))

    def ledger(self, mode: str) -> None:
        """What happens to energy that surfaces add: "tank", "strict" or "report"."""
        self.make_current()
        calls.hlLedger(_chosen(_LEDGERS, mode, "ledger"))

    def rearm(self) -> None:
        """Leaves a fault; the force rises from zero."""
        self.make_current()
        calls.hlRearm()

    def hand_goal(self, position: npt.ArrayLike) -> None:
        """Simulated devices: where the hand wants to be, (3,), m in the world."""
        self.make_current()
        calls.hlHandGoal3d(*_vector(position, "position"))

    def hand_turn(self, rotation: npt.ArrayLike) -> None:
        """Simulated devices with a wrist: how the hand wants the stylus to be turned, (4,): a quaternion x y z w of any
        length but 0."""
        self.make_current()
        calls.hlHandTurn4d(*_numbers(rotation, 4, "rotation"))

    def hand_gripper(self, angle: float) -> None:
        """Simulated devices with a gripper: how far the hand wants it to be open, rad."""
        self.make_current()
        calls.hlHandGripperd(arguments.number(angle, "angle"))

    def hand_grip(self, grip: str) -> None:
        """Simulated devices: "light" or "firm"."""
        self.make_current()
        calls.hlHandGrip(_chosen(_GRIPS, grip, "grip"))

    # ---- What comes back

    def poll(self) -> int:
        """Takes what the server has sent, and calls the functions given to `on`; how many it called."""
        return self._context.poll()

    def on(self, kind: str, function: Optional[Callable[[_hl.Event], None]]) -> None:
        """`poll` calls `function(event)` for each event of `kind`; None: no more. Kinds: "touch", "untouch", "button",
        "motion", and of bodies "sleep", "wake" and "impact".

        An event has kind, time (s), object, name, position (of the proxy, m), button, down and impulse (N s). What a
        function raises, `poll` raises when all have run. A function may draw frames; it may not call `poll`, `state`,
        `contacts` or `close`.
        """
        number = _chosen(_EVENTS, kind, "event")
        if function is None:
            self._context.on_event(number, None)
            self._functions.pop(number, None)
            return
        if not callable(function):
            raise InvalidValueError("function must be one that can be called, or None")
        self._context.on_event(number, _Caller(self))
        self._functions[number] = function

    def state(self) -> State:
        """The newest state that has come; does not wait."""
        self.poll()
        get = calls.hlGetDoublev
        return State(
            time=get(calls.HL_STATE_TIME),
            age=get(calls.HL_STATE_AGE),
            finger=np.array(get(calls.HL_FINGER_POSITION)),
            proxy=np.array(get(calls.HL_PROXY_POSITION)),
            force=np.array(get(calls.HL_FORCE)),
            contacts=calls.hlGetIntegerv(calls.HL_CONTACT_COUNT),
            touched_object=int(get(calls.HL_TOUCHED_OBJECT)),
            touched_name=int(get(calls.HL_TOUCHED_NAME)),
            buttons=int(get(calls.HL_BUTTONS)),
            rotation=np.array(get(calls.HL_STYLUS_ROTATION)),
            spin=np.array(get(calls.HL_STYLUS_SPIN)),
            gripper=get(calls.HL_GRIPPER_ANGLE),
            grip_force=get(calls.HL_GRIPPER_FORCE),
            snapped_object=int(get(calls.HL_SNAPPED_OBJECT)),
            snapped_name=int(get(calls.HL_SNAPPED_NAME)),
            snap_number=int(get(calls.HL_SNAP_NUMBER)),
            safety=_SAFETY[calls.hlGetIntegerv(calls.HL_SAFETY_STATE)],
            servo_rate=get(calls.HL_SERVO_RATE),
            proxy_rate=get(calls.HL_PROXY_RATE),
        )

    async def states(self, rate: float = 60.0) -> AsyncIterator[State]:
        """The newest states as they come, at most `rate` a second; what came between is left out.

        Callbacks of `on` are called too. Ends with ConnectionLostError when the conversation does.
        """
        rate = arguments.number(rate, "rate")
        if not (math.isfinite(rate) and rate > 0):
            raise InvalidValueError("rate must be above 0")
        self.make_current()
        calls.hlStateRate(rate)
        before = -math.inf
        while True:
            state = self.state()
            if math.isfinite(state.age) and state.time > before:
                before = state.time
                yield state
            await asyncio.sleep(0.5 / rate)

    def contacts(self) -> npt.NDArray[np.void]:
        """The contacts of the newest state, hardest first: a structured array with point (m), normal, share (m),
        static_friction, stiffness, object, name, session."""
        self.poll()
        return calls.hlGetContacts()

    def bodies(self) -> npt.NDArray[np.void]:
        """The rigid bodies of the newest state that move, sorted by object and name: a structured array with object,
        name, position (m), rotation (x y z w), velocity (m/s) and spin (rad/s)."""
        self.poll()
        return calls.hlGetBodies()

    def joints(self) -> npt.NDArray[np.void]:
        """The joints of the newest state, sorted by number: a structured array with joint, coordinate (m or rad),
        velocity, force (N or N m along the coordinate, on its first body) and hold (N, with which it holds that body
        at its anchor)."""
        self.poll()
        return calls.hlGetJoints()

    def remote_hands(self) -> npt.NDArray[np.void]:
        """The hands of other servers of a shared world, sorted by server: a structured array with server and device
        (bytes, of UTF-8), finger and proxy (m), force (N, on that hand), rotation (x y z w), radius (m), buttons and
        contacts."""
        self.poll()
        return calls.hlGetRemoteHands()

    def push(self, number: int, impulse: npt.ArrayLike, point: npt.ArrayLike, seconds: float = 0.0) -> None:
        """Gives the shown bodies of an object, inside of `name` those of that name, an impulse, (3,) in N s, at a point
        of the world, (3,) in m; evenly within `seconds` (0..10), or at once."""
        self.make_current()
        number = arguments.whole(number, "the object's number")
        ix, iy, iz = _vector(impulse, "impulse")
        px, py, pz = _vector(point, "point")
        calls.hlBodyImpulsed(number, ix, iy, iz, px, py, pz, arguments.number(seconds, "seconds"))

    def keep_samples(self, most: int) -> None:
        """From now on keep the newest `most` steps of the servo, for `samples`; 0: none."""
        self.make_current()
        calls.hlKeepSamples(arguments.whole(most, "the number of samples", most=2**31 - 1))

    def samples(self) -> npt.NDArray[np.void]:
        """The steps of the servo since the last time: a structured array with time (s), position (m), force (N),
        buttons, rotation (of the stylus, x y z w), spin (rad/s), gripper (rad) and grip_force (N). Takes them out."""
        self.poll()
        return calls.hlTakeSamples()

    def get(self, query: int) -> Any:
        """The value of any query of hl.h, such as hl.calls.HL_MAX_OBJECTS: a number, or an array."""
        self.make_current()
        value = calls.hlGetDoublev(arguments.whole(query, "a query"))
        return np.array(value) if isinstance(value, list) else value

    @property
    def device_name(self) -> str:
        self.make_current()
        return calls.hlGetString(calls.HL_DEVICE_NAME)

    @property
    def device_label(self) -> str:
        """What the device is called at its server, such as "left"; "" for the only one."""
        self.make_current()
        return calls.hlGetString(calls.HL_DEVICE_LABEL)

    @property
    def devices(self) -> List[str]:
        """The labels of all devices of the server, by number: connect(url, device=LABEL) for each hand."""
        self.make_current()
        count = int(calls.hlGetIntegerv(calls.HL_DEVICE_COUNT))
        return [calls.hlGetStringi(calls.HL_DEVICE_LABEL, number) for number in range(count)]

    @property
    def server_version(self) -> str:
        self.make_current()
        return calls.hlGetString(calls.HL_SERVER_VERSION)

    @property
    def is_master(self) -> bool:
        """Whether it may set the device's proxy, workspace and spring: the client that came first."""
        self.make_current()
        return bool(calls.hlGetIntegerv(calls.HL_MASTER))


class _Caller:
    """What C++ keeps in place of a function: it does not keep the Touch, so that a function may, and all go together."""

    def __init__(self, touch: Touch) -> None:
        self._touch = weakref.ref(touch)

    def __call__(self, event: _hl.Event) -> None:
        touch = self._touch()
        function = None if touch is None else touch._functions.get(event.kind)
        if function is not None:
            function(event)


def _require_indices(indices: npt.NDArray[np.int64], vertices: int, mode: int) -> None:
    if indices.size > 0 and (indices.min() < 0 or indices.max() >= vertices):
        raise InvalidValueError("an index must be below the number of vertices")
    corners = _CORNERS.get(mode)
    if indices.ndim > 1 and corners and indices.shape[-1] != corners:
        raise InvalidValueError(f"indices: rows of {indices.shape[-1]}, but a primitive of this mode has {corners}")


def _optional_floats(numbers: Optional[npt.ArrayLike], name: str) -> Optional[Floats]:
    return None if numbers is None else arguments.floats(numbers, name)


def _texels(texels: npt.ArrayLike) -> npt.NDArray[Any]:
    array = np.asarray(texels)
    if array.dtype == np.uint8:
        return array
    if array.dtype.kind != "f":
        raise InvalidValueError(f"texels must be uint8, or floats 0..1, and are {array.dtype}")
    if array.size > 0 and (array.min() < 0 or array.max() > 1):
        raise InvalidValueError("texels that are floats must be 0..1; those of 0..255 are uint8")
    return array


def _chosen(table: Dict[str, int], key: str, what: str) -> int:
    if not isinstance(key, str) or key not in table:
        raise InvalidValueError(f"there is no {what} '{key}': {', '.join(table)}")
    return table[key]


def _check_names(parameters: Dict[str, Any], numbers: Dict[str, int], vectors: Dict[str, int], what: str) -> None:
    for key in parameters:
        if key not in numbers and key not in vectors:
            raise InvalidValueError(f"{what} has no '{key}': {', '.join([*numbers, *vectors])}")


def _set_parameters(
    parameters: Dict[str, Any],
    numbers: Dict[str, int],
    set_number: Callable[..., None],
    vectors: Dict[str, int],
    set_vector: Callable[..., None],
) -> None:
    for key, value in parameters.items():
        if key in numbers:
            set_number(numbers[key], arguments.number(value, key))
        else:
            set_vector(vectors[key], *_vector(value, key))


def _corners(points: npt.ArrayLike, normal: Optional[npt.ArrayLike]) -> Any:
    """Of a point, curve or plane: (n, 3)."""
    corners = np.atleast_2d(arguments.floats(points, "points"))
    if corners.ndim != 2 or corners.shape[1] != 3 or len(corners) == 0:
        raise InvalidValueError("points must be (3,) or (n, 3)")
    if normal is not None and len(corners) != 1:
        raise InvalidValueError("a plane has one point")
    return corners.tolist()


_COUNTS = {3: "three", 4: "four"}


def _numbers(numbers: npt.ArrayLike, count: int, name: str) -> Any:
    array = arguments.floats(numbers, name)
    if array.shape != (count,):
        raise InvalidValueError(f"{name} must be {_COUNTS[count]} numbers, and has the shape {array.shape}")
    return array.tolist()


def _vector(numbers: npt.ArrayLike, name: str) -> Any:
    return _numbers(numbers, 3, name)
