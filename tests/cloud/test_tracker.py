"""What a loop is made of by default."""

from __future__ import annotations

import re
from pathlib import Path

import numba

from foamprb.cloud.block import Medium
from foamprb.cloud.tracker import Models, Tracker
from foamprb.flow.meshflow import MeshFlow


def test_the_tolerance_is_the_one_that_the_manual_tells():
    page = Path(__file__).parents[2] / "docs/settings.md"
    told = re.search(
        r"^\| `integrationSchemes/tolerance` \| 1 \| ([\d.e-]+) \|", page.read_text(), re.MULTILINE
    )
    assert Models().tolerance == float(told[1])


def test_integers_in_the_medium_are_numbers_as_any():
    """Else the loop would be compiled again, without traces of its stages."""

    def kind(*numbers):
        models = Models(integrator="stokes")
        tracker = Tracker(
            models, MeshFlow.kernels, Medium(*numbers), [], 1e-3, 0.0, shaped=False, tense=False
        )
        return numba.typeof(tracker.medium)

    assert kind(1, 1000, (0, 0, -10)) == kind(1.0, 1000.0, (0.0, 0.0, -10.0))
