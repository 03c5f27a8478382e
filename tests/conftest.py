from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

# Compiled code and shared machines make single examples slow at times; that is no failure.
settings.register_profile(
    "default", deadline=None, suppress_health_check=[HealthCheck.too_slow], derandomize=True
)
settings.load_profile("default")


@pytest.fixture
def random() -> np.random.Generator:
    return np.random.default_rng(20240521)
