"""A model of each kind that is a class and a name in its registry, and nothing else, takes part in a run."""

# ruff: noqa: ARG002, ARG005

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
import pytest
from pipe_case import copy_of_pipe, edit, fates

from foamprb.cli import main
from foamprb.cloud.injection.distribution import DISTRIBUTIONS, Distribution
from foamprb.cloud.injection.models import INJECTIONS, Places
from foamprb.cloud.injection.shapes import SHAPES, Shape
from foamprb.cloud.patches import ESCAPE, INTERACTIONS
from foamprb.cloud.state import set_rest_shape
from foamprb.cloudfunctions.base import CloudFunction, table
from foamprb.cloudfunctions.registry import FUNCTIONS
from foamprb.dictionary.constraints import Positive, Vector3
from foamprb.settings.patches import INTERACTION_MODELS, KindRule


@dataclass(frozen=True)
class RowInjection:
    """Three particles in a row along the axis."""

    first: Vector3
    spacing: Annotated[float, Positive]
    SOI: float = 0.0

    def places(self, flow, random, read):
        x = np.array(self.first) + self.spacing * np.outer(np.arange(3), [1.0, 0.0, 0.0])
        return Places(x, flow.locate(x), np.full(3, self.SOI))


@dataclass(frozen=True)
class TwoSizes(Distribution):
    """Half of the values are small, the others large."""

    small: float
    large: float

    @property
    def limits(self):
        return self.small, self.large

    def quantile(self, share):
        return np.where(share < 0.5, self.small, self.large)


@dataclass(frozen=True)
class Disc(Shape):
    """Discs, flat along the axis of the pipe."""

    thickness: Annotated[float, Positive]

    def form(self, p, random):
        set_rest_shape(p, (self.thickness, 1.0, 1.0))


@dataclass(frozen=True)
class Swallow:
    """The wall lets everything through."""

    depth: float
    code: ClassVar[int] = ESCAPE


@dataclass(frozen=True)
class Count(CloudFunction):
    """The number of writings times a number."""

    arrays: ClassVar = {"samples": table}

    every: int

    def begin(self, cloud):
        return {"samples": np.zeros(1, dtype=np.int64)}

    def write(self, memory, cloud, folder):
        memory["samples"] += self.every
        folder.mkdir(exist_ok=True)
        (folder / "count").write_text(f"{memory['samples'][0]} of {cloud.particles.size}")


@pytest.fixture
def registered(monkeypatch):
    for registry, name, model in (
        (INJECTIONS, "rowInjection", RowInjection),
        (DISTRIBUTIONS, "twoSizes", TwoSizes),
        (SHAPES, "disc", Disc),
        (INTERACTIONS, "swallow", Swallow),
        (FUNCTIONS, "count", Count),
        (INTERACTION_MODELS, "sieve", lambda coefficients: (KindRule("any", Swallow(1.0)),)),
    ):
        monkeypatch.setitem(registry, name, model)


def settings(case, interaction):
    edit(case, r"\$onePoint;", "type rowInjection; first (0 0 0); spacing 1e-5;"
         "sizeDistribution { type twoSizes; twoSizesDistribution { small 2e-6; large 5e-6; } }"
         "shape { type disc; thickness 0.25; }")  # fmt: skip
    edit(case, r"cloudFunctions\s*\{\}", "cloudFunctions { counted { type count; every 40; } }")
    edit(case, r"shape\s+paper;", "shape stokes;")
    edit(case, r"endTime\s+\S+;", "endTime 0.002;")
    edit(case, r"writeInterval\s+\S+;", "writeInterval 0.001;")
    edit(case, r"patchInteractionModel localInteraction;", interaction)


def test_new_models_need_a_class_and_a_name(registered, tmp_path):
    case = copy_of_pipe(tmp_path)
    settings(case, "patchInteractionModel localInteraction;")
    edit(case, r"type\s+stick;", "type swallow; depth 2;")
    assert main(["run", "-case", str(case)]) == 0
    rows = fates(case)[:3]
    np.testing.assert_allclose([float(row["x0"]) for row in rows], [0.0, 1e-5, 2e-5], atol=1e-20)
    assert {float(row["d"]) for row in rows} <= {2e-6, 5e-6}
    # Ca is 1e-4: the shape at rest hardly changes.
    np.testing.assert_allclose([float(row["c"]) / float(row["a"]) for row in rows], 0.25, rtol=1e-2)
    # Both write times are in one stretch of steps, at the end of which functions write.
    counted = (case / "postProcessing/softCloud/counted/count").read_text()
    assert counted.split()[0] == "40"


def test_a_new_patch_interaction_model_finds_its_coefficients(registered, tmp_path, capsys):
    case = copy_of_pipe(tmp_path)
    settings(case, "patchInteractionModel sieve; sieveCoeffs { touching centre; }")
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    out = capsys.readouterr().out
    assert "patchInteractionModel sieve, touching by the centre" in out
    assert out.count(" swallow\n") == 3
