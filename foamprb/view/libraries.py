"""Matplotlib, pyvista and Pillow, which the extra ``foamprb[view]`` installs."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from foamprb.errors import InputError

__all__ = ["load"]


def load(module: str) -> Any:
    """Import a module of these libraries.

    Raises
    ------
    InputError
        If the library is not installed; the message names the extra.
    """
    try:
        return import_module(module)
    except ImportError as error:
        raise InputError(
            f"pages, pictures and reports need {module.partition('.')[0]}: pip install 'foamprb[view]'."
        ) from error
