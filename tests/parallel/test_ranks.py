"""What can be said of parallel runs without MPI; with it, see ``tests/mpi``."""

from __future__ import annotations

import math
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pipe_case import copy_of_pipe, message

from foamprb.cloud.layout import LANES
from foamprb.cloud.state import VARIABLES, empty
from foamprb.parallel.exchange import Share, homes_of, idle_share, pack, plan_exchange, record, unpack


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
def test_every_particle_has_one_home(n, size):
    homes = homes_of(n, size)
    assert (homes[0], homes[-1], len(homes)) == (0, n, size + 1)
    counts = np.diff(homes)
    assert counts.min() >= 0
    # The first process writes the first rows of a checkpoint.
    assert (counts[0] > 0) == (n > 0)
    assert counts.max() - counts.min() <= 1


def test_without_particles_no_time_is_lost():
    """Nodes read their folders again in vain where all particles were pending or had ended."""
    assert idle_share(0, 0) == 0.0
    assert idle_share(10, 10) == idle_share(10, 12) == 0.0
    assert idle_share(10, 4) == pytest.approx(0.6, rel=1e-15)


def test_records_hold_every_bit_of_a_particle(random):
    p = empty(7)
    for name, variable in VARIABLES.items():
        raw = random.integers(0, 256, (7, p._asdict()[name][0].nbytes), dtype=np.uint8)
        p._asdict()[name][...] = raw.view(variable.dtype).reshape(p._asdict()[name].shape)
    rows = np.array([5, 0, 6])
    memory = {"loads/D": random.random(7), "plane/x": random.random((7, 3))}
    dtype = record((name, array.dtype.str, array.shape[1:]) for name, array in memory.items())
    whole = Share(p, np.arange(7) + 100, memory)
    found, expected_of = unpack(pack(whole, rows, dtype)), whole.take(rows)
    assert found.arrays().keys() == expected_of.arrays().keys()
    for name, array in found.arrays().items():
        expected = expected_of.arrays()[name]
        assert array.dtype == expected.dtype
        assert array.tobytes() == expected.tobytes()


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
    script = (
        "import sys, foamprb.cli, foamprb.run.loop, foamprb.parallel.launch; print('mpi4py' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
