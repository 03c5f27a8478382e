"""Cloud functions that sample the particles of each process apart."""

from __future__ import annotations

import numpy as np
import thread_mpi
from hypothesis import given
from hypothesis import strategies as st
from mesh_shapes import cyclic_row
from observing import WATER, observed, pipe_cloud

from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Cyclic, Rebound
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models
from foamprb.cloudfunctions.base import Memory, in_time
from foamprb.cloudfunctions.deformability_cytometry import DeformabilityCytometry
from foamprb.cloudfunctions.haemolysis import Haemolysis
from foamprb.cloudfunctions.particle_collector import ParticleCollector
from foamprb.cloudfunctions.particle_histogram import ParticleHistogram
from foamprb.cloudfunctions.particle_tracks import ParticleTracks
from foamprb.cloudfunctions.registry import CloudFunctions
from foamprb.flow.loaded import LoadedFlow
from foamprb.flow.meshflow import MeshFlow
from foamprb.parallel.exchange import Share
from foamprb.parallel.sampling import Sampling
from foamprb.parallel.worker import Worker

PLANE = (0.004, 0.0, 0.0), (1.0, 0.0, 0.0)
FUNCTIONS = {
    "loads": ParticleHistogram(sampleInterval=5),
    "plane": ParticleCollector("plane", *PLANE, sampleInterval=5),
    "camera": DeformabilityCytometry(*PLANE, view=(0.0, 0.0, 1.0), sampleInterval=5),
    "blood": Haemolysis("Ding", "morphology", sampleInterval=5),
    "paths": ParticleTracks(5, 100),
}


@given(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 2)), max_size=8), st.booleans())
def test_events_are_ordered_by_time_then_by_number(rows, sort):
    events = np.array([(n, t, k) for k, (n, t) in enumerate(rows)], dtype=float).reshape(-1, 3)
    expected = sorted(events.tolist(), key=lambda row: (row[1], row[0]))
    assert in_time(np.reshape(expected, (-1, 3)) if sort else events).tolist() == expected


def _sample(function, memory, cloud):
    function.sample(memory, cloud)


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
    flow = LoadedFlow(cloud.tracker.kernels, cloud.flow_arrays(), None)
    for _ in range(40):
        cloud.advance(5)
        whole.sample(names)
        share_of = random.integers(0, 3, cloud.particles.size)
        for number in range(3):
            rows = np.flatnonzero(share_of == number)
            own = Share(cloud.particles, carried).take(rows)
            p, memory = own.particles, own.memory
            events[number] = sampling.observe(
                names, memory, p, flow, cloud.tracker, cloud.time, events[number], _sample
            )
            for name, array in memory.items():
                carried[name][rows] = array
    functions.add_events(events)
    expected, state = whole.state(), functions.state()
    assert len(expected["plane/crossings"]) > 20
    for name, array in expected.items():
        assert state[name].tobytes() == array.tobytes(), name


def period_cloud(n: int = 30) -> Cloud:
    """Particles that pass coupled patches at several speeds, and turn in shear."""
    mesh = cyclic_row(0.0, 1)
    l = np.zeros((3, 3))
    l[0, 1] = 3.0
    u = mesh.nodes @ l.T + [1.0, 0.0, 0.0]
    flow = MeshFlow(mesh, u, np.broadcast_to(l, (len(u), 3, 3)))
    random = np.random.default_rng(5)
    p = spheres(random.uniform(0.2, 0.8, (n, 3)), d=1e-3, rho=1e3, mu=1.0)
    walls = [Cyclic() if patch.neighbour else Rebound() for patch in flow.patches]
    return Cloud(p, flow, WATER, walls, 2e-3, Models(integrator="stokes", rebounds=True), threads=1)


def test_passages_are_recorded_by_the_process_that_has_the_particle(tmp_path):
    """Whichever it is when the records come; the functions sample at different times."""
    plane = (0.9, 0.0, 0.0), (1.0, 0.0, 0.0)
    functions = {
        "plane": ParticleCollector("plane", *plane, sampleInterval=1),
        "camera": DeformabilityCytometry(*plane, view=(0.0, 0.0, 1.0), sampleInterval=1),
        "blood": Haemolysis("Ding", "morphology", sampleInterval=1),
    }
    cloud, random = period_cloud(), np.random.default_rng(3)
    n = cloud.size
    whole, apart = (CloudFunctions(functions, observed(cloud)) for _ in range(2))
    sampling, carried = Sampling.of(apart, cloud.medium), apart.with_particles(functions)
    workers = []
    for _ in range(3):
        worker = Worker(thread_mpi.Mpi(*thread_mpi.processes(1)))
        worker._sampling, worker._tracker, worker._flow = sampling, cloud.tracker, cloud.make_ready()
        workers.append(worker)
    for k in range(1, 41):
        cloud.advance(20)
        rows = cloud.take_rebounds()
        names = [name for name, every in zip(functions, (1, 2, 5), strict=True) if k % every == 0]
        whole.record_rebounds(rows, functions)
        whole.sample(names)
        share_of = random.integers(0, 3, n)
        for number, worker in enumerate(workers):
            mine = random.permutation(np.flatnonzero(share_of == number))
            worker._become(Share(cloud.particles, carried).take(mine))
            if len(rows):
                worker.record(rows, cloud.time)
            worker.sample(names, cloud.time)
            for name, array in worker.own.memory.items():
                carried[name][mine] = array
    apart.add_events([worker.take_events() for worker in workers])
    for name, observing in (("whole", whole), ("apart", apart)):
        (tmp_path / name).mkdir()
        observing.write(tmp_path / name)
    expected, state = whole.state(), apart.state()
    assert len(expected["plane/crossings"]) > 40
    for name, array in expected.items():
        assert state[name].tobytes() == array.tobytes(), name
    for file in (tmp_path / "whole").rglob("*.csv"):
        assert (tmp_path / "apart" / file.relative_to(tmp_path / "whole")).read_bytes() == file.read_bytes()


def test_cells_of_a_part_have_their_numbers_in_the_whole_mesh():
    cloud = period_cloud()
    flow, hosts = cloud.flow, cloud.particles.host
    numbers = np.random.default_rng(1).permutation(flow.mesh.n_cells) + 100
    loaded = LoadedFlow(flow.kernels, cloud.make_ready(), None)
    np.testing.assert_array_equal(loaded.cell_of(hosts), flow.cell_of(hosts))
    np.testing.assert_array_equal(loaded._replace(cells=numbers).cell_of(hosts), numbers[flow.cell_of(hosts)])
