"""HL, the haptic library: what a force-feedback device would feel of a 3-D scene.

Offline, for many fingers at once: Scene, Fingers, trace, closest. With a device or a simulated one: connect.
Recorded sessions: read_recording. The calls of hl.h as they are: hl.calls.

SI units everywhere: metres, seconds, newtons.
"""

from . import calls
from ._hl import __version__
from .batch import Closest, Felt, Fingers, Scene, Settings, closest, trace
from .errors import (
    BusyError,
    ConnectError,
    ConnectionLostError,
    Error,
    InvalidOperationError,
    InvalidValueError,
    OutOfMemoryError,
    RefusedError,
)
from .recording import STATES, Recording, read_recording
from .touch import State, Touch, connect

__all__ = [
    "BusyError",
    "Closest",
    "ConnectError",
    "ConnectionLostError",
    "Error",
    "Felt",
    "Fingers",
    "InvalidOperationError",
    "InvalidValueError",
    "OutOfMemoryError",
    "Recording",
    "RefusedError",
    "STATES",
    "Scene",
    "Settings",
    "State",
    "Touch",
    "__version__",
    "calls",
    "closest",
    "connect",
    "read_recording",
    "trace",
]
