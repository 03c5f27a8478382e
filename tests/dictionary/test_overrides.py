"""Entries that a program replaces."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from foamprb.dictionary.grammar import parse_dictionary
from foamprb.dictionary.overrides import override
from foamprb.errors import InputError

TEXT = "solution { deltaT 1; endTime 2; } subModels { models { a { U0 (0 0 0); SOI 0; } } }"


@pytest.fixture
def root(tmp_path):
    return parse_dictionary(TEXT, Path("settings"), tmp_path)


def test_values_become_the_texts_of_a_dictionary(root):
    values = {
        "solution/deltaT": np.float64(1e-5),
        "solution/transient": True,
        "subModels/models/a/U0": np.array([1.0, 0.5, 0.0]),
        "subModels/models/a": {"SOI": 3, "shape": {"type": "sphere"}},
    }
    texts = override(root, values)
    assert texts["subModels/models/a"] == "{ SOI 3; shape { type sphere; } }"
    found = {
        path: root.at(path).text for path in ("solution/deltaT", "solution/endTime", "solution/transient")
    }
    assert found == {"solution/deltaT": "1e-05", "solution/endTime": "2", "solution/transient": "yes"}
    a = {name: root.at(f"subModels/models/a/{name}").text for name in ("U0", "SOI", "shape/type")}
    assert a == {"U0": "( 1.0 0.5 0.0 )", "SOI": "3", "shape/type": "sphere"}
    assert root.at("solution/deltaT").path == "solution/deltaT"


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        (
            "solutoin/deltaT",
            1,
            r"'solutoin/deltaT': settings has no dictionary 'solutoin' there\. .*'solution'",
        ),
        ("solution/deltaT", "1; endTime 3", "is not the value of one entry"),
        ("solution/deltaT/x", 1, r"solution/deltaT is '1'\. Allowed: a dictionary"),
    ],
)
def test_a_value_that_cannot_be_placed_is_refused(root, path, value, message):
    with pytest.raises(InputError, match=message):
        override(root, {path: value})
