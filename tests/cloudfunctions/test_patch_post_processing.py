"""Who ends on a patch, when and in what shape."""

from __future__ import annotations

import numpy as np
from observing import AIR, RADIUS, D, column, go_on, observe, observed, pipe_cloud, table

from foamprb.body.tensor import principal_frame
from foamprb.cloud.block import Medium
from foamprb.cloud.patches import Escape, Rebound
from foamprb.cloud.state import Status
from foamprb.cloudfunctions.base import ObservedCloud
from foamprb.cloudfunctions.patch_post_processing import PatchPostProcessing
from foamprb.cloudfunctions.registry import CloudFunctions


def test_who_hits_when_and_in_what_shape(tmp_path):
    cloud = pipe_cloud()
    observe(cloud, PatchPostProcessing(("wall", "outlet")), tmp_path)
    p = cloud.particles
    seen = 0
    for index, name, status in ((0, "wall", Status.STUCK), (2, "outlet", Status.ESCAPED)):
        rows = table(tmp_path / f"f/{name}.csv")
        k = column(rows, "id").astype(int)
        seen += len(k)
        assert set(k) == set(np.flatnonzero((p.patch == index) & (p.status == status)))
        np.testing.assert_array_equal(column(rows, "t"), np.sort(p.t[k]))
        np.testing.assert_array_equal(column(rows, "t"), p.t[k])
        np.testing.assert_array_equal(column(rows, "y"), p.x[k, 1])
        assert [row["injector"] for row in rows] == [("one", "two")[i % 2] for i in k]
        np.testing.assert_allclose(column(rows, "mass"), 2560.0 * np.pi / 6.0 * D**3, rtol=1e-14)
        frame, stretches = principal_frame(tuple(p.F[k].T))
        axes = np.sort(np.stack(stretches, axis=1) * D / 2.0, axis=1)[:, ::-1]
        np.testing.assert_allclose(np.stack([column(rows, c) for c in "abc"], axis=1), axes, rtol=1e-12)
        # The normal that points out of the fluid: radial on the wall, along the pipe at its end.
        out = p.x[k] * [0.0, 1.0, 1.0] if name == "wall" else np.tile([1.0, 0.0, 0.0], (len(k), 1))
        out /= np.linalg.norm(out, axis=1)[:, None]
        cosine = np.einsum("ni,ni->n", p.v[k], out) / np.linalg.norm(p.v[k], axis=1)
        np.testing.assert_allclose(np.cos(np.radians(column(rows, "impactAngle"))), cosine, atol=1e-9)
        longest = np.argmax(np.stack(stretches), axis=0)
        e = np.stack(frame, axis=1).reshape(-1, 3, 3)[np.arange(len(k)), longest]
        cosine = np.abs(np.einsum("ni,ni->n", e, out))
        np.testing.assert_allclose(np.cos(np.radians(column(rows, "axisAngle"))), cosine, atol=1e-9)
    assert seen == p.size


def test_a_patch_with_any_name_stays_in_the_folder(tmp_path):
    """The mesh may call a patch anything."""
    cloud = pipe_cloud()
    names = ("../../../wall", "..", "out let")
    seen = ObservedCloud(cloud, {"injector": ("one", "two"), "patch": names})
    functions = CloudFunctions({"f": PatchPostProcessing(names)}, seen)
    cloud.advance(700)
    (tmp_path / "a/b/c").mkdir(parents=True)
    functions.write(tmp_path / "a/b/c")
    files = sorted(str(file.relative_to(tmp_path)) for file in tmp_path.rglob("*.*"))
    expected = ["%2E%2E%2F%2E%2E%2F%2E%2E%2Fwall.csv", "%2E%2E.csv", "out%20let.csv"]
    assert files == [f"a/b/c/f/{name}" for name in expected]
    assert len(table(tmp_path / "a/b/c/f" / expected[0])) > 0


BOUNCING = (Rebound(0.5, 0.1), Escape(), Escape())


def bouncing_cloud():
    """One that goes towards the wall by less than a body in a step."""
    medium = Medium(AIR.mu, AIR.rho, (0.0, -40.0, 0.0))
    cloud = pipe_cloud(medium=medium, walls=BOUNCING, integrator="rosenbrock", rebounds=True)
    cloud.particles.x[:, 1:] *= 0.999 / 0.97
    return cloud


def test_rebounds_with_the_velocity_before(tmp_path):
    cloud = bouncing_cloud()
    observe(cloud, PatchPostProcessing(("wall", "outlet")), tmp_path)
    rows, p = table(tmp_path / "f/wall.csv"), cloud.particles
    assert {row["fate"] for row in rows} == {"rebound"}
    assert {row["fate"] for row in table(tmp_path / "f/outlet.csv")} == {"escaped"}
    k, t = column(rows, "id").astype(int), column(rows, "t")
    assert len(k) > len(set(k)) > 0
    assert (np.diff(t) >= 0.0).all()
    assert (t > p.t0[k]).all()
    # In touch with the wall, on the way to it, and in a shape of the same volume.
    x, v = (np.stack([column(rows, c) for c in names], axis=1) for names in (("y", "z"), ("Uy", "Uz")))
    a, b, c = (column(rows, name) for name in "abc")
    gap = RADIUS - np.hypot(*x.T)
    assert ((c * 0.9999 < gap) & (gap < a * 1.0001)).all()
    assert (np.einsum("ni,ni->n", x, v) > 0.0).all()
    assert (column(rows, "impactAngle") < 90.0).all()
    np.testing.assert_allclose(a * b * c, (D / 2) ** 3, rtol=2e-3)
    np.testing.assert_allclose(column(rows, "D"), (a - c) / (a + c), rtol=1e-9)


def test_rebounds_after_a_restart(tmp_path):
    """Stopped between two write times, with all that is remembered at hand: the same table in the end."""
    whole, parts = PatchPostProcessing(("wall",)), PatchPostProcessing(("wall",))
    observe(bouncing_cloud(), whole, tmp_path / "whole")
    cloud = bouncing_cloud()
    functions = observe(cloud, parts, tmp_path / "parts", (200,))
    cloud.advance(77)
    memory = {name: array.copy() for name, array in functions.state().items()}
    again = CloudFunctions({"f": parts}, observed(cloud))
    again.restore(memory, memory.get)
    go_on(cloud, again, tmp_path / "parts", (400, 700))
    assert (tmp_path / "parts/f/wall.csv").read_bytes() == (tmp_path / "whole/f/wall.csv").read_bytes()
    observe(bouncing_cloud(), PatchPostProcessing(("wall",), maxStoredParcels=4), tmp_path / "few")
    assert table(tmp_path / "few/f/wall.csv") == table(tmp_path / "whole/f/wall.csv")[:4]
