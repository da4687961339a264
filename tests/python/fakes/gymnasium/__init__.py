"""What hl.gym uses of Gymnasium, with its checks of shapes; for tests only."""
import importlib

import numpy as np

from . import spaces

_registered = {}


class Env:
    np_random = None

    def reset(self, *, seed=None, options=None):
        if seed is not None or self.np_random is None:
            self.np_random = np.random.default_rng(seed)


def register(id, entry_point, max_episode_steps):
    _registered[id] = (entry_point, max_episode_steps)


def make(id, **arguments):
    module, _, name = id.partition(":")
    importlib.import_module(module)
    place, _, kind = _registered[name][0].partition(":")
    return getattr(importlib.import_module(place), kind)(**arguments)
