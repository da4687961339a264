"""Many fingers, paths and points over one scene: without a server, a device or a clock.

Lengths are metres, forces newtons, times seconds, all in the world frame. Every finger has the same bits as if it were
alone, whatever the number of threads. Other threads of Python run while a call computes.
"""

import os
from dataclasses import dataclass, fields
from typing import Any, List, NamedTuple, Optional, Sequence, Tuple, Union, overload

import numpy as np
import numpy.typing as npt

from . import _hl
from .errors import InvalidValueError

Floats = npt.NDArray[np.float64]

# The fields of Settings that are a quantity of the surface: their constant in hl.h.
SURFACE = {
    "stiffness": _hl.calls.HL_STIFFNESS,
    "static_friction": _hl.calls.HL_STATIC_FRICTION,
    "dynamic_friction": _hl.calls.HL_DYNAMIC_FRICTION,
    "viscosity": _hl.calls.HL_VISCOSITY,
    "stribeck": _hl.calls.HL_STRIBECK,
    "presliding": _hl.calls.HL_PRESLIDING,
    "adhesion": _hl.calls.HL_ADHESION,
}


class Scene:
    """What can be touched; immutable. May be used by several threads at once.

    Scene(source, size=0.0): a model file, a scene file (*.hl.json), or a built-in scene by its name ("teapot",
        "terrain:100000"). `size`: metres of its largest side; 0: as it is, one unit of the file is a metre. Files are
        read in a child process without rights.
    Scene(vertices, triangles, normals=None): arrays (n, 3) in m, (m, 3) of integers, (n, 3). `normals` are for smooth
        shading. Degenerate triangles are left out.

    Raises InvalidValueError: there is no such file, or nothing in it can be touched.
    """

    @overload
    def __init__(self, source: Union[str, "os.PathLike[str]"], *, size: float = 0.0) -> None: ...
    @overload
    def __init__(
        self, source: npt.ArrayLike, triangles: npt.ArrayLike, normals: Optional[npt.ArrayLike] = None
    ) -> None: ...
    def __init__(self, source: Any, triangles: Any = None, normals: Any = None, *, size: float = 0.0) -> None:
        if isinstance(source, (str, os.PathLike)):
            if triangles is not None or normals is not None:
                raise InvalidValueError("a scene is made of a file or of arrays, not of both")
            self._source: Any = (os.fspath(source), size)
            self._scene = _hl.BatchScene(os.fspath(source), float(size))
        else:
            if triangles is None:
                raise InvalidValueError("a scene of arrays needs triangles: an array of shape (m, 3)")
            if size != 0:
                raise InvalidValueError("size is for files; scale the vertices")
            self._source = None
            self._scene = _hl.BatchScene(
                _floats(source, "vertices"),
                _indices(triangles),
                None if normals is None else _floats(normals, "normals"),
            )

    @property
    def primitives(self) -> int:
        """How many triangles, segments and points there are."""
        return self._scene.primitives

    @property
    def bounds(self) -> Floats:
        """The box around it, (2, 3), m: the lowest corner and the highest."""
        return self._scene.bounds

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

    None leaves a quantity of the surface as the scene has it; a number is for all surfaces.
    """

    radius: float = 0.002  #: of the proxy, m, > 0
    spring: float = 1000.0  #: N/m, > 0: force = spring * (target - finger)
    period: float = 0.001  #: s, > 0: between two steps of Fingers; trace takes it from its paths
    smooth: Optional[bool] = None  #: shading by normals
    stiffness: Optional[float] = None  #: 0..1: the part of the spring that the surface uses
    static_friction: Optional[float] = None  #: mu_s >= 0
    dynamic_friction: Optional[float] = None  #: mu_d >= 0
    viscosity: Optional[float] = None  #: N s/m, >= 0
    stribeck: Optional[float] = None  #: m/s, >= 0
    presliding: Optional[float] = None  #: N/m, >= 0
    adhesion: Optional[float] = None  #: N, >= 0

    def _native(self) -> _hl.BatchSettings:
        native = _hl.BatchSettings(self.radius, self.spring, self.period, self.smooth)
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name in SURFACE and value is not None:
                native.set_surface(SURFACE[field.name], value)
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
        if count < 0:
            raise InvalidValueError("count must not be negative")
        self._count = count
        self._fingers = _hl.BatchFingers(_native_scene(scene), (settings or Settings())._native(), count)

    def __len__(self) -> int:
        return self._count

    def step(self, positions: npt.ArrayLike, threads: int = 0) -> Felt:
        """Moves each finger to its position, (len, 3), and its proxy follows: one tick.

        The first step, and the one after a reset, begins a proxy where the finger is, or near it where the finger is
        within something. `threads`: how many to use, 0: all.
        """
        return Felt(*self._fingers.step(_floats(positions, "positions"), threads))

    def reset(self, mask: Optional[npt.ArrayLike] = None) -> None:
        """Those with a mask that is true, (len,), begin anew with their next step; None: all."""
        self._fingers.reset(None if mask is None else np.asarray(mask))


Path = npt.ArrayLike


@overload
def trace(scene: Scene, paths: npt.NDArray[Any], settings: Optional[Settings] = None, threads: int = 0) -> Felt: ...
@overload
def trace(
    scene: Scene, paths: Sequence[npt.NDArray[Any]], settings: Optional[Settings] = None, threads: int = 0
) -> List[Felt]: ...
def trace(scene: Scene, paths: Any, settings: Optional[Settings] = None, threads: int = 0) -> Any:
    """Feels the scene along recorded paths, each by a finger of its own, as the command `hl trace` does.

    A path is an array (n, 4): t, x, y, z, with rising t; the proxy begins at its first row.
    `paths`: one path, or (m, n, 4): returns a Felt of arrays (n, ...) or (m, n, ...); or a list of paths of any
    lengths: returns a list of Felt.
    """
    native = (settings or Settings())._native()
    if isinstance(paths, (list, tuple)) and all(np.ndim(path) == 2 for path in paths):
        return _trace_list(scene, [_floats(path, "paths") for path in paths], native, threads)
    array = _floats(paths, "paths")
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
    distance: Floats  #: (n,), m; infinite where there is nothing
    normal: Floats  #: (n, 3): unit, from the surface to the point asked for
    primitive: npt.NDArray[np.uint64]  #: (n,): its number in the model


def closest(scene: Scene, points: npt.ArrayLike, threads: int = 0) -> Closest:
    """Of each of the points, (n, 3) in m, the nearest point of the scene, at any distance."""
    return Closest(*_hl.closest(_native_scene(scene), _floats(points, "points"), threads))


def _scene_of(source: str, size: float) -> Scene:
    return Scene(source, size=size)


def _native_scene(scene: Scene) -> _hl.BatchScene:
    if not isinstance(scene, Scene):
        raise InvalidValueError(f"scene must be an hl.Scene, and is {type(scene).__name__}")
    return scene._scene


def _floats(numbers: npt.ArrayLike, name: str) -> Floats:
    try:
        return np.asarray(numbers, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InvalidValueError(f"{name} must be numbers: {error}") from None


def _indices(triangles: npt.ArrayLike) -> npt.NDArray[np.uint32]:
    array = np.asarray(triangles)
    if array.size == 0:
        return np.empty((0, 3), dtype=np.uint32)
    if not np.issubdtype(array.dtype, np.integer):
        raise InvalidValueError(f"triangles must be integers, and are {array.dtype}")
    if array.min() < 0 or array.max() > np.iinfo(np.uint32).max:
        raise InvalidValueError("an index names no vertex")
    return array.astype(np.uint32)
