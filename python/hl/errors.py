"""What HL's calls raise. Every error is an `Error`, whose text is HL's one line; `code` is the number that hl.h has."""

from typing import Dict, Type


class Error(Exception):
    """An error of HL."""

    def __init__(self, text: str, code: int = 0) -> None:
        super().__init__(text)
        self.code = code


class InvalidValueError(Error, ValueError):
    """An argument that a call does not take, or a file that cannot be read (HL_INVALID_VALUE, HL_INVALID_ENUM)."""


class InvalidOperationError(Error, RuntimeError):
    """Not now (HL_INVALID_OPERATION, HL_STACK_OVERFLOW, HL_STACK_UNDERFLOW)."""


class OutOfMemoryError(Error, MemoryError):
    """HL_OUT_OF_MEMORY."""


class ConnectError(Error, ConnectionError):
    """No server answers, or it refuses (hl.connect)."""


class ConnectionLostError(Error, ConnectionError):
    """The conversation has ended (HL_CONNECTION_LOST)."""


class RefusedError(Error, RuntimeError):
    """The server has refused a frame or a setting, which changed nothing there (HL_REFUSED)."""


class BusyError(Error, RuntimeError):
    """Too much is on its way to the server: the frame waits (HL_BUSY)."""


_CLASSES: Dict[int, Type[Error]] = {
    0x0500: InvalidValueError,
    0x0501: InvalidValueError,
    0x0502: InvalidOperationError,
    0x0503: InvalidOperationError,
    0x0504: InvalidOperationError,
    0x0505: OutOfMemoryError,
    0x48001: ConnectError,
    0x48002: ConnectionLostError,
    0x48003: RefusedError,
    0x48004: BusyError,
}


def make(code: int, text: str) -> Error:
    """The exception for an error of hl.h."""
    return _CLASSES.get(code, Error)(text, code)
