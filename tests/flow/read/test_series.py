"""Several times of a case or a file as one flow: what is kept in memory, and what is said."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from mesh_shapes import block

from foamprb.errors import InputError
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.read import series
from foamprb.flow.read.series import series_of

NAMES = ("0", "0.5", "1.0", "1.5")


@pytest.fixture(scope="module")
def mesh():
    return build_mesh(block(2, 0.0))


def flow_of(mesh, period=None, names=NAMES, turbulent=False, log=None, **options):
    n = mesh.n_points + mesh.n_cells

    def read(name):
        if log is not None:
            log.append(name)
        f = float(name)
        fields = np.full((n, 3), f), np.zeros((n, 3, 3)), np.full((n, 8), f)
        return fields if turbulent else fields[:2]

    return series_of(Path("case"), mesh, names, read, period, ["a note."], turbulent=turbulent, **options)


def test_times_are_read_by_their_names(mesh):
    log = []
    flow = flow_of(mesh, log=log)
    x = np.array([[0.3, 0.4, 0.6]])
    u, _ = flow.sample(x, flow.locate(x), 1.2)
    assert u[0] == pytest.approx([1.2] * 3)
    assert log[:2] == ["1.0", "1.5"]
    assert flow.times == (0.0, 0.5, 1.0, 1.5)
    assert flow.notes == ("a note.", "The flow is linear in time between 4 times from 0 to 1.5.")
    assert flow_of(mesh, 2.0).notes[-1] == (
        "The flow is linear in time between 4 times from 0 to 1.5, and repeats itself every 2 s."
    )


@pytest.mark.parametrize(("turbulent", "columns"), [(False, 12), (True, 20)])
def test_all_times_of_a_period_are_kept_if_they_have_room(turbulent, columns, mesh, monkeypatch):
    """Eight bytes for each column at each node; otherwise only what a step needs."""
    a_time = 8 * columns * (mesh.n_points + mesh.n_cells)
    for room, kept in ((4 * a_time, 4), (4 * a_time - 1, 3), (a_time, 2)):
        monkeypatch.setattr(series, "_MOST_IN_MEMORY", room)
        flow = flow_of(mesh, 2.0, turbulent=turbulent)
        for start in (0.0, 0.5, 1.0):
            flow.load(start, start + 0.5)
        assert flow._fields.nbytes == kept * a_time
    once = flow_of(mesh, turbulent=turbulent)
    once.load(0.0, 0.5)
    assert once._fields.nbytes == 2 * a_time


def test_messages_name_the_case(mesh):
    with pytest.raises(InputError, match=r"^case: the times 0, 2, 1 do not rise\.$"):
        flow_of(mesh, names=("0", "2", "1"))
    with pytest.raises(InputError, match=r"^case: the period 9 s asks for fields up to nearly 9 s"):
        flow_of(mesh, 9.0)


def test_zones_of_cells_go_with_the_flow(mesh):
    flow = flow_of(mesh, zones=lambda: {"some": np.array([3])})
    assert flow.cell_zone("some").volumes.sum() == pytest.approx(mesh.volumes[3])
