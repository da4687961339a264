"""The calls of hl.h under their own names, with its constants, for the current context.

As in C, but: an error is an exception, at once; calls that take pointers and sizes take arrays; hlGenObjects(n) and
the queries return what they would write. A query of one value returns a number, others a list. Contexts are made by
`hl.connect`, which also polls and takes callbacks. `help(hl.calls.hlFlush)` shows what hl.h says.
"""

from . import _hl

_NAMES = [name for name in dir(_hl.calls) if name.startswith(("hl", "HL_"))]
globals().update({name: getattr(_hl.calls, name) for name in _NAMES})
__all__ = _NAMES
