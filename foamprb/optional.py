"""Libraries that are installed with an extra of the package."""

from __future__ import annotations

import importlib
from typing import Any

from foamprb.errors import InputError


def load(module: str, extra: str = "view", reason: str = "pictures and reports need") -> Any:
    """Import a module of an extra.

    Parameters
    ----------
    module
        Its full name.
    extra
        Name of the extra in ``pyproject.toml``; by default ``view``: Matplotlib, pyvista and Pillow.
    reason
        Beginning of the message: the subject and ``need`` or ``needs``.

    Raises
    ------
    InputError
        If the module is not installed; the message says how to install it.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        library = module.partition(".")[0]
        raise InputError(
            f"{reason} {library}: pip install 'foamprb[{extra}]', or in a clone pip install '.[{extra}]'."
        ) from error
