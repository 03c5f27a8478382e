"""Particles at homes, without MPI: the workers of several processes in one."""

from __future__ import annotations

import dataclasses
import pickle
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import small_clouds
import thread_mpi
from hypothesis import given
from hypothesis import strategies as st
from mesh_shapes import cyclic_row
from observing import WATER, observed, pipe_cloud

from foamprb.cloud.cloud import Cloud, Stepper, regrouped
from foamprb.cloud.communicator import Communicator, same
from foamprb.cloud.patches import Cyclic, Escape, Rebound
from foamprb.cloud.paths import Steps, step
from foamprb.cloud.state import Particles, concatenate, empty, spheres
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloud.tracker import Models
from foamprb.cloudfunctions.base import in_time
from foamprb.cloudfunctions.deformability_cytometry import DeformabilityCytometry
from foamprb.cloudfunctions.haemolysis import Haemolysis
from foamprb.cloudfunctions.particle_collector import ParticleCollector
from foamprb.cloudfunctions.particle_histogram import ParticleHistogram
from foamprb.cloudfunctions.particle_statistics import ParticleStatistics
from foamprb.cloudfunctions.particle_tracks import ParticleTracks
from foamprb.cloudfunctions.patch_post_processing import PatchPostProcessing
from foamprb.cloudfunctions.registry import CloudFunctions
from foamprb.cloudfunctions.suspension_stress import SuspensionStress
from foamprb.distributed import worker as worker_module
from foamprb.distributed.ranks import Ranks
from foamprb.distributed.worker import Worker
from foamprb.errors import InputError
from foamprb.flow.loaded import loaded_fields
from foamprb.flow.meshflow import MeshFlow
from foamprb.results.checkpoint import Checkpoint, StoredCheckpoint, part_file, write_checkpoint
from foamprb.run.description import _surveyed
from foamprb.run.restart import _agree, _restore_rank, _sums_of_particles

PLANE = (0.004, 0.0, 0.0), (1.0, 0.0, 0.0)
FUNCTIONS = {
    "loads": ParticleHistogram(),
    "plane": ParticleCollector("plane", *PLANE),
    "camera": DeformabilityCytometry(*PLANE, view=(0.0, 0.0, 1.0)),
    "blood": Haemolysis("Ding", "morphology"),
    "paths": ParticleTracks(5, 100, maxTracks=13),
    "hits": PatchPostProcessing(("wall", "outlet")),
    "stress": SuspensionStress(),
}


class Processes(Ranks):
    """Ranks of several processes in one, without a flow of their own."""

    def __init__(self, n: int) -> None:
        self._comms = thread_mpi.processes(n)
        modules = [thread_mpi.Mpi(comm) for comm in self._comms]
        self.workers = thread_mpi.together([partial(Worker, module) for module in modules])
        super().__init__(self.workers[0], 1)

    def call(self, function: Any, *arguments: Any, here: tuple[Any, ...] = ()) -> list[Any]:
        # Each process unpickles arguments of its own.
        message = pickle.dumps((function, arguments))

        def work(worker: Worker) -> Any:
            name, given = (function, arguments) if worker.number == 0 else pickle.loads(message)
            return name(worker, *given, *(here if worker.number == 0 else ()))

        return thread_mpi.together([partial(work, w) for w in self.workers])

    def publish(self, arrays: Any, flow: Any) -> None:
        for worker in self.workers:
            worker.flow, worker.sampled = arrays, loaded_fields(flow)

    def prepare_steps(self, cloud: Cloud) -> None:
        """Let the particles go to the ranks that advance them."""
        self.call(Worker.prepare, cloud.tracker, 1)
        cloud.publish()
        cloud.particles = empty(0)
        self.call(Worker.distribute)

    def see(self, taken: list[Steps], until: float) -> None:
        """Give each process the steps of its particles."""
        for worker in self.workers:
            observers = worker.sampling.observers(worker, until)
            for steps in taken if observers else ():
                here, rows = worker.find(steps.number)
                mine = steps.take(here)
                mine.tables[0, step.row] = rows
                observers.observe(mine)

    def take(self, p: Particles) -> None:
        """Take the state of all particles as that of the particles of each process."""
        for worker in self.workers:
            numbers = worker.particles.number.copy()
            for own, array in zip(worker.particles, p, strict=True):
                own[:] = array[numbers]

    def mix(self, random: np.random.Generator) -> None:
        """Send some particles from each process to others."""
        rows = [np.flatnonzero(random.random(w.particles.size) < 0.4) for w in self.workers]
        to = [random.integers(0, len(self.workers), len(own)) for own in rows]
        works = [partial(w.send, *given) for w, *given in zip(self.workers, rows, to, strict=True)]
        thread_mpi.together(works)

    def joined(self) -> dict[str, np.ndarray]:
        """Return what cloud functions store of all particles, by their numbers."""
        order = np.argsort(np.concatenate([w.particles.number for w in self.workers]))
        names = self.workers[0].share.memory
        return {k: np.concatenate([w.share.memory[k] for w in self.workers])[order] for k in names}


@pytest.fixture(autouse=True)
def _small_parts(monkeypatch):
    monkeypatch.setattr("foamprb.cloud.communicator.PART", 7)


def on_ranks(cloud: Cloud, n: int, **changes: Any) -> tuple[Cloud, Processes]:
    """Return a cloud of the same particles that n processes hold."""
    ranks, made_of = Processes(n), {f.name: getattr(cloud, f.name) for f in dataclasses.fields(cloud)}
    p = ranks.place(cloud.size, partial(cut, cloud.particles.copy()))
    return Cloud(**{**made_of, **changes, "particles": p, "comm": ranks}), ranks


def cut(p: Particles, _most: int) -> list[Particles]:
    return [p.take(slice(k, k + 11)) for k in range(0, p.size, 11)]


def assert_same_files(folder: Path, others: Path) -> None:
    files = sorted(f.relative_to(folder) for f in folder.rglob("*") if f.is_file())
    assert files == sorted(f.relative_to(others) for f in others.rglob("*") if f.is_file())
    for file in files:
        assert (folder / file).read_bytes() == (others / file).read_bytes(), file


def observe_both(cloud: Cloud, functions: dict[str, Any], n: int, folder: Path, steps: int = 10) -> None:
    """Observe a cloud here and elsewhere; all files and all data are the same."""
    afar, ranks = on_ranks(cloud, n)
    here, there = (CloudFunctions(functions, observed(c)) for c in (cloud, afar))
    ranks.prepare_steps(afar)
    random, taken, sampling = np.random.default_rng(1), [], cloud.comm.rank.sampling
    observers = sampling.observers

    def recording(*arguments: Any) -> Any:
        real = observers(*arguments)
        if real is None:
            return None

        def observe(given: Steps) -> None:
            taken.append(given.take((given.t[1] > given.t[0]) & (given.row >= 0)))
            real.observe(given)

        return real._replace(observe=observe)

    sampling.observers = recording
    for k in range(30):
        Stepper(cloud).advance(steps)
        ranks.see(taken, cloud.time)
        taken.clear()
        ranks.take(cloud.particles)
        ranks.mix(random)
        afar.step = cloud.step
        rows = cloud.take_rebounds()
        for some in (cloud, afar):
            # Both take the records of the one loop.
            some.tracker.rebounds = [rows]
            (here if some is cloud else there)._record_rebounds()
        if k % 10 == 9:
            here.write(folder / "here")
            there.write(folder / "there")
    assert_same_files(folder / "here", folder / "there")
    found, expected = there.state() | ranks.joined(), here.state()
    assert found.keys() == expected.keys()
    assert len({w.particles.size for w in ranks.workers}) > 1 or n == 1
    for name, array in expected.items():
        assert found[name].dtype == array.dtype
        assert found[name].tobytes() == array.tobytes(), name


@pytest.mark.parametrize(("n", "shape"), [(1, "affine"), (3, "affine"), (3, "quadratic")])
def test_functions_write_the_same_of_particles_elsewhere(n, shape, tmp_path):
    for name in ("here", "there"):
        (tmp_path / name).mkdir()
    cloud = pipe_cloud(shape=shape)
    observe_both(cloud, FUNCTIONS, n, tmp_path)
    assert {*cloud.particles.status.tolist()} >= {1, 2}


def test_rebounds_of_particles_elsewhere_are_recorded(tmp_path):
    for name in ("here", "there"):
        (tmp_path / name).mkdir()
    cloud = pipe_cloud(walls=(Rebound(0.5, 0.1), Escape(), Escape()), integrator="rosenbrock", rebounds=True)
    observe_both(cloud, FUNCTIONS, 3, tmp_path)
    assert (tmp_path / "here/hits/wall.csv").read_text().count("rebound") > 10


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


def test_passages_are_recorded_by_the_rank_that_has_the_particle(tmp_path):
    """Whichever it is when the records come; the functions sample at different times."""
    plane = (0.9, 0.0, 0.0), (1.0, 0.0, 0.0)
    functions = {
        "plane": ParticleCollector("plane", *plane),
        "camera": DeformabilityCytometry(*plane, view=(0.0, 0.0, 1.0)),
        "blood": Haemolysis("Ding", "morphology"),
    }
    for name in ("here", "there"):
        (tmp_path / name).mkdir()
    observe_both(period_cloud(), functions, 3, tmp_path, steps=20)
    assert len((tmp_path / "here/plane/crossings.csv").read_text().splitlines()) > 40


@given(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 2)), max_size=8), st.booleans())
def test_events_are_ordered_by_time_then_by_number(rows, sort):
    events = np.array([(n, t, k) for k, (n, t) in enumerate(rows)], dtype=float).reshape(-1, 3)
    expected = sorted(events.tolist(), key=lambda row: (row[1], row[0]))
    assert in_time(np.reshape(expected, (-1, 3)) if sort else events).tolist() == expected


def test_fields_on_the_mesh_are_those_of_one_process(tmp_path):
    cloud = small_clouds.box_cloud("stokes")
    for name in ("here", "there"):
        (tmp_path / name).mkdir()
    observe_both(cloud, {"cells": ParticleStatistics(sigmaParticles=True)}, 3, tmp_path)
    assert (tmp_path / "here/cells/0.6/concentration").exists()


def test_particles_are_found_by_their_numbers():
    cloud = pipe_cloud()
    afar, ranks = on_ranks(cloud, 3)
    assert (afar.size, afar.particles.size) == (40, 14)
    ranks.prepare_steps(afar)
    ranks.mix(np.random.default_rng(2))
    numbers = np.array([39, 0, 17, 17, 2])
    for found, expected in zip(afar.of(numbers), cloud.of(numbers), strict=True):
        assert found.tobytes() == expected.tobytes()
    assert afar.values_of(numbers, "x").tolist() == cloud.values_of(numbers, "x").tolist()
    assert afar.all_particles().x.tobytes() == cloud.particles.x.tobytes()
    assert afar.counts() == cloud.counts()
    assert [p.number[0] for p in afar.map_by_id(same)] == [0, 7, 14, 21, 28, 35]
    assert [p.size for p in afar.map_by_id(same)] == [7, 7, 7, 7, 7, 5]
    nothing = Processes(3)
    nothing.place(0, lambda _: [])
    assert [p.size for p in nothing.map_by_id(same)] == [0]


def test_a_cloud_elsewhere_is_the_same_cloud():
    """Its models, its limits, its fingerprint and what notes and warnings read."""
    cloud = pipe_cloud(integrator="auto")
    afar, _ = on_ranks(cloud, 3, models=dataclasses.replace(cloud.models, integrator="auto"))
    assert (afar.models, afar.stokes_numbers, afar._largest) == (
        cloud.models, cloud.stokes_numbers, cloud._largest,
    )  # fmt: skip
    assert afar.make_ready() == cloud.make_ready()
    assert afar.reach == cloud.reach
    found, expected = (_sums_of_particles(c) for c in (afar, cloud))
    assert list(found) == list(expected)
    assert all(_agree(found[name], expected[name]) for name in expected)
    models = dataclasses.replace(cloud.models, surroundings=(BrownianMotion(T=293.15),))
    afar.models = cloud.models = models
    surveyed = _surveyed(afar)
    for name in BrownianMotion.surveys:
        assert getattr(surveyed, name).tobytes() == getattr(cloud.particles, name).tobytes()
    assert surveyed.size == 40


def test_faults_of_particles_elsewhere_have_the_same_message():
    cloud = pipe_cloud()
    for name, value in (("R", 1.0), ("t0", -1.0), ("rho", 1e300)):
        p = cloud.particles.copy()
        getattr(p, name)[[20, 35]] = value
        messages = []
        for comm in (Communicator(), Processes(3)):
            made_of = {f.name: getattr(cloud, f.name) for f in dataclasses.fields(cloud)}
            own = comm.place(p.size, lambda *_, p=p: cut(p, 0))
            with pytest.raises(InputError) as caught:
                Cloud(**{**made_of, "particles": own, "comm": comm})
            messages.append(str(caught.value))
        assert messages[0] == messages[1]
        assert "20" in messages[0] or "2 of 40" in messages[0]


@pytest.mark.parametrize("before", [1, 2, 5])
def test_ranks_read_their_particles_from_parts_of_other_numbers(before, tmp_path):
    cloud = pipe_cloud()
    written, ranks = on_ranks(cloud, before)
    CloudFunctions(FUNCTIONS, observed(written))
    ranks.prepare_steps(written)
    cloud.advance(20)
    ranks.take(cloud.particles)
    ranks.mix(np.random.default_rng(3))
    for worker in ranks.workers:
        for array in worker.share.memory.values():
            array[:] = (np.arange(array[:1].size) + worker.particles.number[:, None]).reshape(array.shape) % 7
    file = tmp_path / "1.npz"
    parts = ranks.write_parts(file, 1.0)
    assert len(parts) == before
    assert [first for first, _ in parts] == list(ranks.parts)
    assert all(part_file(file, first).exists() for first, _ in parts)
    empty_rows = {f"particles/{k}": a for k, a in empty(0)._asdict().items()}
    empty_rows |= {f"functions/{k}": a[:0] for k, a in ranks.joined().items()}
    write_checkpoint(file, Checkpoint(1.0, {"parts": parts}, empty_rows))

    for again, comm in (on_ranks(pipe_cloud(), 3), ((alone := pipe_cloud()), alone.comm)):
        CloudFunctions(FUNCTIONS, observed(again))
        comm.call(_restore_rank, file)
        for found, expected in zip(again.all_particles(), cloud.particles, strict=True):
            assert found.tobytes() == expected.tobytes()
        restored = comm.joined() if comm.size > 1 else comm.arrays_here()
        assert {k: a.tobytes() for k, a in restored.items()} == {
            k: a.tobytes() for k, a in ranks.joined().items()
        }


def test_a_process_that_cannot_write_still_sends_what_the_others_need(tmp_path, monkeypatch):
    _, ranks = on_ranks(pipe_cloud(), 3)
    file, write = tmp_path / "1.npz", worker_module.write_arrays

    def on_a_full_disk(path, time, header, arrays):
        if path.name.endswith(".14"):
            next(iter(arrays))
            raise OSError(28, "No space left on device")
        return write(path, time, header, arrays)

    monkeypatch.setattr(worker_module, "write_arrays", on_a_full_disk)
    with pytest.raises(OSError, match="No space left"):
        ranks.write_parts(file, 1.0)
    for first, n in ((0, 14), (27, 13)):
        assert StoredCheckpoint(part_file(file, first), verify=True).read("particles/R").shape == (n,)


def test_regrouped_parts_have_the_size_that_is_asked_for():
    p = spheres(np.arange(60.0).reshape(20, 3), d=1.0, rho=1.0, mu=1.0)
    for cuts in ((), (3,), (5, 5, 12), (19,)):
        parts = [p.take(slice(a, b)) for a, b in zip((0, *cuts), (*cuts, 20), strict=True)]
        found = list(regrouped(parts, 8))
        assert [part.size for part in found] == [8, 8, 4]
        assert concatenate(found).x.tobytes() == p.x.tobytes()
    assert [part.size for part in regrouped([p.take(slice(0))], 8)] == [0]
    assert [part.size for part in regrouped([p.take(slice(16))], 8)] == [8, 8]
