"""Cloud functions that sample the particles of each process apart."""

from __future__ import annotations

import numpy as np
from observing import observed, pipe_cloud

from foamprb.cloudfunctions.base import Memory
from foamprb.cloudfunctions.deformability_cytometry import DeformabilityCytometry
from foamprb.cloudfunctions.haemolysis import Haemolysis
from foamprb.cloudfunctions.particle_collector import ParticleCollector
from foamprb.cloudfunctions.particle_histogram import ParticleHistogram
from foamprb.cloudfunctions.particle_tracks import ParticleTracks
from foamprb.cloudfunctions.registry import CloudFunctions
from foamprb.parallel.exchange import Share
from foamprb.parallel.sampling import Sampling

PLANE = (0.004, 0.0, 0.0), (1.0, 0.0, 0.0)
FUNCTIONS = {
    "loads": ParticleHistogram(sampleInterval=5),
    "plane": ParticleCollector("plane", *PLANE, sampleInterval=5),
    "camera": DeformabilityCytometry(*PLANE, view=(0.0, 0.0, 1.0), sampleInterval=5),
    "blood": Haemolysis("Ding", "morphology", sampleInterval=5),
    "paths": ParticleTracks(5, 100),
}


def test_samples_of_shares_are_those_of_the_whole():
    """The shares change between the samples, as particles change processes."""
    cloud, random = pipe_cloud(), np.random.default_rng(3)
    functions = CloudFunctions(FUNCTIONS, observed(cloud))
    names = functions.travelling
    assert names == ["loads", "plane", "camera", "blood"]
    whole = CloudFunctions({name: FUNCTIONS[name] for name in names}, observed(cloud))
    sampling = Sampling.of(functions, cloud.medium)
    carried: Memory = functions.with_particles(names)
    events: list[Memory] = [{}, {}, {}]
    for _ in range(40):
        cloud.advance(5)
        whole.sample(names)
        share_of = random.integers(0, 3, cloud.particles.size)
        for number in range(3):
            rows = np.flatnonzero(share_of == number)
            own = Share(cloud.particles, np.arange(cloud.particles.size), carried).take(rows)
            p, memory = own.particles, own.memory
            events[number] = sampling.sample(
                names, memory, p, cloud.flow, cloud.tracker, cloud.time, events[number]
            )
            for name, array in memory.items():
                carried[name][rows] = array
    functions.add_events(events)
    expected, state = whole.state(), functions.state()
    assert len(expected["plane/crossings"]) > 20
    for name, array in expected.items():
        assert state[name].tobytes() == array.tobytes(), name


def test_rebounds_keep_functions_with_the_whole_cloud():
    """Their records may lie on another process than the particle."""
    cloud = pipe_cloud(2, rebounds=True)
    assert CloudFunctions(FUNCTIONS, observed(cloud)).travelling == []
