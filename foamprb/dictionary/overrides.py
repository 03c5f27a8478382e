"""Entries of a dictionary that a Python program replaces."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from foamprb.dictionary.grammar import parse_dictionary
from foamprb.dictionary.tree import Dictionary
from foamprb.errors import InputError, suggestion


def override(root: Dictionary, values: Mapping[str, object]) -> dict[str, str]:
    """Replace or add entries of a dictionary; return their texts.

    Parameters
    ----------
    root
        The dictionary.
    values
        By path, ``"solution/deltaT"``: a number, a bool, a sequence as a list ``( … )``, a mapping as a
        dictionary ``{ … }`` whose entries are merged, or the text of an entry.

    Raises
    ------
    InputError
        If the dictionary of an entry does not exist, or a text is not the value of an entry.
    """
    texts = {path: _text_of(value) for path, value in values.items()}
    for path, text in texts.items():
        *above, key = path.split("/")
        where = root
        for name in above:
            if name not in where.entries:
                what = f"overrides: '{path}': {root.source} has no dictionary '{name}' there"
                raise InputError(f"{what}. {suggestion(name, where.entries)}")
            where = where.entries[name].dictionary()
        entries = parse_dictionary(f"{key} {text}", Path("overrides"), root.source.case).entries
        if list(entries) != [key]:
            raise InputError(f"overrides: '{path}': '{text}' is not the value of one entry.")
        where.add(entries[key].copy(key, where))
    return texts


def _text_of(value: object) -> str:
    """Return a value as a dictionary has it behind the key, with its semicolon."""
    if isinstance(value, Mapping):
        return f"{{ {' '.join(f'{key} {_text_of(part)}' for key, part in value.items())} }}"
    return f"{_word_of(value)};"


def _word_of(value: object) -> str:
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    if isinstance(value, list | tuple | np.ndarray):
        return f"({' '.join(map(_word_of, value))})"
    return str(value)
