from __future__ import annotations

import os
import signal

# Workers of pytest-xdist use all cores; more threads of BLAS than cores cost several times the work.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, settings
from hypothesis.database import DirectoryBasedExampleDatabase

from foamprb.body.material import MATERIALS

# A shell may ignore SIGINT in its jobs, and so would programs that a test starts and interrupts.
signal.signal(signal.SIGINT, signal.default_int_handler)

# Compiled code and shared machines make single examples slow at times; that is no failure.
settings.register_profile(
    "ci",
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
    derandomize=True,
    database=None,
    print_blob=True,
)
# Other examples in each run; examples that failed are kept in the database and come first in the next run.
settings.register_profile(
    "nightly",
    settings.get_profile("ci"),
    derandomize=False,
    database=DirectoryBasedExampleDatabase(Path(__file__).parents[1] / ".hypothesis/examples"),
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))


@pytest.fixture(autouse=True, scope="session")
def _compile_in_one_process() -> Iterator[None]:
    """Compile loops in the process of a test, which has compiled most of their parts before."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("foamprb.run.compilation.available_threads", lambda: 1)
        yield


@pytest.fixture
def solids() -> Iterator[None]:
    """Remove the solids that a test adds."""
    before = dict(MATERIALS)
    yield
    MATERIALS.clear()
    MATERIALS.update(before)


@pytest.fixture
def random() -> np.random.Generator:
    return np.random.default_rng(20240521)
