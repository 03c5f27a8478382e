"""How a run calls its cloud functions, and what survives a restart."""

from __future__ import annotations

import numpy as np
import pytest
from observing import go_on, observe, observed, pipe_cloud, restore

from foamprb.cloud.patches import Escape, Rebound
from foamprb.cloudfunctions.particle_collector import ParticleCollector
from foamprb.cloudfunctions.particle_histogram import ParticleHistogram
from foamprb.cloudfunctions.particle_tracks import ParticleTracks
from foamprb.cloudfunctions.patch_post_processing import PatchPostProcessing
from foamprb.cloudfunctions.registry import FUNCTIONS, CloudFunctions
from foamprb.errors import InputError


def test_a_mistake_names_the_function():
    with pytest.raises(InputError, match=r"cloudFunctions/who: patch wal is not in the mesh\. Did"):
        CloudFunctions({"who": PatchPostProcessing(("wal",))}, observed(pipe_cloud(2)))
    bouncing = pipe_cloud(2, walls=(Rebound(), Escape(), Escape()))
    with pytest.raises(InputError, match="patch wall: particles bounce off it"):
        CloudFunctions({"who": PatchPostProcessing(("wall",))}, observed(bouncing))


@pytest.mark.parametrize(
    "function",
    [
        ParticleTracks(7, 1000),
        PatchPostProcessing(("wall", "outlet")),
        ParticleCollector("plane", (0.01, 0.0, 0.0), (1.0, 0.0, 0.0)),
        ParticleHistogram(nBins=5),
    ],
    ids=lambda f: type(f).__name__,
)
def test_what_is_remembered_survives_a_restart(function, tmp_path):
    cloud = pipe_cloud()
    observe(cloud, function, tmp_path / "whole")
    first = pipe_cloud()
    state = observe(first, function, tmp_path / "parts", writes=(200,)).state()
    np.savez(tmp_path / "state.npz", allow_pickle=False, **state)
    second = pipe_cloud()
    functions = CloudFunctions({"f": function}, observed(second))
    for array, saved in zip(second.particles, first.particles, strict=True):
        array[:] = saved
    second.step = first.step
    with np.load(tmp_path / "state.npz", allow_pickle=False) as saved:
        restore(functions, saved)
    go_on(second, functions, tmp_path / "parts", (400, 700))
    whole = sorted(path.relative_to(tmp_path / "whole") for path in (tmp_path / "whole").rglob("*.*"))
    assert whole
    for path in whole:
        assert (tmp_path / "parts" / path).read_bytes() == (tmp_path / "whole" / path).read_bytes()


def test_the_memory_of_other_functions_is_refused():
    look = observed(pipe_cloud(2))
    state = CloudFunctions({"a": ParticleTracks(1, 1), "b": ParticleHistogram()}, look).state()
    with pytest.raises(InputError, match="cloudFunctions: b, c was not observed from the start"):
        CloudFunctions({"a": ParticleTracks(1, 1), "c": ParticleHistogram()}, look).restore(state, state.get)


def test_array_without_a_kind_is_reported():
    class Forgetful(PatchPostProcessing):
        def begin(self, _cloud):
            return {"history": np.zeros(3)}

    with pytest.raises(TypeError, match=r"Forgetful\.arrays lacks history"):
        CloudFunctions({"f": Forgetful(())}, observed(pipe_cloud(2)))


def test_registry_names_are_openfoams_where_it_has_them():
    assert {"particleTracks", "patchPostProcessing", "particleCollector"} <= FUNCTIONS.keys()
