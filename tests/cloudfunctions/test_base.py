"""How a run calls its cloud functions, and what survives a restart."""

from __future__ import annotations

import numpy as np
import pytest
from observing import observed, pipe_cloud

from foamprb.cloud.patches import Escape, Rebound
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
