"""A Gymnasium environment: press on a surface with a given force, at a given place. Needs the package gymnasium.

    gymnasium.make("hl.gym:hl/Press-v0", scene="teapot", size=0.1)

One environment computes in some microseconds a step; many at once are `hl.Fingers`.
"""

from typing import Any, Dict, Optional, Tuple, Union

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from .batch import Fingers, Scene, Settings, closest

Floats = npt.NDArray[np.float64]


class PressEnv(gymnasium.Env):  # type: ignore[misc]
    """Moves one finger so that it presses with `force` on a place that is drawn at random at each reset: where the
    proxy touches the surface there.

    Action (3,), -1..1: the way of the finger in this step, in parts of `reach`.
    Observation (12,): the place less the proxy, the finger less the proxy, the normal at the place (unit), and the
    force, all in the world frame; lengths in parts of the scene's size, the force in parts of `force`.
    Reward: 0 where both are as wanted, else below: minus the distance, and minus the difference of force.
    An episode ends by gymnasium's limit of steps only.

    scene: a Scene, or what makes one. size: m, of its largest side. force: N. reach: m in a step.
    """

    metadata = {"render_modes": []}  # type: ignore[var-annotated]

    def __init__(
        self,
        scene: Union[Scene, str] = "teapot",
        size: float = 0.1,
        force: float = 1.0,
        reach: float = 0.002,
        settings: Optional[Settings] = None,
    ) -> None:
        self._scene = scene if isinstance(scene, Scene) else Scene(scene, size=size)
        settings = settings or Settings()
        self._radius = settings.radius
        self._fingers = Fingers(self._scene, 1, settings)
        self._force, self._reach = force, reach
        low, high = self._scene.bounds
        self._middle, self._size = (low + high) / 2, float(np.max(high - low))
        self._finger = self._proxy = self._felt = self._place = self._normal = np.zeros(3)
        self.action_space = spaces.Box(-1.0, 1.0, (3,), dtype=np.float64)
        self.observation_space = spaces.Box(-np.inf, np.inf, (12,), dtype=np.float64)

    def reset(
        self, *, seed: Optional[int] = None, options: Optional[Dict[str, Any]] = None
    ) -> Tuple[Floats, Dict[str, Any]]:
        super().reset(seed=seed)
        direction = self.np_random.normal(size=3)
        outside = self._middle + self._size * direction / np.linalg.norm(direction)
        nearest = closest(self._scene, [outside], threads=1)
        self._normal = nearest.normal[0]
        self._place = nearest.point[0] + self._radius * self._normal
        self._fingers.reset()
        self._move(self._place + 0.1 * self._size * self._normal)
        return self._observation(), {"place": self._place.copy()}

    def step(self, action: npt.ArrayLike) -> Tuple[Floats, float, bool, bool, Dict[str, Any]]:
        self._move(self._finger + self._reach * np.clip(np.asarray(action, dtype=np.float64), -1.0, 1.0))
        distance = float(np.linalg.norm(self._place - self._proxy)) / self._size
        difference = abs(float(np.linalg.norm(self._felt)) - self._force) / self._force
        info = {"finger": self._finger.copy(), "proxy": self._proxy.copy(), "force": self._felt.copy()}
        return self._observation(), -distance - difference, False, False, info

    def _move(self, finger: Floats) -> None:
        felt = self._fingers.step([finger], threads=1)
        self._finger, self._proxy, self._felt = finger, felt.proxy[0], felt.force[0]

    def _observation(self) -> Floats:
        return np.concatenate([
            (self._place - self._proxy) / self._size,
            (self._finger - self._proxy) / self._size,
            self._normal,
            self._felt / self._force,
        ])


gymnasium.register(id="hl/Press-v0", entry_point="hl.gym:PressEnv", max_episode_steps=500)
