"""Properties of the processor that numba compiles for."""

from __future__ import annotations

import os

import numba

from foamprb.compile.processor import SWITCH, processor


def has_avx2() -> bool:
    """Return True if code is compiled for AVX2."""
    return processor().register > 2


def is_host() -> bool:
    """Return True if numba compiles for the processor of this machine, as numpy does."""
    return numba.config.CPU_NAME is None and numba.config.CPU_FEATURES is None and not os.environ.get(SWITCH)
