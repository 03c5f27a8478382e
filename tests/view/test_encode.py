"""Encoding of a page's numbers and its errors."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from page_reader import unpacked, values_of
from view_run import motion

from foamprb.view.bodies import Quantity
from foamprb.view.encode import (
    POSITION_BITS,
    SHAPE_STEP,
    grid_of,
    pack,
    pack_bits,
    pack_field,
    pack_points,
    pack_shapes,
    pack_values,
)

SHAPES = hnp.array_shapes(min_dims=1, max_dims=3, min_side=1, max_side=6)
WHOLE = hnp.arrays(np.int64, SHAPES, elements=st.integers(-(2**24), 2**24))


class Shapes:
    """The attributes of bodies that are packed."""

    def __init__(self, F: np.ndarray) -> None:
        self.F = F.astype(np.float32)
        self.present = np.ones(F.shape[:2], dtype=bool)


@given(WHOLE)
def test_whole_numbers_come_back(whole):
    column = pack(whole)
    assert column.order in (0, 1, 2)
    np.testing.assert_array_equal(unpacked(column), whole)


@pytest.mark.parametrize("shape", [(0,), (3, 0), (0, 2, 3)])
def test_empty_arrays_keep_their_shape(shape):
    assert unpacked(pack(np.zeros(shape, dtype=np.int64))).shape == shape


def test_even_motion_takes_little_space():
    """2000 bodies at 100 times on straight lines: an eighth of a byte for each of 600 000 numbers.

    Where each begins and how fast it goes, 30 bits, are 0.05 bytes of that.
    """
    start, rate = np.random.default_rng(0).integers(0, 2**20, (2, 2000, 3))
    column = pack(start + rate // 1000 * np.arange(100)[:, None, None])
    assert column.order == 2
    assert len(column.data) < 80_000


@given(
    hnp.arrays(
        np.float64,
        st.tuples(st.integers(1, 4), st.integers(1, 5), st.just(3)),
        elements=st.floats(-1e3, 1e3, allow_subnormal=False),
    )
)
def test_positions_are_known_to_a_share_of_the_domain(x):
    packed = pack_points(x, grid_of(x))
    side = np.ptp(x.reshape(-1, 3), axis=0).max()
    found = np.array(packed.low) + packed.step[0] * unpacked(packed)
    # Half a step, besides what double precision loses at the size of the coordinates.
    assert np.abs(found - x).max() <= 0.5001 * side / (2**POSITION_BITS - 1) + 1e-12


def test_shapes_are_known_to_a_part_in_two_thousand():
    """For volume-preserving bodies; relative, in Frobenius' norm."""
    F = motion(200, 20).F
    packed = pack_shapes(Shapes(F))
    found = packed.step[0] * unpacked(packed).reshape(F.shape)
    assert np.abs(found - F).max() <= 0.5001 * SHAPE_STEP
    error = np.linalg.norm(found - F, axis=(2, 3)) / np.linalg.norm(F, axis=(2, 3))
    assert error.max() < 5e-4


@given(st.floats(1.0, 120.0), st.integers(0, 1000))
def test_stretched_shapes_keep_their_relative_error(largest, seed):
    F = np.random.default_rng(seed).uniform(-1.0, 1.0, (3, 4, 3, 3))
    F *= largest / np.abs(F).max()
    packed = pack_shapes(Shapes(F))
    whole = unpacked(packed)
    assert np.abs(whole).max() < 2**15
    found = packed.step[0] * whole.reshape(F.shape)
    assert np.abs(found - F).max() <= max(0.51 * SHAPE_STEP, largest / 65_000)


@given(
    hnp.arrays(
        np.float32,
        st.tuples(st.integers(1, 4), st.integers(1, 5), st.integers(1, 3)),
        elements=st.one_of(st.floats(-(2.0**40), 2.0**40, width=32), st.just(np.nan)),
    )
)
def test_values_are_known_to_four_digits(values):
    packed = pack_field(Quantity("a", "a", "", ("",), values))
    found = values_of(unpacked(packed), packed.low)
    np.testing.assert_array_equal(np.isnan(found), np.isnan(values))
    most = float(np.nanmax(np.abs(values), initial=0.0))
    assert (np.abs(found - values) <= np.abs(values) * 2.0**-15 + most * 2.0**-23)[~np.isnan(values)].all()


def test_small_values_beside_large_ones_keep_their_digits():
    """The velocity of a slow body beside a fast one."""
    values = np.array([[[8e-5, -8e-5, 0.0], [20.0, 30.0, 40.0]]], dtype=np.float32)
    packed = pack_field(Quantity("U", "velocity", "m/s", ("magnitude", "x", "y", "z"), values))
    np.testing.assert_allclose(values_of(unpacked(packed), packed.low), values, rtol=4e-5)


def test_plain_values_are_known_to_24_bits(random):
    values = random.uniform(3.0, 7.0, 1000)
    packed = pack_values(values)
    found = packed.low[0] + packed.step[0] * unpacked(packed)
    assert np.abs(found - values).max() <= 4.0 / 2**25 * 1.01
    assert unpacked(pack_values(np.full(3, 2.5))).tolist() == [0, 0, 0]


@given(hnp.arrays(np.bool_, st.tuples(st.integers(1, 5), st.integers(1, 40))))
def test_bits_come_back(mask):
    found = unpacked(pack_bits(mask)).astype(np.uint8)
    bits = np.unpackbits(found, axis=1, count=mask.shape[1], bitorder="little")
    np.testing.assert_array_equal(bits.astype(bool), mask)
