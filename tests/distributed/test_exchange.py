"""What can be said of parallel runs without MPI; with it, see ``tests/mpi``."""

from __future__ import annotations

import math
import subprocess
import sys
from functools import partial

import numpy as np
import pytest
import thread_mpi
from hypothesis import given
from hypothesis import strategies as st
from pipe_case import copy_of_pipe, message

from foamprb.cloud.communicator import Share
from foamprb.cloud.layout import LANES
from foamprb.cloud.state import VARIABLES, empty
from foamprb.distributed.exchange import Route, firsts_of, pack, plan_exchange, unpack, with_others


@given(st.lists(st.integers(0, 40 * LANES), min_size=2, max_size=9))
def test_an_exchange_leaves_all_with_as_many(active):
    plan = plan_exchange(active)
    blocks = [math.ceil(n / LANES) for n in active]
    even = math.ceil(math.ceil(sum(active) / len(active)) / LANES)
    if plan is None:
        assert max(blocks) <= 1.1 * even
        return
    assert (plan >= 0).all()
    after = np.array(active) - plan.sum(axis=1) + plan.sum(axis=0)
    assert after.sum() == sum(active)
    assert after.max() - after.min() <= 1
    # Nobody gives and takes, so nothing travels in vain.
    assert not ((plan.sum(axis=1) > 0) & (plan.sum(axis=0) > 0)).any()
    assert max(blocks) > 1.1 * math.ceil(after.max() / LANES)


@given(st.integers(0, 100), st.integers(1, 9))
def test_every_particle_is_written_by_one_rank(n, size):
    firsts = firsts_of(n, size)
    assert (firsts[0], firsts[-1], len(firsts)) == (0, n, size + 1)
    counts = np.diff(firsts)
    assert counts.min() >= 0
    # The first process writes the first rows of a checkpoint.
    assert (counts[0] > 0) == (n > 0)
    assert counts.max() - counts.min() <= 1


def test_records_hold_every_bit_of_a_particle(random):
    p = empty(7)
    for name, variable in VARIABLES.items():
        raw = random.integers(0, 256, (7, p._asdict()[name][0].nbytes), dtype=np.uint8)
        p._asdict()[name][...] = raw.view(variable.dtype).reshape(p._asdict()[name].shape)
    rows = np.array([5, 0, 6])
    memory = {"loads/D": random.random(7), "plane/x": random.random((7, 3))}
    whole = Share(p, memory)
    found, expected_of = unpack(pack(whole, rows)), whole.take(rows)
    assert found.arrays().keys() == expected_of.arrays().keys()
    for name, array in found.arrays().items():
        expected = expected_of.arrays()[name]
        assert array.dtype == expected.dtype
        assert array.tobytes() == expected.tobytes()


@given(st.data())
def test_shares_keep_every_bit_when_particles_are_replaced(data):
    """In their own memory where it suffices, whatever was there before."""
    share, expected, number = Share(empty(0)), {}, 0
    for _ in range(data.draw(st.integers(1, 8))):
        n, zeros = share.particles.size, data.draw(st.booleans())
        rows = np.array(sorted(data.draw(st.sets(st.integers(0, n - 1)))) if n else [], dtype=np.int64)
        others = Share(empty(data.draw(st.integers(0, 12))))
        for k in range(others.particles.size):
            number += 1
            others.particles.number[k] = number
            others.particles.bonds[k] = expected[number] = 0 if zeros else number
            others.particles.eddy[k] = -0.0 if number % 2 else 0.0
        for gone in share.particles.number[rows]:
            del expected[gone]
        share = with_others(share, rows, others)
        p = share.particles
        assert dict(zip(p.number.tolist(), p.bonds.tolist(), strict=True)) == expected
        assert (np.signbit(p.eddy).all(axis=1) == (p.number % 2 == 1)).all()
        assert all(len(array) == p.size for array in p)


def test_a_share_of_changing_size_stays_in_its_memory():
    share = with_others(Share(empty(100)), np.empty(0, dtype=np.int64), Share(empty(5)))
    before = share.particles.F.ctypes.data
    for leaving, arriving in ((20, 3), (1, 15), (0, 3)):
        share = with_others(share, np.arange(leaving), Share(empty(arriving)))
    assert (share.particles.size, share.particles.F.ctypes.data) == (105, before)


@pytest.mark.parametrize(
    ("n", "size", "takers"), [(1, 1, 1), (0, 3, 3), (7, 3, 3), (7, 3, 1), (200_000, 2, 2)]
)
def test_rows_go_where_they_should(n, size, takers):
    """Several arrays of the same rows, more of them than are sent at once; some processes take none."""
    comms, random = thread_mpi.processes(size), np.random.default_rng(n)
    to = [random.integers(0, takers, n + rank) for rank in range(size)]
    rows = [np.arange(len(own)) + 1_000_000 * rank for rank, own in enumerate(to)]

    def exchange(comm):
        route = Route(thread_mpi.Mpi(comm), comm, to[comm.rank])
        numbers = rows[comm.rank]
        sent = numbers, np.outer(numbers, [0.5, 2.0]), (numbers % 7).astype(np.int8), 0.0 * numbers
        return route.size, *map(route.send, sent)

    for rank, found in enumerate(thread_mpi.together([partial(exchange, c) for c in comms])):
        expected = np.concatenate([own[chosen == rank] for own, chosen in zip(rows, to, strict=True)])
        number, pairs, small, zeros = found[1:]
        assert found[0] == len(expected)
        assert np.sort(number).tolist() == expected.tolist()
        assert (pairs == np.outer(number, [0.5, 2.0])).all()
        assert (small == number % 7).all()
        assert (zeros.dtype, zeros.shape, zeros.any()) == (np.dtype(float), number.shape, False)


@pytest.mark.parametrize("number", ["0", "1"])
def test_without_mpi4py_there_is_one_message_in_all(number, tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "mpi4py", None)
    monkeypatch.setenv("OMPI_COMM_WORLD_RANK", number)
    case = copy_of_pipe(tmp_path)
    if number == "0":
        assert "-parallel needs mpi4py" in message(case, capsys, "-parallel")
        assert "foamprb[mpi]" in message(case, capsys, "-parallel")
    else:
        from foamprb.cli import main

        assert main(["run", "-case", str(case), "-parallel"]) == 1
        assert capsys.readouterr().err == ""


def test_mpi4py_is_loaded_only_for_parallel_runs():
    modules = "sys, foamprb.cli, foamprb.run.loop, foamprb.distributed.launch"
    script = f"import {modules}; print('mpi4py' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
