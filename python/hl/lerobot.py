"""HL's device as a LeRobot teleoperator: its tip moves the robot, and the robot's force is felt. Needs lerobot.

Importing it registers the type "hl". `get_action` gives the tip (m, from where it was at connect), how the stylus
is turned (a unit quaternion), how far its gripper is open (rad) and the buttons.
`send_feedback` takes the force on the robot (N): it is felt as a wall that stands across it and moves with the tip, as
deep inside as the spring needs for that force; so HL's limits of force, of its rate and of energy hold for it too.
A force that is older than `feedback_timeout` is felt no more.
"""

import math
import time
from dataclasses import dataclass
from typing import Any, Dict, Optional

import numpy as np
import numpy.typing as npt
from lerobot.teleoperators import Teleoperator, TeleoperatorConfig

from . import calls
from .errors import Error
from .touch import Touch, connect

_AXES = ("x", "y", "z")
_TURN = ("x", "y", "z", "w")


@TeleoperatorConfig.register_subclass("hl")
@dataclass
class HLTeleoperatorConfig(TeleoperatorConfig):  # type: ignore[misc]
    url: str = "inproc:"  #: as hl.connect takes it
    scale: float = 1.0  #: metres of the robot for one metre of the hand
    force_scale: float = 1.0  #: newtons at the hand for one newton at the robot
    feedback_timeout: float = 0.1  #: s, after which a force ends
    wall_size: float = 0.1  #: m, of the wall at the hand


class HLTeleoperator(Teleoperator):  # type: ignore[misc]
    config_class = HLTeleoperatorConfig
    name = "hl"

    def __init__(self, config: HLTeleoperatorConfig) -> None:
        super().__init__(config)
        self.config = config
        self._touch: Optional[Touch] = None
        self._wall = 0
        self._origin = np.zeros(3)
        self._felt_until = -math.inf
        self._normal: Optional[npt.NDArray[Any]] = None  #: of the wall that is shown

    @property
    def action_features(self) -> Dict[str, type]:
        turn = {f"turn.{part}": float for part in _TURN}
        return {**{f"tip.{axis}": float for axis in _AXES}, **turn, "gripper": float, "buttons": int}

    @property
    def feedback_features(self) -> Dict[str, type]:
        return {f"force.{axis}": float for axis in _AXES}

    @property
    def is_connected(self) -> bool:
        return self._touch is not None

    @property
    def is_calibrated(self) -> bool:
        return True

    def calibrate(self) -> None:
        """Nothing: the server knows its device."""

    def configure(self) -> None:
        """Nothing."""

    def connect(self, calibrate: bool = True) -> None:
        if self._touch is not None:
            raise RuntimeError("the teleoperator is connected already")
        touch = connect(self.config.url, name="lerobot")
        try:
            self._wall = self._define_wall(touch)
            self._origin = touch.state().finger
        except Error:
            touch.close()
            raise
        self._touch = touch

    def disconnect(self) -> None:
        if self._touch is not None:
            self._touch.close()
            self._touch = None

    def get_action(self) -> Dict[str, Any]:
        touch = self._connected()
        if time.monotonic() > self._felt_until > -math.inf:
            self._remove_wall(touch)
        state = touch.state()
        tip = self.config.scale * (state.finger - self._origin)
        turn = {f"turn.{part}": float(state.rotation[i]) for i, part in enumerate(_TURN)}
        place = {f"tip.{axis}": float(tip[i]) for i, axis in enumerate(_AXES)}
        return {**place, **turn, "gripper": state.gripper, "buttons": state.buttons}

    def send_feedback(self, feedback: Dict[str, Any]) -> None:
        touch = self._connected()
        force = self.config.force_scale * np.array([float(feedback[f"force.{axis}"]) for axis in _AXES])
        size = float(np.linalg.norm(force))
        if not math.isfinite(size):
            raise ValueError("a force must be finite")
        if size == 0:
            self._remove_wall(touch)
            return
        self._show_wall(touch, force / size, size)
        self._felt_until = time.monotonic() + self.config.feedback_timeout

    def _connected(self) -> Touch:
        if self._touch is None:
            raise RuntimeError("the teleoperator is not connected; call connect()")
        return self._touch

    def _define_wall(self, touch: Touch) -> int:
        half = self.config.wall_size / 2
        with touch.frame():
            touch.workspace((0.0, 0.0, 0.0), 1.0)
            with touch.define() as wall:
                touch.draw([[-half, -half, 0], [half, -half, 0], [half, half, 0], [-half, half, 0]],
                           [[0, 1, 2], [0, 2, 3]])
        return wall

    def _show_wall(self, touch: Touch, normal: npt.NDArray[Any], size: float) -> None:
        """So that force = K depth normal: the proxy, a radius before the wall, is `depth` before the finger.

        A new wall only touches the proxy, on the side where it shall stay; from there it moves, and pushes. Where a late
        state has put it on the other side of the proxy, it pulls: then it begins anew.
        """
        pulls = float(touch.state().force @ normal) < -0.1 * size
        if self._normal is None or float(normal @ self._normal) <= 0 or pulls:
            self._remove_wall(touch)
            depth = 0.0
        else:
            depth = size / touch.get(calls.HL_SPRING_STIFFNESS) * touch.get(calls.HL_WORKSPACE_SCALE)
        radius = touch.get(calls.HL_PROXY_RADIUS)
        with touch.frame(wait=False):
            touch.place(self._wall, _pose(touch.state().finger + (depth - radius) * normal, normal))
        self._normal = normal

    def _remove_wall(self, touch: Touch) -> None:
        self._felt_until, self._normal = -math.inf, None
        with touch.frame(wait=False):
            touch.clear()


def _pose(origin: npt.NDArray[Any], normal: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """A frame at `origin` whose z axis is `normal`."""
    aside = np.eye(3)[int(np.argmin(np.abs(normal)))]
    x = np.cross(aside, normal)
    x /= np.linalg.norm(x)
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = x, np.cross(normal, x), normal, origin
    return pose
