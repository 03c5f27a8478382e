"""Displays, and the libraries without which VTK cannot draw."""

from __future__ import annotations

import ctypes
import os
import sys
from contextlib import suppress

from foamprb.errors import InputError


def has_display() -> bool:
    """Return whether a window can be shown."""
    return sys.platform in ("darwin", "win32") or any(map(os.environ.get, ("DISPLAY", "WAYLAND_DISPLAY")))


def require_graphics() -> None:
    """Check that VTK can draw; without a display it needs one of two libraries, else it crashes."""
    if has_display():
        return
    for library in ("libEGL.so.1", "libOSMesa.so.8", "libOSMesa.so"):
        with suppress(OSError):
            ctypes.CDLL(library)
            return
    raise InputError("no display and no libEGL: VTK cannot draw. On Debian: apt-get install libegl1.")
