"""What users give: taken as C++ wants it, or refused by an InvalidValueError, whose line says what to give."""

import contextlib
import json
import operator
import os
from typing import Any, List, Union

import numpy as np
import numpy.typing as npt

from .errors import InvalidValueError

Floats = npt.NDArray[np.float64]

_MOST_THREADS = 2**20  # more than any machine has; hl uses no more than the machine's
_LEAST_STEP, _MOST_STEP = 1e-12, 1e9  # m, as in scene files


def number(value: Any, name: str) -> float:
    """A text is none, although float() would read it."""
    try:
        if not isinstance(value, (str, bytes, bytearray)):
            return float(value)
    except (TypeError, ValueError, OverflowError):
        pass
    raise InvalidValueError(f"{name} must be a number, and is {_shown(value)}")


def whole(value: Any, name: str, least: int = 0, most: int = 2**32 - 1) -> int:
    try:
        result = operator.index(value)
    except TypeError:
        raise InvalidValueError(f"{name} must be a whole number, and is {_shown(value)}") from None
    if result < least:
        requirement = "not be negative" if least == 0 else f"be {least} or more"
        raise InvalidValueError(f"{name} must {requirement}, and is {result}")
    if result > most:
        raise InvalidValueError(f"{name} must be {most} or less, and is {result}")
    return result


def threads(value: Any) -> int:
    return min(whole(value, "threads", most=2**1000), _MOST_THREADS)


def floats(numbers: Any, name: str) -> Floats:
    try:
        array = np.asarray(numbers)
        if array.dtype.kind in "fiubO":
            return np.asarray(array, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise InvalidValueError(f"{name} must be numbers: {error}") from None
    raise InvalidValueError(f"{name} must be numbers, and are {array.dtype}")


def heights(samples: Any) -> npt.NDArray[Any]:
    """Of two dimensions, as grid()."""
    return grid(samples, 2, "heights", "two rows and columns")


def implicit(solid: Any) -> str:
    """An implicit surface as JSON; a str is taken as it is."""
    if isinstance(solid, str):
        return solid
    try:
        return json.dumps(solid, default=_plain)
    except (TypeError, ValueError, RecursionError) as error:
        raise InvalidValueError(f"an implicit surface is a dict, as in a scene file: {error}") from None


def volume(samples: Any) -> npt.NDArray[Any]:
    """Of three dimensions, as grid()."""
    return grid(samples, 3, "volume", "two samples along each of three axes")


def grid(samples: Any, axes: int, name: str, least: str) -> npt.NDArray[Any]:
    """In C order and the machine's order of bytes: int16, uint16, or else float32, in which what is beyond its range is
    infinite, as a sample that is missing is."""
    try:
        array = np.asarray(samples)
    except ValueError as error:
        raise InvalidValueError(f"{name} must be numbers: {error}") from None
    if array.dtype.kind not in "fiub":
        raise InvalidValueError(f"{name} must be numbers, and are {array.dtype}")
    if array.ndim != axes or min(array.shape) < 2:
        raise InvalidValueError(f"{name} must have {least} or more, and have the shape {array.shape}")
    kind = array.dtype.newbyteorder("=")
    with np.errstate(over="ignore"):
        return np.ascontiguousarray(array, dtype=kind if kind in (np.int16, np.uint16) else np.float32)


def steps(spacing: Any, axes: int) -> List[float]:
    """One number for all axes, or one for each."""
    several = [spacing] * axes if np.ndim(spacing) == 0 else list(spacing)
    if len(several) != axes:
        raise InvalidValueError(f"spacing must be one number or {axes}, and has {len(several)}")
    lengths = [number(step, "spacing") for step in several]
    for length in lengths:
        if not _LEAST_STEP <= length <= _MOST_STEP:
            raise InvalidValueError(f"spacing must be from 1e-12 to 1e9 m along each axis, and is {length:g}")
    return lengths


def reach(surfels: Any) -> float:
    """Of True the usual one, of False none: points."""
    if isinstance(surfels, (bool, np.bool_)):
        return 0.75 if surfels else 0.0
    return number(surfels, "surfels")


def dimensions(numbers: Any) -> int:
    """Of nested lists whose lengths differ: 2, so that they are refused as an array."""
    try:
        return int(np.ndim(numbers))
    except ValueError:
        return 2


def integers(numbers: Any, name: str) -> npt.NDArray[Any]:
    """Of any shape; an empty one of any type."""
    try:
        array = np.asarray(numbers)
    except ValueError as error:
        raise InvalidValueError(f"{name} must be integers: {error}") from None
    if array.dtype == object:
        with contextlib.suppress(TypeError, OverflowError):  # else it is refused as objects
            array = np.array([operator.index(one) for one in array.flat], dtype=np.int64).reshape(array.shape)
    if array.size > 0 and not np.issubdtype(array.dtype, np.integer):
        raise InvalidValueError(f"{name} must be integers, and are {array.dtype}")
    return array


def booleans(values: Any, name: str) -> npt.NDArray[np.bool_]:
    """Numbers are refused: a list of indices would be taken for a mask."""
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise InvalidValueError(f"{name} must be booleans: {error}") from None
    if array.size > 0 and array.dtype != np.bool_:
        raise InvalidValueError(f"{name} must be booleans, and are {array.dtype}")
    return array.astype(np.bool_)


def path(source: Union[str, bytes, "os.PathLike[Any]"]) -> bytes:
    """The name of a file as the system has it, which need not be Unicode."""
    name = os.fsencode(source)
    if b"\0" in name:
        raise InvalidValueError("a name must not have a zero in it")
    return name


def _plain(value: Any) -> Any:
    """Of NumPy's numbers and arrays, which JSON does not know, Python's own."""
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    raise TypeError(f"{_shown(value)} is no number, text, list or dict")


def _shown(value: Any) -> str:
    text = repr(value) if isinstance(value, (int, float, str, bytes, type(None))) else type(value).__name__
    return text if len(text) <= 60 else text[:57] + "..."
