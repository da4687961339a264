"""What hl.lerobot uses of LeRobot: its abstract classes; for tests only."""
import abc
from dataclasses import dataclass
from typing import Optional


@dataclass
class TeleoperatorConfig:
    id: Optional[str] = None
    known = {}

    @classmethod
    def register_subclass(cls, name):
        def keep(kind):
            cls.known[name] = kind
            return kind

        return keep


class Teleoperator(abc.ABC):
    def __init__(self, config):
        self.id = config.id

    action_features = abc.abstractproperty()
    feedback_features = abc.abstractproperty()
    is_connected = abc.abstractproperty()
    is_calibrated = abc.abstractproperty()
    connect = abc.abstractmethod(lambda self: None)
    calibrate = abc.abstractmethod(lambda self: None)
    configure = abc.abstractmethod(lambda self: None)
    get_action = abc.abstractmethod(lambda self: None)
    send_feedback = abc.abstractmethod(lambda self: None)
    disconnect = abc.abstractmethod(lambda self: None)
