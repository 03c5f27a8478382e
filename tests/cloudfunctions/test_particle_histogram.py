"""What particles have been through, against a fine record of it."""

from __future__ import annotations

import numpy as np
import pytest
from observing import MEAN, RADIUS, WATER, column, observe, pipe_cloud, table

from foamprb.cloud.measures import MEASURES, context
from foamprb.cloudfunctions.base import ObservedCloud
from foamprb.cloudfunctions.particle_histogram import ParticleHistogram
from foamprb.cloudfunctions.registry import CloudFunctions
from foamprb.errors import InputError


def test_exposure_in_a_steady_shear_is_rate_times_time(tmp_path):
    cloud = pipe_cloud(medium=WATER)
    p = cloud.particles
    r = np.hypot(p.x[:, 1], p.x[:, 2])
    observe(cloud, ParticleHistogram(nBins=7), tmp_path)
    rows = table(tmp_path / "f/exposure.csv")
    assert [int(row["id"]) for row in rows] == list(range(p.size))
    age = p.t - p.t0
    np.testing.assert_allclose(column(rows, "residenceTime"), age, rtol=1e-12)
    expected = 4.0 * MEAN * r / RADIUS**2 * age
    np.testing.assert_allclose(column(rows, "shearExposure"), expected, rtol=1e-6)


def test_deformation_is_the_largest_and_the_mean_of_a_fine_record(tmp_path):
    record = pipe_cloud()
    n = record.particles.size
    times, shapes = [record.particles.t.copy()], [np.zeros(n)]
    for _ in range(700):
        record.advance(1)
        c = context(
            record.particles._replace(status=np.ones(n, dtype=np.int8)), record.flow, 1.0, record.time
        )
        times.append(record.particles.t.copy())
        shapes.append(MEASURES["taylorDeformation"].value(c))
    t, D_path = np.array(times), np.array(shapes)
    mean = np.sum(0.5 * np.diff(t, axis=0) * (D_path[1:] + D_path[:-1]), axis=0) / (t[-1] - t[0])
    observe(pipe_cloud(), ParticleHistogram(), tmp_path)
    rows = table(tmp_path / "f/exposure.csv")
    np.testing.assert_allclose(column(rows, "maxDeformation"), D_path.max(axis=0), atol=1e-3)
    np.testing.assert_allclose(column(rows, "meanDeformation"), mean, atol=1e-3)


def test_the_bins_hold_everybody(tmp_path):
    cloud = pipe_cloud()
    observe(cloud, ParticleHistogram(nBins=7), tmp_path)
    exposure = table(tmp_path / "f/exposure.csv")
    for field in ParticleHistogram().fields:
        rows = table(tmp_path / f"f/{field}.csv")
        assert len(rows) == 7
        np.testing.assert_array_equal(column(rows, "lower")[1:], column(rows, "upper")[:-1])
        for name in ("one", "two"):
            own = column([row for row in exposure if row["injector"] == name], field)
            edges = np.append(column(rows, "lower"), column(rows, "upper")[-1])
            np.testing.assert_array_equal(column(rows, name), np.histogram(own, edges)[0])
            assert column(rows, name).sum() == 20


def test_an_injection_model_called_as_a_column_is_refused():
    cloud = ObservedCloud(pipe_cloud(2), {"injector": ("lower", "two"), "patch": ()})
    with pytest.raises(InputError, match="cloudFunctions/f: no injection model may be called lower"):
        CloudFunctions({"f": ParticleHistogram()}, cloud)
