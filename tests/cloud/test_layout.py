"""The rows of a block: declared once, from which all else follows."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np
import pytest

from foamprb.cloud import measures
from foamprb.cloud.block import ROWS, Rows, at, load_particle, new_scratch, save_particle
from foamprb.cloud.integrators import rosenbrock, stokes
from foamprb.cloud.integrators.adaptive import during
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.layout import IDENTITY, LANES, Row, end, layout, offsets, rows_of
from foamprb.cloud.state import CHANGING, VARIABLES, Particles, empty

PARTS = {
    "paper": (at,),
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


def particles(n=2):
    """Particles with numbers of no meaning in every array, all of them different."""
    random = np.random.default_rng(3)
    p = empty(n)
    for array in p:
        array[:] = random.random(array.shape) if array.dtype.kind == "f" else random.permutation(n)
    return p


@pytest.mark.parametrize("name", PARTS)
def test_rows_cover_the_block_and_do_not_overlap(name):
    parts = PARTS[name]
    taken = [
        first + c
        for part in parts
        for first, row in zip(part, rows_of(type(part)).values(), strict=True)
        for c in range(row.components)
    ]
    rows = INTEGRATORS[name].layout.rows if name in INTEGRATORS else layout(*parts).rows
    assert taken == list(range(rows))


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
    p, scratch = particles(), new_scratch(ROWS)
    scratch.block[:] = 0.0
    load_particle(p, 1, scratch, 5)
    scratch.block[:] += 1.0
    scratch.host[:] += 7
    for numbers in (scratch.reason, scratch.patch):
        numbers[:] += 7 * end_of_run
    scratch.status[5] += end_of_run
    scratch.block[at.mirrored * LANES + 5] = float(end_of_run)
    before = Particles(*(array.copy() for array in p))
    save_particle(p, 1, scratch, 5)
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
    scratch = new_scratch(ROWS)
    for lane, k in ((0, 1), (LANES - 1, 0)):
        load_particle(p, k, scratch, lane)
        scratch.block[at.mirrored * LANES + lane] = 1.0
        save_particle(p, k, scratch, lane)
    for name, old, new in zip(Particles._fields, saved, p, strict=True):
        np.testing.assert_array_equal(new, old, err_msg=name)


def test_a_row_that_is_declared_needs_nothing_else():
    """Its place, its initial value, loading and saving, alone or when a condition holds."""
    extra = offsets(ExtraRows, ROWS)
    own = layout(at, extra)
    assert (extra.place, own.rows) == (ROWS, ROWS + 15)
    assert own.rows == end(extra)
    block = np.full(own.rows * LANES, np.nan)
    own.idle(block)
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
        layout(at, offsets(Rows, ROWS))


def test_idle_lanes_hold_a_sphere_that_is_not_deformed():
    np.testing.assert_array_equal(np.reshape(IDENTITY, (3, 3)), np.eye(3))


def test_a_stuck_particle_that_has_come_off_and_stuck_elsewhere_is_saved_there():
    p, scratch = particles(), new_scratch(ROWS)
    load_particle(p, 1, scratch, 5)
    assert scratch.patch[5] == p.patch[1]
    scratch.patch[5] += 2
    expected = scratch.patch[5]
    save_particle(p, 1, scratch, 5)
    assert p.patch[1] == expected
