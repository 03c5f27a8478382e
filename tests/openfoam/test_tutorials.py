"""What the coarse mesh and the turbulent flow of a tutorial do to the steps of a default run."""

from __future__ import annotations

import pytest
from benchmarks import pipe, tutorials

from foamprb import Status, execute, prepare, read_case

pytestmark = pytest.mark.openfoam


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    """The flow of TJunction, and places in it."""
    if not tutorials.EXAMPLES.is_dir():
        pytest.skip("OpenFOAM's tutorials are not here")
    case = tutorials.solve("TJunction", tmp_path_factory.mktemp("tutorials") / "TJunction")
    pipe.write_positions(case / "constant" / "softCloudPositions", pipe.places_in(read_case(case).mesh, 3000))
    return case


@pytest.mark.parametrize("Ca", tutorials.CAPILLARY_NUMBERS)
def test_particles_take_as_many_steps_as_openfoams(case, Ca):
    """1.2 for each Δt in the mean, for the shape; ten if the fluid's jumps between cells were errors."""
    settings = tutorials.first_settings(case)
    job = prepare(case, dictionary=tutorials.write_cloud(case, settings, Ca, 20))
    execute(job, "startTime")
    p = job.cloud.particles
    active = p.status == Status.ACTIVE
    assert job.cloud.particles.counts()[Status.FAILED] == 0
    assert active.sum() > 0.9 * p.size
    assert p.substeps[active].mean() < 1.25
