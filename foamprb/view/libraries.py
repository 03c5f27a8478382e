"""Matplotlib, pyvista and Pillow, which the extra ``foamprb[view]`` installs."""

from __future__ import annotations

from typing import Any

from foamprb import optional

__all__ = ["load"]


def load(module: str) -> Any:
    """Import a module of these libraries.

    Raises
    ------
    InputError
        If the library is not installed; the message names the extra.
    """
    return optional.load(module, "view", "pages, pictures and reports need")
