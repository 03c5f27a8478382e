"""The rows of a block: declared once, from which all else follows."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, NamedTuple

import numpy as np
import pytest
from small_program import renamed

from foamprb.cloud import measures, viscosity
from foamprb.cloud.adhesion import BondRows
from foamprb.cloud.block import Rows, at, idle_lanes, load_particle, new_scratch, save_particle
from foamprb.cloud.integrators import rosenbrock, stokes
from foamprb.cloud.integrators.adaptive import StepRows, during
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.layout import (
    _FIRST,
    FURTHER,
    IDENTITY,
    LANES,
    MOST_TIMES,
    Row,
    end,
    layout,
    offsets,
    rows_of,
    text_of,
)  # fmt: skip
from foamprb.cloud.needs import NeededRows
from foamprb.cloud.state import CHANGING, VARIABLES, Particles, empty
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.cloud.surroundings.brownian import BrownianMotion, BrownianRows
from foamprb.cloud.surroundings.dispersion import EddyRows
from foamprb.cloud.surroundings.fates import FateRows
from foamprb.cloud.surroundings.faxen import FaxenRows
from foamprb.cloud.surroundings.largest import LargestRows
from foamprb.cloud.surroundings.memory import MemoryRows, rows_for
from foamprb.cloud.surroundings.quadratic import QuadraticRows, SecondRows
from foamprb.cloud.surroundings.registry import _placed, numbers_of
from foamprb.cloud.surroundings.rotating_frames import FrameRows
from foamprb.cloud.surroundings.swimming import SwimmerRows, Swimming
from foamprb.cloud.surroundings.wall_lift import WallLift, WallRows
from foamprb.errors import InputError
from foamprb.flow.base import Patch

PARTS = {
    "paper": (at, during),
    "rosenbrock": (at, during, rosenbrock.work),
    "stokes": (at, during, stokes.work),
    "measures": (at, measures.result),
}


class ExtraRows(NamedTuple):
    """Rows that an integrator might declare for itself."""

    place: Annotated[int, Row(3, "m", "position of injection", 2.0, of="x0")]
    ready: Annotated[int, Row(1, "", "1 where Ca has changed")]
    number: Annotated[int, Row(1, "1", "capillary number", of="Ca", saved="ready")]
    radius: Annotated[int, Row(1, "m", "radius", of="R", saved=True)]
    rest: Annotated[int, Row(9, "1", "shape at rest", IDENTITY, of="F0")]


BASE = layout(at)
load, save = (
    renamed(function, load_rows=BASE.load, save_rows=BASE.save) for function in (load_particle, save_particle)
)
"""Copy a particle into a lane and back."""

RESERVED = [
    Rows, StepRows, stokes.RelaxationRows, rosenbrock.StiffnessRows, LargestRows, viscosity.ViscosityRows,
    viscosity.FieldRows, viscosity.MixtureRows, QuadraticRows, SecondRows, FaxenRows, WallRows,
    BrownianRows, SwimmerRows, EddyRows, FrameRows, FateRows, BondRows, MemoryRows, rows_for(MOST_TIMES),
    NeededRows,
]  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Wind(Surrounding):
    """A model without reserved places."""

    a: float
    b: float

    def coefficients(self, _patches):
        return self.a, (self.b, self.a)


class Breeze(Wind):
    """Another one."""


class Table(Wind):
    """One with an array, as wallLift has one."""

    def coefficients(self, _patches):
        return self.a, np.array([self.b, self.a, self.b])


Table.__name__ = "Swimming"


def particles(n=2):
    """Particles with numbers of no meaning in every array, all of them different."""
    random = np.random.default_rng(3)
    p = empty(n)
    for array in p:
        array[:] = random.random(array.shape) if array.dtype.kind == "f" else random.permutation(n)
    return p


@pytest.mark.parametrize("name", PARTS)
def test_rows_of_a_block_do_not_overlap(name):
    parts = PARTS[name]
    taken = [
        first + c
        for part in parts
        for first, row in zip(part, rows_of(type(part)).values(), strict=True)
        for c in range(row.components)
    ]
    rows = INTEGRATORS[name].layout.rows if name in INTEGRATORS else layout(*parts).rows
    assert len(set(taken)) == len(taken)
    assert max(taken) == rows - 1


def test_reserved_rooms_do_not_overlap_and_every_declaration_fits():
    rooms = sorted({(first, first + size) for first, size in _FIRST.values()})
    assert rooms[0][0] == 0
    assert rooms[-1][1] == FURTHER
    for (_, last), (first, _) in pairwise(rooms):
        assert last <= first
    assert {declaration.__name__ for declaration in RESERVED} == set(_FIRST)
    for declaration in RESERVED:
        first, size = _FIRST[declaration.__name__]
        at_first = offsets(declaration)
        assert first == at_first[0]
        assert end(at_first) <= first + size


def test_declaration_that_does_not_fit_its_room_is_an_error(monkeypatch):
    monkeypatch.setitem(_FIRST, "ExtraRows", (0, 14))
    assert offsets(ExtraRows).place >= FURTHER
    monkeypatch.setattr(ExtraRows, "__module__", "foamprb.example")
    with pytest.raises(ValueError, match="ExtraRows has 15 rows, and room for 14"):
        offsets(ExtraRows)


def test_coefficients_are_read_from_flat_numbers():
    """Tuples in tuples, seeds and an array come back as they were, wherever their numbers begin."""
    values = 1.5, (2.5, (3.5, 4.5), ()), np.uint64(2**32 - 1), (np.arange(3.0),), -0.5
    for first in (0, 4):
        own, all_numbers = [], [7.0] * 20
        text = text_of(values, first, own, all_numbers)
        assert len(own) == 8
        all_numbers[first : first + 8] = own
        numbers = np.array(all_numbers)
        found = eval(text, {"numbers": numbers, "np": np})
        a, b, seed, (array,), c = found
        assert (a, b, c) == (values[0], values[1], values[4])
        assert (seed, type(seed)) == (values[2], np.uint64)
        np.testing.assert_array_equal(array, [0.0, 1.0, 2.0])


def test_coefficients_of_models_lie_side_by_side():
    """Each model reads its own numbers, whatever models there are beside it."""
    walls = (Patch("floor", "wall"), Patch("inlet", "patch"))
    models = BrownianMotion(T=300.0, seed=5), Swimming(speed=2.0, seed=7), WallLift(patches=("floor",))
    further = Wind(a=1.0, b=2.0), Breeze(a=3.0, b=4.0), Table(a=5.0, b=6.0)
    for chosen in ((*models, *further), models[::-1], further[::-1], models[1:2]):
        texts, numbers = _placed(chosen, walls)
        for model, text in zip(chosen, texts, strict=True):
            found = eval(text, {"numbers": numbers, "np": np})
            for one, other in zip(found, model.coefficients(walls), strict=True):
                np.testing.assert_array_equal(one, other)


def test_too_many_coefficients_are_an_error():
    @dataclass(frozen=True, kw_only=True)
    class Storm(Surrounding):
        def coefficients(self, _patches):
            return (1.0,) * 65

    with pytest.raises(InputError, match="Storm has 65 coefficients, which are too many"):
        numbers_of((Storm(),), ())


def test_rows_of_every_integrator_are_looked_at():
    assert set(INTEGRATORS) <= set(PARTS)


def test_rows_are_declared_as_the_arrays_of_the_cloud_are():
    """Of the same shape, and in the same unit, as those that they are loaded from and saved to."""
    for row in rows_of(Rows).values():
        if row.of:
            variable = VARIABLES[row.of]
            assert (row.components, row.unit) == (int(np.prod(variable.shape, dtype=int)), variable.unit)
        else:
            assert not row.saved


@pytest.mark.parametrize("end_of_run", [True, False])
def test_what_changes_in_the_loop_is_saved_and_nothing_else(end_of_run):
    p, scratch = particles(), new_scratch(BASE)
    scratch.block[:] = 0.0
    load(p, 1, scratch, 5)
    scratch.block[:] += 1.0
    scratch.host[:] += 7
    for numbers in (scratch.reason, scratch.patch):
        numbers[:] += 7 * end_of_run
    scratch.status[5] += end_of_run
    scratch.block[at.mirrored * LANES + 5] = float(end_of_run)
    before = Particles(*(array.copy() for array in p))
    save(p, 1, scratch, 5)
    # F₀ is that of a mirror image only, a reason and a patch belong to the end, others to loops and models.
    seldom = {name for name, v in VARIABLES.items() if v.optional}
    seldom |= {"demanding", "discount", "largest", "curved"}
    seldom |= set() if end_of_run else {"F0", "status", "reason", "patch"}
    for name, old, new in zip(Particles._fields, before, p, strict=True):
        np.testing.assert_array_equal(new[0], old[0], err_msg=name)
        # Arrays of the memory have no columns here.
        changed = np.size(new[1]) > 0 and (new[1] != old[1]).all()
        assert changed == (name in set(CHANGING) - seldom), name


def test_what_is_loaded_comes_back_where_it_was():
    p = particles()
    saved = Particles(*(array.copy() for array in p))
    scratch = new_scratch(BASE)
    for lane, k in ((0, 1), (LANES - 1, 0)):
        load(p, k, scratch, lane)
        scratch.block[at.mirrored * LANES + lane] = 1.0
        save(p, k, scratch, lane)
    for name, old, new in zip(Particles._fields, saved, p, strict=True):
        np.testing.assert_array_equal(new, old, err_msg=name)


def test_a_row_that_is_declared_needs_nothing_else():
    """Its place, its initial value, loading and saving, alone or when a condition holds."""
    extra = offsets(ExtraRows)
    own = layout(at, extra)
    assert extra.place >= FURTHER
    assert own.rows == extra.place + 15
    assert own.rows == end(extra)
    block = np.full(own.rows * LANES, np.nan)
    idle_lanes(block, own.initial, 1.0)
    rows = block.reshape(own.rows, LANES)
    assert (rows[extra.place : extra.ready] == 2.0).all()
    assert (rows[extra.rest :].T == IDENTITY).all()
    assert (rows[at.F : at.F + 9].T == IDENTITY).all()
    p = particles()
    own.load(p, 1, block, 3)
    np.testing.assert_array_equal(rows[extra.place : extra.ready, 3], p.x0[1])
    np.testing.assert_array_equal(rows[extra.rest :, 3], p.F0[1])
    np.testing.assert_array_equal(rows[at.A : at.A + 9, 3], p.A[1])
    rows[extra.number, 3], rows[extra.radius, 3] = -1.0, -2.0
    before = p.Ca[1]
    own.save(p, 1, block, 3)
    assert (p.Ca[1], p.R[1]) == (before, -2.0)
    rows[extra.ready, 3] = 1.0
    own.save(p, 1, block, 3)
    assert p.Ca[1] == -1.0


def test_name_of_a_row_is_taken_once():
    with pytest.raises(ValueError, match="x is declared twice"):
        layout(at, offsets(Rows, FURTHER))


def test_idle_lanes_hold_a_sphere_that_is_not_deformed():
    np.testing.assert_array_equal(np.reshape(IDENTITY, (3, 3)), np.eye(3))


def test_a_stuck_particle_that_has_come_off_and_stuck_elsewhere_is_saved_there():
    p, scratch = particles(), new_scratch(BASE)
    load(p, 1, scratch, 5)
    assert scratch.patch[5] == p.patch[1]
    scratch.patch[5] += 2
    expected = scratch.patch[5]
    save(p, 1, scratch, 5)
    assert p.patch[1] == expected
