"""Properties of the processor that numba compiles for."""

from __future__ import annotations

import numba
from llvmlite import binding


def has_avx2() -> bool:
    """Return True if numba compiles for AVX2, with NUMBA_CPU_NAME and NUMBA_CPU_FEATURES respected."""
    override = numba.config.CPU_FEATURES
    if override is not None:
        return "+avx2" in override.split(",")
    return bool(binding.get_host_cpu_features().get("avx2"))


def is_host() -> bool:
    """Return True if numba compiles for the processor of this machine, as numpy does."""
    return numba.config.CPU_NAME is None and numba.config.CPU_FEATURES is None
