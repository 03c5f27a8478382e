"""Dictionaries as dataclasses: values of every type, read back as they were written."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.schema import read_entries
from foamprb.dictionary.tree import Dictionary
from foamprb.errors import InputError


def dictionary(folder: Path, text: str) -> Dictionary:
    (folder / "dictionary").write_text(text)
    return read_dictionary(folder / "dictionary", folder)


@dataclass(frozen=True)
class Values:
    number: float
    vector: tuple[float, float, float]
    whole: int
    switch: bool
    word: str


finite = st.just(0.0) | st.floats(1e-30, 1e30) | st.floats(-1e30, -1e-30)


@given(
    st.builds(
        Values,
        finite,
        st.tuples(finite, finite, finite),
        st.integers(-(10**17), 10**17),
        st.booleans(),
        st.from_regex(r"[A-Za-z_][A-Za-z0-9_:.-]*", fullmatch=True),
    ),
    st.sampled_from([" ", "\n", " // comment; }\n", "/* a\n{ */"]),
)
def test_written_values_are_read_back(
    tmp_path_factory: pytest.TempPathFactory, values: Values, gap: str
) -> None:
    x, y, z = values.vector
    words = [
        "number",
        repr(values.number),
        ";vector",
        f"({x!r}",
        repr(y),
        f"{z!r})",
        ";whole",
        str(values.whole),
    ]
    words += [";switch", "on" if values.switch else "no", ";word", values.word, ";"]
    root = dictionary(tmp_path_factory.getbasetemp(), gap.join(words))
    assert read_entries(Values, root) == values


def test_a_whole_number_has_no_fraction(tmp_path: Path) -> None:
    root = dictionary(tmp_path, "number 1; vector (0 0 0); whole 1.5; switch on; word a;")
    with pytest.raises(InputError, match=r"dictionary, line 1: whole is '1\.5'\. Allowed: an integer\."):
        read_entries(Values, root)
