"""Who ends on a patch, when and in what shape."""

from __future__ import annotations

import numpy as np
from observing import AIR, D, column, observe, pipe_cloud, table

from foamprb.body.tensor import principal_frame
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import Status
from foamprb.cloud.tracker import Models
from foamprb.cloudfunctions.base import CloudFunctions, ObservedCloud
from foamprb.cloudfunctions.patch_post_processing import PatchPostProcessing


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


def test_touching_by_the_centre(tmp_path):
    cloud = pipe_cloud()
    centre = Cloud(
        cloud.particles,
        cloud.flow,
        AIR,
        cloud.interactions,
        cloud.dt,
        Models(touching="centre", integrator=cloud.models.integrator),
    )
    observe(centre, PatchPostProcessing(("wall",), maxStoredParcels=3), tmp_path)
    rows = table(tmp_path / "f/wall.csv")
    assert len(rows) == 3
    assert np.isfinite(column(rows, "impactAngle")).all()


def test_a_patch_with_any_name_stays_in_the_folder(tmp_path):
    """The mesh may call a patch anything."""
    cloud = pipe_cloud()
    names = ("../../../wall", "..", "out let")
    functions = CloudFunctions({"f": PatchPostProcessing(names)}, ObservedCloud(cloud, ("one", "two"), names))
    cloud.advance(700)
    functions.write(tmp_path / "a/b/c")
    files = sorted(str(file.relative_to(tmp_path)) for file in tmp_path.rglob("*.*"))
    expected = ["%2E%2E%2F%2E%2E%2F%2E%2E%2Fwall.csv", "%2E%2E.csv", "out%20let.csv"]
    assert files == [f"a/b/c/f/{name}" for name in expected]
    assert len(table(tmp_path / "a/b/c/f" / expected[0])) > 0
