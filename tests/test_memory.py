"""Arrays whose memory is taken where they are written."""

from __future__ import annotations

import resource
from pathlib import Path

import numpy as np

from foamprb.memory import clear, sparse_zeros


def resident() -> int:
    """Return the memory of this process, bytes."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()


def test_sparse_zeros_take_memory_where_they_are_written_until_they_are_cleared():
    # Rows that do not end where pages do.
    zeros, before = sparse_zeros((3, 2_000_001, 4), np.float32), resident()
    assert not zeros[1, ::1000].any()
    assert resident() < before + 0.1 * zeros.nbytes
    zeros[:] = 1.0
    assert resident() > before + 0.9 * zeros.nbytes
    clear(zeros[1])
    assert resident() < before + 0.7 * zeros.nbytes
    assert not zeros[1].any()
    assert zeros[0].all()
    assert zeros[2].all()
