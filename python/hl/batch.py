"""Many fingers, paths and points over one scene: without a server, a device or a clock.

Lengths are metres, forces newtons, times seconds, all in the world frame. Every finger has the same bits as if it were
alone, whatever the number of threads. Other threads of Python run while a call computes, and Ctrl-C ends trace and
closest.
"""

import os
import warnings
from dataclasses import dataclass, fields
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union, overload

import numpy as np
import numpy.typing as npt

from . import _hl, arguments
from .arguments import Floats
from .errors import InvalidValueError

# The fields of Settings that are a quantity of the surface: their constant in hl.h.
SURFACE = {
    "stiffness": _hl.calls.HL_STIFFNESS,
    "static_friction": _hl.calls.HL_STATIC_FRICTION,
    "dynamic_friction": _hl.calls.HL_DYNAMIC_FRICTION,
    "viscosity": _hl.calls.HL_VISCOSITY,
    "stribeck": _hl.calls.HL_STRIBECK,
    "presliding": _hl.calls.HL_PRESLIDING,
    "adhesion": _hl.calls.HL_ADHESION,
    "compliance": _hl.calls.HL_COMPLIANCE,
    "strength": _hl.calls.HL_STRENGTH,
}


class Scene:
    """What can be touched; immutable. May be used by several threads at once.

    Scene(source, size=0.0): a model file, a scene file (*.hl.json), or a built-in scene by its name ("teapot",
        "terrain:100000"). `size`: metres of its largest side; 0: as it is, one unit of the file is a metre. Files are
        read in a child process without rights.
    Scene(vertices, triangles, normals=None): arrays (n, 3) in m, (m, 3) of integers, (n, 3). `normals` are for smooth
        shading. Degenerate triangles, and those beyond 1e9 m, are left out: `primitives` counts the others.

    Scene(heights=samples, spacing=1.0, vertical_scale=1.0, missing=None): a height field: an array (rows, columns) of
        int16, uint16 or float32; others become float32. Columns lead to +x, rows to +z, `spacing` m apart (one number,
        or that of columns and that of rows), with the middle at x = z = 0; heights are y, `vertical_scale` m for a
        unit. Around samples that equal `missing`, or are not a number, there are holes. A sample takes 2 or 4 bytes,
        however many triangles there are.

    Scene(volume=samples, iso=value, spacing=1.0, missing=None, below=False): the surface of a volume where its samples are `iso`, or
        several surfaces of it, of a list of values: an array (z, y, x) of int16, uint16 or float32; others become
        float32. Samples are `spacing` m apart (one number, or those along x, y and z; 1e-12 to 1e9), with the middle at
        the origin. A value at which there is no surface is refused.
        There is no surface around samples that equal `missing`, or are not a number. The matter is where samples are
        above `iso`, or with `below` where they are below it, as of signed distances.

    Scene(points=points, normals=None, surfels=False): a cloud of points (n, 3), m, as scanners give it. `normals` (n, 3),
        of either sign, are for smooth shading; None: those of the plane through the 12 nearest points. A ball sinks
        between points; with `surfels` each is a small hexagon across its normal: True, or how many distances between
        neighbours it reaches (True: 0.75).

    Scene(implicit=solid): the surface of a solid that is written down as in a scene file, a dict or JSON:
        {"expression": {"torus": {"radius": 0.03, "tube": 0.01}}, "error": 1e-6}, lengths in m.

    Raises InvalidValueError: there is no such file, or nothing in it can be touched. Ctrl-C is heard when it is made.
    """

    @overload
    def __init__(self, source: Union[str, bytes, "os.PathLike[Any]"], *, size: float = 0.0) -> None: ...
    @overload
    def __init__(
        self, vertices: npt.ArrayLike, /, triangles: npt.ArrayLike, normals: Optional[npt.ArrayLike] = None
    ) -> None: ...
    @overload
    def __init__(
        self, *, vertices: npt.ArrayLike, triangles: npt.ArrayLike, normals: Optional[npt.ArrayLike] = None
    ) -> None: ...
    @overload
    def __init__(
        self,
        *,
        heights: npt.ArrayLike,
        spacing: Union[float, Tuple[float, float]] = 1.0,
        vertical_scale: float = 1.0,
        missing: Optional[float] = None,
    ) -> None: ...
    @overload
    def __init__(
        self,
        *,
        volume: npt.ArrayLike,
        iso: Union[float, Sequence[float]],
        spacing: Union[float, Tuple[float, float, float]] = 1.0,
        missing: Optional[float] = None,
        below: bool = False,
    ) -> None: ...
    @overload
    def __init__(
        self,
        *,
        points: npt.ArrayLike,
        normals: Optional[npt.ArrayLike] = None,
        surfels: Union[bool, float] = False,
    ) -> None: ...

    @overload
    def __init__(self, *, implicit: Union[str, Dict[str, Any]]) -> None: ...
    def __init__(
        self,
        source: Any = None,
        triangles: Any = None,
        normals: Any = None,
        *,
        size: Any = 0.0,
        vertices: Any = None,
        heights: Any = None,
        volume: Any = None,
        implicit: Any = None,
        iso: Any = None,
        spacing: Any = None,
        vertical_scale: Any = None,
        missing: Any = None,
        points: Any = None,
        surfels: Any = False,
        below: bool = False,
        grid: Optional[str] = None,
    ) -> None:
        of_file = isinstance(source, (str, bytes, os.PathLike))
        if of_file and isinstance(triangles, (int, float)):
            raise InvalidValueError(f"the size is given by its name: hl.Scene({source!r}, size={triangles})")
        made_of = {
            "a file": source if of_file else None,
            "vertices": None if of_file else source if vertices is None else vertices,
            "heights": heights,
            "a volume": volume,
            "points": points,
            "an implicit surface": implicit,
        }
        options = dict(triangles=triangles, normals=normals, size=size, iso=iso, spacing=spacing)
        options.update(vertical_scale=vertical_scale, missing=missing, surfels=surfels, below=below, grid=grid)
        kind = _kind_of(made_of, options)
        if kind == "vertices" and source is not None and vertices is not None:
            raise InvalidValueError("vertices are given twice")
        spacing = 1.0 if spacing is None else spacing
        self._source: Any = None
        if kind == "a file":
            self._source = (os.fspath(source), arguments.number(size, "size"))
            self._scene = _hl.BatchScene(arguments.path(source), self._source[1])
        elif kind == "points":
            self._scene = _cloud_of(points, normals, surfels)
        elif kind == "an implicit surface":
            self._scene = _hl.BatchScene(arguments.implicit(implicit))
        elif kind == "a volume":
            self._scene = _volume_of(volume, iso, spacing, missing, below)
        elif kind == "heights":
            self._scene = _heights_of(heights, spacing, 1.0 if vertical_scale is None else vertical_scale, missing)
        else:
            self._scene = _made_of(made_of["vertices"], triangles, normals)
        for line in self._scene.warnings:
            warnings.warn(line, stacklevel=2)

    @property
    def primitives(self) -> int:
        """How many triangles, segments and points there are."""
        return self._scene.primitives

    @property
    def bounds(self) -> Floats:
        """The box around it, (2, 3), m: the lowest corner and the highest."""
        return self._scene.bounds

    @property
    def warnings(self) -> List[str]:
        """What was left out or changed when it was read or made, a line each. Python warns of each once, too."""
        return self._scene.warnings

    def __copy__(self) -> "Scene":
        return self

    def __deepcopy__(self, _memo: Any) -> "Scene":
        return self

    def __reduce__(self) -> Any:
        """Another process reads it anew."""
        if self._source is None:
            raise TypeError("a scene of arrays cannot be pickled: send the arrays, and make it there")
        return _scene_of, self._source

    def __repr__(self) -> str:
        low, high = self.bounds
        sides = " x ".join(f"{side:.3g}" for side in high - low)
        return f"<hl.Scene of {self.primitives} primitives, {sides} m>"


@dataclass(frozen=True)
class Settings:
    """What a finger and its surfaces are like.

    None leaves a quantity of the surface as the scene has it; a number is for all surfaces, and has a narrower range
    than a scene's own, which goes to 1e9. Numbers are checked when the settings are used: InvalidValueError.
    """

    radius: float = 0.002  #: of the proxy, m, 1e-12 to 1e9
    spring: float = 1000.0  #: N/m, 1e-9 to 1e9: force = spring * (target - finger)
    period: float = 0.001  #: s, 1e-15 to 1e15: between two steps of Fingers; trace takes it from its paths
    smooth: Optional[bool] = None  #: shading by normals
    stiffness: Optional[float] = None  #: 0..1: the part of the spring that the surface uses
    static_friction: Optional[float] = None  #: mu_s, 0..10; below mu_d it counts as mu_d
    dynamic_friction: Optional[float] = None  #: mu_d, 0..10
    viscosity: Optional[float] = None  #: N s/m, 0..1000
    stribeck: Optional[float] = None  #: m/s, 0..1e9
    presliding: Optional[float] = None  #: N/m, 0..1e9
    adhesion: Optional[float] = None  #: N, 0..100
    compliance: Optional[float] = None  #: m/N, 0..1: a spring of 1 / compliance in series with the servo's
    strength: Optional[float] = None  #: N, 0..100: pressed harder, a surface is pierced; 0: never

    def _native(self) -> _hl.BatchSettings:
        if self.smooth not in (None, False, True):
            raise InvalidValueError("smooth must be True, False or None")
        native = _hl.BatchSettings(
            arguments.number(self.radius, "radius"),
            arguments.number(self.spring, "spring"),
            arguments.number(self.period, "period"),
            None if self.smooth is None else bool(self.smooth),
        )
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name in SURFACE and value is not None:
                native.set_surface(SURFACE[field.name], arguments.number(value, field.name))
        return native


class Felt(NamedTuple):
    """What fingers feel: one row for each finger, or for each sample of a path."""

    proxy: Floats  #: (..., 3), m: the centre of the proxy
    force: Floats  #: (..., 3), N: on the hand, of the spring
    contacts: npt.NDArray[np.int32]  #: (...): how many planes hold the proxy, 0..3
    injected: Floats  #: (...), J: what the tick added to the spring's energy; below 0: took away


class Fingers:
    """Fingers that are stepped together, each with a proxy of its own. They do not feel each other.

    `count`: how many. A set of fingers steps one step at a time; of two threads the second waits.
    """

    def __init__(self, scene: Scene, count: int, settings: Optional[Settings] = None) -> None:
        self._count = arguments.whole(count, "count", most=2**60)
        self._fingers = _hl.BatchFingers(_native_scene(scene), _native_settings(settings), self._count)

    def __len__(self) -> int:
        return self._count

    def __reduce__(self) -> Any:
        raise TypeError("fingers cannot be copied or pickled: make others, and step them the same way")

    def step(self, positions: npt.ArrayLike, threads: int = 0) -> Felt:
        """Moves each finger to its position, (len, 3), and its proxy follows: one tick.

        The first step, and the one after a reset, begins a proxy where the finger is, or near it where the finger is
        within something. `threads`: how many to use, 0: all.
        """
        return Felt(*self._fingers.step(arguments.floats(positions, "positions"), arguments.threads(threads)))

    def reset(self, mask: Optional[npt.ArrayLike] = None) -> None:
        """Those with a mask that is True, (len,) of booleans, begin anew with their next step; None: all."""
        self._fingers.reset(None if mask is None else arguments.booleans(mask, "mask"))


Path = npt.ArrayLike


@overload
def trace(scene: Scene, paths: npt.NDArray[Any], settings: Optional[Settings] = None, threads: int = 0) -> Felt: ...
@overload
def trace(
    scene: Scene, paths: Sequence[npt.NDArray[Any]], settings: Optional[Settings] = None, threads: int = 0
) -> List[Felt]: ...
def trace(scene: Scene, paths: Any, settings: Optional[Settings] = None, threads: int = 0) -> Any:
    """Feels the scene along recorded paths, each by a finger of its own, as the command `hl trace` does.

    A path is an array (n, 4): t, x, y, z, with t that rises by 1e-15 s at least; the proxy begins at its first row.
    `paths`: one path, or (m, n, 4): returns a Felt of arrays (n, ...) or (m, n, ...); or a list of paths of any
    lengths: returns a list of Felt.
    """
    native, threads = _native_settings(settings), arguments.threads(threads)
    if isinstance(paths, (list, tuple)) and all(arguments.dimensions(path) == 2 for path in paths):
        return _trace_list(scene, [arguments.floats(path, "each path") for path in paths], native, threads)
    array = arguments.floats(paths, "paths")
    if array.ndim not in (2, 3) or array.shape[-1] != 4:
        raise InvalidValueError(f"paths must have the shape (n, 4) or (m, n, 4), and has {array.shape}")
    samples = array.reshape(-1, 4)
    length = array.shape[-2]
    ends = [length * (i + 1) for i in range(len(samples) // length if length > 0 else 0)]
    proxy, force, contacts, injected = _hl.trace(_native_scene(scene), native, samples, ends, threads)
    shape = array.shape[:-1]
    return Felt(proxy.reshape(shape + (3,)), force.reshape(shape + (3,)), contacts.reshape(shape), injected.reshape(shape))


def _trace_list(scene: Scene, paths: List[Floats], settings: _hl.BatchSettings, threads: int) -> List[Felt]:
    for path in paths:
        if path.shape[1] != 4:
            raise InvalidValueError(f"each path must have the shape (n, 4), and one has {path.shape}")
    ends = np.cumsum([len(path) for path in paths], dtype=int)
    samples = np.concatenate(paths) if paths else np.empty((0, 4))
    proxy, force, contacts, injected = _hl.trace(_native_scene(scene), settings, samples, ends.tolist(), threads)
    parts = [slice(end - len(path), end) for path, end in zip(paths, ends)]
    return [Felt(proxy[part], force[part], contacts[part], injected[part]) for part in parts]


class Closest(NamedTuple):
    """The nearest points of a scene."""

    point: Floats  #: (n, 3), m: on the surface
    distance: Floats  #: (n,), m
    normal: Floats  #: (n, 3): unit, from the surface to the point asked for
    primitive: npt.NDArray[np.uint64]  #: (n,): its row in the array of triangles; of a file: its number in the model


def closest(scene: Scene, points: npt.ArrayLike, threads: int = 0) -> Closest:
    """Of each of the points, (n, 3) in m, the nearest point of the scene, at any distance."""
    rows = arguments.floats(points, "points")
    rows = rows.reshape(0, 3) if rows.shape == (0,) else rows  # of a list without points
    return Closest(*_hl.closest(_native_scene(scene), rows, arguments.threads(threads)))


def _scene_of(source: str, size: float) -> Scene:
    return Scene(source, size=size)


def _native_scene(scene: Scene) -> _hl.BatchScene:
    if not isinstance(scene, Scene):
        raise InvalidValueError(f"scene must be an hl.Scene, and is {type(scene).__name__}")
    return scene._scene


def _native_settings(settings: Optional[Settings]) -> _hl.BatchSettings:
    if settings is not None and not isinstance(settings, Settings):
        raise InvalidValueError(f"settings must be an hl.Settings, and is {type(settings).__name__}")
    return (settings or Settings())._native()


def _heights_of(heights: Any, spacing: Any, vertical_scale: Any, missing: Any) -> _hl.BatchScene:
    steps = arguments.steps(spacing, 2)
    none = None if missing is None else arguments.number(missing, "missing")
    scale = arguments.number(vertical_scale, "vertical_scale")
    return _hl.BatchScene(arguments.heights(heights), steps, scale, none)


def _volume_of(volume: Any, iso: Any, spacing: Any, missing: Any, below: bool) -> _hl.BatchScene:
    if iso is None:
        raise InvalidValueError("a volume needs an iso value, or several: iso=300.0")
    values = [arguments.number(value, "iso") for value in (iso if np.ndim(iso) > 0 else [iso])]
    none = None if missing is None else arguments.number(missing, "missing")
    return _hl.BatchScene(arguments.volume(volume), arguments.steps(spacing, 3), values, none, bool(below))


def _cloud_of(points: Any, normals: Any, surfels: Any) -> _hl.BatchScene:
    return _hl.BatchScene(
        arguments.floats(points, "points"),
        None if normals is None else arguments.floats(normals, "normals"),
        arguments.reach(surfels),
    )


# What each option of a scene belongs to.
_OPTIONS = {
    "triangles": ("vertices",),
    "normals": ("vertices", "points"),
    "size": ("a file",),
    "iso": ("a volume",),
    "spacing": ("heights", "a volume"),
    "vertical_scale": ("heights",),
    "missing": ("heights", "a volume"),
    "surfels": ("points",),
    "below": ("a volume",),
    "grid": (),
}


# What a scene file says of another file, which a call cannot.
_IN_SCENE_FILES = {
    "iso": '{"objects": [{"volume": {"file": "head.nii.gz", "iso": 300}}]}',
    "below": '{"objects": [{"volume": {"file": "distances.nrrd", "iso": 0, "below": true}}]}',
    "surfels": '{"objects": [{"points": {"file": "scan.ply", "surfels": true}}]}',
    "grid": '{"objects": [{"volume": {"file": "smoke.vdb", "grid": "density"}}]}',
}


def _is_said(value: Any) -> bool:
    return not (value is None or value is False or (isinstance(value, (int, float)) and value == 0))


def _kind_of(made_of: Dict[str, Any], options: Dict[str, Any]) -> str:
    """The one thing that a scene is made of; what belongs to others is refused by its name."""
    kinds = [kind for kind, given in made_of.items() if given is not None]
    if len(kinds) != 1:
        raise InvalidValueError(f"a scene is made of one of {', '.join(made_of)}; this of {' and '.join(kinds) or 'none'}")
    for name, value in options.items():
        needed = _OPTIONS[name]
        said = value is not None if name in ("missing", "iso") else _is_said(value)
        if said and kinds[0] == "a file" and name in _IN_SCENE_FILES:
            raise InvalidValueError(f"{name} of a file belongs into a scene file: {_IN_SCENE_FILES[name]}")
        if said and not needed:
            raise InvalidValueError(f"{name} belongs to a file with several grids, and this scene is made of {kinds[0]}")
        if said and kinds[0] not in needed:
            raise InvalidValueError(f"{name} belongs to {' and '.join(needed)}, and this scene is made of {kinds[0]}")
    return kinds[0]


def _made_of(vertices: Any, triangles: Any, normals: Any) -> _hl.BatchScene:
    if triangles is None:
        raise InvalidValueError("a scene of arrays needs triangles: an array of shape (m, 3)")
    indices = arguments.integers(triangles, "triangles")
    if indices.size == 0:
        indices = np.empty((0, 3), dtype=np.uint32)
    elif indices.min() < 0 or indices.max() > np.iinfo(np.uint32).max:
        raise InvalidValueError("an index names no vertex")
    return _hl.BatchScene(
        arguments.floats(vertices, "vertices"),
        indices.astype(np.uint32),
        None if normals is None else arguments.floats(normals, "normals"),
    )
