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

# A shell may ignore these signals in its jobs, and so would programs that a test starts and interrupts.
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGHUP, signal.SIG_DFL)

# Compiled code and shared machines make single examples slow at times; that is no failure.
settings.register_profile(
    "ci",
    max_examples=30,
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
    max_examples=100,
    derandomize=False,
    database=DirectoryBasedExampleDatabase(Path(__file__).parents[1] / ".hypothesis/examples"),
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))

TESTS = Path(__file__).parent
QUICK = (
    "body/", "dictionary/", "results/", "settings/", "cloud/injection/", "cloud/test_cloud.py",
    "cloud/test_integrators.py", "cloud/test_layout.py", "flow/mesh/test_mesh.py",
    "flow/read/test_openfoam.py", "view/test_bodies.py",
)  # fmt: skip
"""Files of the tier for each commit: at most 5 min of CPU time with an empty cache of compiled code."""
COMPILES = ("results/test_background.py", "settings/test_extension.py", "settings/test_libs.py")
"""Files among these that compile for long."""


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the quick tests; those of a file, which may share a run, stay together in ``--dist loadgroup``."""
    for item in items:
        path = item.path.relative_to(TESTS).as_posix()
        if path.startswith(QUICK) and path not in COMPILES:
            item.add_marker("quick")
        if not path.startswith("mpi/"):
            item.add_marker(pytest.mark.xdist_group(path))


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
