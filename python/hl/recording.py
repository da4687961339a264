"""Recordings and black boxes (*.hlr) as arrays."""

import os
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _hl, arguments

#: What `steps["state"]` counts.
STATES = ("off", "arming", "on", "fault", "waiting")


@dataclass(frozen=True, eq=False)
class Recording:
    """What a recording holds.

    steps: a structured array, one row for each step of the servo, in the device's frame: t (s since the recording
        began), finger and proxy (m), touching, stiffness (0..1), force (N), state (a number of STATES), fault (0:
        none), buttons, work_ns, rotation (of the stylus, a unit quaternion x y z w), spin (rad/s), gripper (rad).
    ticks: one row for each tick: t, finger and target (m, device's frame), proxy (m, world), contacts, touching,
        scene (the number of the scene that was shown), work_ns.
    """

    path: str
    version: str  #: of HL, that made it
    device: str
    servo_rate: float  #: Hz
    proxy_rate: float  #: Hz
    black_box: bool  #: the seconds before a fault; ticks is empty where its scene could not be recorded, or has just changed
    fault: str  #: why, of a black box
    end: str  #: "stopped", or the limit that was reached; "" when the program was killed
    damage: str  #: what is wrong with the end of the file; "" for nothing
    steps: npt.NDArray[Any]
    ticks: npt.NDArray[Any]
    label: str = ""  #: what the device is called, of a server with several; "" for the only one

    @property
    def duration(self) -> float:
        """s, from the first step to the last."""
        return float(np.ptp(self.steps["t"])) if len(self.steps) > 0 else 0.0


def read_recording(path: Union[str, "os.PathLike[str]"]) -> Recording:
    """Reads a file of `hl record`, or a black box. Raises InvalidValueError: it is none, or of another version.

    It is taken as it is written; `hl replay` runs it again and compares.
    """
    read = _hl.Recording(arguments.path(path))
    return Recording(os.fsdecode(path), read.version, read.device, read.servo_rate, read.proxy_rate, read.black_box,
                     read.fault, read.end, read.damage, read.steps, read.ticks,
                     read.label)
