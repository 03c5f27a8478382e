"""Particles at homes, without MPI: the workers of several processes in one."""

from __future__ import annotations

import dataclasses
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import small_clouds
import thread_mpi
from observing import observed, pipe_cloud

from foamprb.cloud.cloud import Cloud, Stepper, regrouped, same
from foamprb.cloud.patches import Escape, Rebound
from foamprb.cloud.state import Particles, concatenate, empty, spheres
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloudfunctions.base import StepObserver
from foamprb.cloudfunctions.deformability_cytometry import DeformabilityCytometry
from foamprb.cloudfunctions.haemolysis import Haemolysis
from foamprb.cloudfunctions.particle_collector import ParticleCollector
from foamprb.cloudfunctions.particle_histogram import ParticleHistogram
from foamprb.cloudfunctions.particle_statistics import ParticleStatistics
from foamprb.cloudfunctions.particle_tracks import ParticleTracks
from foamprb.cloudfunctions.patch_post_processing import PatchPostProcessing
from foamprb.cloudfunctions.registry import CloudFunctions
from foamprb.cloudfunctions.suspension_stress import SuspensionStress
from foamprb.errors import InputError
from foamprb.parallel import worker as worker_module
from foamprb.parallel.homes import RankHomes
from foamprb.parallel.sampling import Sampling
from foamprb.parallel.worker import Worker
from foamprb.results.checkpoint import Checkpoint, part_file, read_checkpoint, write_checkpoint
from foamprb.run.description import _surveyed
from foamprb.run.restart import _agree, _sums_of_particles

PLANE = (0.004, 0.0, 0.0), (1.0, 0.0, 0.0)
FUNCTIONS = {
    "loads": ParticleHistogram(sampleInterval=5),
    "plane": ParticleCollector("plane", *PLANE, sampleInterval=5),
    "camera": DeformabilityCytometry(*PLANE, view=(0.0, 0.0, 1.0), sampleInterval=5),
    "blood": Haemolysis("Ding", "morphology", sampleInterval=5),
    "paths": ParticleTracks(5, 100, maxTracks=13),
    "hits": PatchPostProcessing(("wall", "outlet")),
    "stress": SuspensionStress(),
}


class Processes:
    """Workers of several processes, without a flow of their own."""

    def __init__(self, n: int) -> None:
        self._comms = thread_mpi.processes(n)
        modules = [thread_mpi.Mpi(comm) for comm in self._comms]
        self.workers = thread_mpi.together([partial(Worker, module) for module in modules])

    def order(self, name: str, *arguments: Any, own: tuple[Any, ...] = ()) -> list[Any]:
        works = [partial(getattr(w, name), *arguments, *(own if w.rank == 0 else ())) for w in self.workers]
        return thread_mpi.together(works)

    def homes_of(self, p: Particles) -> RankHomes:
        parts = [p.take(slice(k, k + 11)) for k in range(0, p.size, 11)]
        return RankHomes(self.workers[0], self.order, p.size, parts)

    def set_out(self, sampling: Sampling, cloud: Cloud) -> None:
        """Let the particles set out, and the workers sample them."""
        for worker in self.workers:
            worker._sampling, worker._tracker = sampling, cloud.tracker
            worker._flow = cloud.make_ready()
        self.order("set_out", [list(range(len(self.workers)))])

    def before_steps(self, start: float, until: float) -> None:
        for worker in self.workers:
            functions = worker._sampling.names_of(StepObserver)
            worker._observe(functions, start, lambda f, memory, cloud: f.before_steps(memory, cloud, until))

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
        works = [partial(w._send, *given) for w, *given in zip(self.workers, rows, to, strict=True)]
        thread_mpi.together(works)

    def joined(self) -> dict[str, np.ndarray]:
        """Return what cloud functions remember of all particles, by their numbers, and sums of all cells."""
        order = np.argsort(np.concatenate([w.particles.number for w in self.workers]))
        names, sums = self.workers[0].own.memory, self.workers[0]._sums
        found = {k: np.concatenate([w.own.memory[k] for w in self.workers])[order] for k in names}
        return found | {f"{k}/sums": np.concatenate([w._sums[k][1] for w in self.workers]) for k in sums}


@pytest.fixture(autouse=True)
def _small_parts(monkeypatch):
    monkeypatch.setattr("foamprb.cloud.cloud.PART", 7)
    monkeypatch.setattr("foamprb.cloudfunctions.base.CELLS", 5)


def at_homes(cloud: Cloud, n: int, **changes: Any) -> tuple[Cloud, Processes]:
    """Return a cloud of the same particles that n processes hold."""
    processes = Processes(n)
    homes = processes.homes_of(cloud.particles.copy())
    made_of = {f.name: getattr(cloud, f.name) for f in dataclasses.fields(cloud)}
    return Cloud(**{**made_of, **changes, "particles": homes.particles, "homes": homes}), processes


def assert_same_files(folder: Path, others: Path) -> None:
    files = sorted(f.relative_to(folder) for f in folder.rglob("*") if f.is_file())
    assert files == sorted(f.relative_to(others) for f in others.rglob("*") if f.is_file())
    for file in files:
        assert (folder / file).read_bytes() == (others / file).read_bytes(), file


def observe_both(cloud: Cloud, functions: dict[str, Any], n: int, folder: Path) -> None:
    """Observe a cloud here and elsewhere; all files and all that is remembered are the same."""
    afar, processes = at_homes(cloud, n)
    here, there = (CloudFunctions(functions, observed(c)) for c in (cloud, afar))
    travelling = there.travelling
    rest = [name for name in functions if name not in travelling]
    processes.set_out(Sampling.of(there, cloud.medium), cloud)
    afar.particles, random = empty(0), np.random.default_rng(1)
    for k in range(30):
        start, until = (cloud.start + (cloud.step + steps) * cloud.dt for steps in (0, 10))
        processes.before_steps(start, until)
        Stepper(cloud, here).advance(10)
        processes.take(cloud.particles)
        processes.mix(random)
        afar.step = cloud.step
        rows = cloud.take_rebounds()
        for functions_of, names in ((here, functions), (there, rest)):
            functions_of.record_rebounds(rows, names)
        processes.order("record", rows, cloud.time)
        here.sample(list(functions))
        processes.order("sample", travelling, cloud.time)
        processes.order("add_up", there.summing)
        there.sample(rest)
        there.add_events(processes.order("take_events"))
        if k % 10 == 9:
            here.write(folder / "here")
            there.write(folder / "there")
    assert_same_files(folder / "here", folder / "there")
    found, expected = there.state() | processes.joined(), here.state()
    assert list(found) == list(expected)
    assert len({w.particles.size for w in processes.workers}) > 1 or n == 1
    for name, array in expected.items():
        assert found[name].dtype == array.dtype
        assert found[name].tobytes() == array.tobytes(), name


@pytest.mark.parametrize("n", [1, 3])
def test_functions_write_the_same_of_particles_elsewhere(n, tmp_path):
    for name in ("here", "there"):
        (tmp_path / name).mkdir()
    cloud = pipe_cloud()
    observe_both(cloud, FUNCTIONS, n, tmp_path)
    assert {*cloud.particles.status.tolist()} >= {1, 2}


def test_rebounds_of_particles_elsewhere_are_recorded(tmp_path):
    for name in ("here", "there"):
        (tmp_path / name).mkdir()
    cloud = pipe_cloud(walls=(Rebound(0.5, 0.1), Escape(), Escape()), integrator="rosenbrock", rebounds=True)
    observe_both(cloud, FUNCTIONS, 3, tmp_path)
    assert (tmp_path / "here/hits/wall.csv").read_text().count("rebound") > 10


def test_fields_on_the_mesh_are_those_of_one_process(tmp_path):
    cloud = small_clouds.box_cloud("stokes")
    for name in ("here", "there"):
        (tmp_path / name).mkdir()
    observe_both(cloud, {"cells": ParticleStatistics(sigmaParticles=True)}, 3, tmp_path)
    assert (tmp_path / "here/cells/0.6/concentration").exists()


def test_particles_are_found_by_their_numbers():
    cloud = pipe_cloud()
    afar, processes = at_homes(cloud, 3)
    assert (afar.size, afar.particles.size) == (40, 14)
    processes.set_out(Sampling.of(CloudFunctions({}, observed(afar)), cloud.medium), cloud)
    processes.mix(np.random.default_rng(2))
    numbers = np.array([39, 0, 17, 17, 2])
    for found, expected in zip(afar.of(numbers), cloud.of(numbers), strict=True):
        assert found.tobytes() == expected.tobytes()
    assert afar.values_of(numbers, "x").tolist() == cloud.values_of(numbers, "x").tolist()
    assert afar.whole().x.tobytes() == cloud.particles.x.tobytes()
    assert afar.counts() == cloud.counts()
    assert [p.number[0] for p in afar.in_order(same)] == [0, 7, 14, 21, 28, 35]
    assert [p.size for p in afar.in_order(same)] == [7, 7, 7, 7, 7, 5]
    assert [p.size for p in Processes(3).homes_of(empty(0)).in_order(same)] == [0]


def test_a_cloud_elsewhere_is_the_same_cloud():
    """Its models, its limits, its fingerprint and what notes and warnings read."""
    cloud = pipe_cloud(integrator="auto")
    afar, _ = at_homes(cloud, 3, models=dataclasses.replace(cloud.models, integrator="auto"))
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
    for name in BrownianMotion.traits.surveys:
        assert getattr(surveyed, name).tobytes() == getattr(cloud.particles, name).tobytes()
    assert surveyed.size == 40


def test_faults_of_particles_elsewhere_have_the_same_message():
    cloud = pipe_cloud()
    for name, value in (("R", 1.0), ("t0", -1.0), ("rho", 1e300)):
        p = cloud.particles.copy()
        getattr(p, name)[[20, 35]] = value
        messages = []
        for homes in (None, Processes(3).homes_of(p)):
            made_of = {f.name: getattr(cloud, f.name) for f in dataclasses.fields(cloud)}
            own = p if homes is None else homes.particles
            with pytest.raises(InputError) as caught:
                Cloud(**{**made_of, "particles": own, "homes": homes})
            messages.append(str(caught.value))
        assert messages[0] == messages[1]
        assert "20" in messages[0] or "2 of 40" in messages[0]


@pytest.mark.parametrize("before", [1, 2, 5])
def test_homes_read_their_particles_from_parts_of_other_numbers(before, tmp_path):
    cloud = pipe_cloud()
    written, processes = at_homes(cloud, before)
    functions = CloudFunctions(FUNCTIONS, observed(written))
    written.homes.share_sums("cells", (11, 2))
    for worker in processes.workers:
        first, sums = worker._sums["cells"]
        sums[:] = np.arange(*first[worker.rank : worker.rank + 2])[:, None] + [0.5, 0.25]
    processes.set_out(Sampling.of(functions, cloud.medium), cloud)
    cloud.advance(20)
    processes.take(cloud.particles)
    processes.mix(np.random.default_rng(3))
    for worker in processes.workers:
        for array in worker.own.memory.values():
            array[:] = (np.arange(array[:1].size) + worker.particles.number[:, None]).reshape(array.shape) % 7
    file = tmp_path / "1.checkpoint"
    parts = written.homes.write_parts(file, 1.0)
    assert len(parts) == before
    assert [first for first, _ in parts] == list(written.homes.firsts)
    assert all(part_file(file, first).exists() for first, _ in parts)
    empty_rows = {f"particles/{k}": a for k, a in empty(0)._asdict().items()}
    empty_rows |= {f"functions/{k}": a[:0] for k, a in processes.joined().items()}
    write_checkpoint(file, Checkpoint(1.0, {"parts": parts}, empty_rows))

    again, others = at_homes(pipe_cloud(), 3)
    CloudFunctions(FUNCTIONS, observed(again))
    again.homes.share_sums("cells", (11, 2))
    again.homes.restore(file)
    assert again.homes.of_cells("cells", slice(2, 9))[:, 0].tolist() == (np.arange(2, 9) + 0.5).tolist()
    for found, expected in zip(again.whole(), cloud.particles, strict=True):
        assert found.tobytes() == expected.tobytes()
    expected = processes.joined()
    for name, found in others.joined().items():
        assert found.tobytes() == expected[name].tobytes(), name
    assert others.workers[1].particles.size == 13


@pytest.mark.parametrize("particles", [0, 1, 2, 40])
def test_processes_that_write_checkpoints_have_all_sums(particles):
    processes = Processes(3)
    homes = processes.homes_of(pipe_cloud().particles.take(slice(particles)))
    homes.share_sums("cells", (11, 2))
    of_each = [len(w._sums["cells"][1]) for w in processes.workers]
    assert of_each == {0: [11, 0, 0], 1: [11, 0, 0], 2: [5, 6, 0], 40: [3, 4, 4]}[particles]


def test_a_process_that_cannot_write_still_sends_what_the_others_need(tmp_path, monkeypatch):
    written, _ = at_homes(pipe_cloud(), 3)
    file, write = tmp_path / "1.checkpoint", worker_module.write_arrays

    def on_a_full_disk(path, time, header, arrays):
        if path.name.endswith(".14"):
            next(iter(arrays))
            raise OSError(28, "No space left on device")
        return write(path, time, header, arrays)

    monkeypatch.setattr(worker_module, "write_arrays", on_a_full_disk)
    with pytest.raises(OSError, match="No space left"):
        written.homes.write_parts(file, 1.0)
    for first, n in ((0, 14), (27, 13)):
        assert read_checkpoint(part_file(file, first)).arrays["particles/R"].shape == (n,)


def test_regrouped_parts_have_the_size_that_is_asked_for():
    p = spheres(np.arange(60.0).reshape(20, 3), d=1.0, rho=1.0, mu=1.0)
    for cuts in ((), (3,), (5, 5, 12), (19,)):
        parts = [p.take(slice(a, b)) for a, b in zip((0, *cuts), (*cuts, 20), strict=True)]
        found = list(regrouped(parts, 8))
        assert [part.size for part in found] == [8, 8, 4]
        assert concatenate(found).x.tobytes() == p.x.tobytes()
    assert [part.size for part in regrouped([p.take(slice(0))], 8)] == [0]
    assert [part.size for part in regrouped([p.take(slice(16))], 8)] == [8, 8]
