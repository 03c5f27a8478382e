"""Bodies gathered from the files of a run."""

from __future__ import annotations

import dataclasses
import tracemalloc

import numpy as np
import pytest
from view_run import INJECTORS, clouds, motion, write_run

from foamprb.errors import InputError
from foamprb.results.folder import TOUCHED, ResultsFolder
from foamprb.results.pvd import Series
from foamprb.results.shapes import DERIVED, derived
from foamprb.results.tables import read_table, write_table
from foamprb.results.vtk import write_snapshot
from foamprb.view.bodies import UNNAMED, fates_of, fields_of_fates, gather, require_array
from foamprb.view.results import open_run

N, M = 12, 7


@pytest.fixture
def moved():
    return motion(N, M)


@pytest.fixture
def case(tmp_path, moved):
    write_run(tmp_path, moved, mesh=False, fates=True)
    return tmp_path


def replace(case, index, **arrays):
    """Write a snapshot anew with other arrays."""
    folder = case / "postProcessing/softCloud"
    cloud = clouds(motion(N, M))[index]
    points = arrays.pop("points", cloud.points)
    changed = {name: values for name, values in {**cloud.arrays, **arrays}.items() if values is not None}
    write_snapshot(
        folder / f"softCloud_{index:06d}.vtp", dataclasses.replace(cloud, points=points, arrays=changed)
    )


def test_every_time_has_its_own_particles(case, moved):
    bodies = gather(open_run(case), range(M))
    np.testing.assert_array_equal(bodies.ids, np.arange(N))
    np.testing.assert_array_equal(bodies.times, moved.times)
    for k, cloud in enumerate(clouds(moved)):
        np.testing.assert_array_equal(bodies.ids[bodies.present[k]], cloud.arrays["origId"])
        np.testing.assert_array_equal(bodies.x[k, bodies.present[k]], cloud.points)
        assert np.allclose(bodies.F[k, bodies.present[k]], moved.F[k, cloud.arrays["origId"]], atol=1e-6)
    np.testing.assert_allclose(bodies.radius, moved.radius, rtol=1e-12)
    # Before its release a body has the position of its release.
    late = np.flatnonzero(~bodies.present[0])
    release = np.argmax(bodies.present[:, late], axis=0)
    np.testing.assert_array_equal(bodies.x[0, late], moved.x[release, late])


def test_the_order_in_a_file_does_not_matter(case, moved):
    cloud = clouds(moved)[-1]
    order = np.random.default_rng(3).permutation(len(cloud.points))
    replace(case, M - 1, points=cloud.points[order], **{n: a[order] for n, a in cloud.arrays.items()})
    bodies = gather(open_run(case), range(M))
    np.testing.assert_array_equal(bodies.x[-1], moved.x[-1])


def test_statuses_and_what_is_shown(case):
    bodies = gather(open_run(case), range(M))
    assert bodies.status.meanings[bodies.status.codes[-1, 1]] == "stuck"
    assert bodies.shown[-1, 1]
    assert bodies.status.meanings[bodies.status.codes[-1, 2]] == "escaped"
    assert not bodies.shown[-1, 2]
    assert bodies.shown[0, 2]
    assert bodies.codes["patch"].codes[0, 1] == UNNAMED
    assert bodies.codes["injector"].meanings == INJECTORS
    assert bodies.codes["injector"].codes.shape == (1, N)


@pytest.mark.parametrize("with_table", [True, False])
def test_fates_are_those_of_the_table_and_of_the_last_time(case, with_table):
    results = open_run(case)
    bodies = gather(results, range(M))
    fate = fates_of(bodies, results, results.fates() if with_table else None)
    assert fate.meanings == ("active", "stuck on floor", "escaped through lid")
    assert fate.codes[0, :4].tolist() == [0, 1, 2, 0]


def test_bodies_that_touched_at_their_release_are_told(case):
    """Older tables lack the column; the times of release and end tell it, too."""
    results = open_run(case)
    bodies, fates = gather(results, range(M)), results.fates()
    np.testing.assert_array_equal(fates[TOUCHED], False)
    told = fates_of(bodies, results, fates | {TOUCHED: np.arange(N) == 1})
    assert told.meanings == ("active", "stuck on floor at release", "escaped through lid")
    table = results.file("fates")
    write_table(table, {**read_table(table), "t1": read_table(table)["t0"]})
    assert np.flatnonzero(open_run(case).fates()[TOUCHED]).tolist() == [1]


def test_columns_of_fates_become_arrays(case):
    results = open_run(case)
    bodies = gather(results, range(M))
    more = fields_of_fates(bodies, results.fates())
    np.testing.assert_allclose(more["Ca"].values[0, :, 0], np.linspace(0.1, 1.0, N), rtol=1e-6)
    assert more["t1"].unit == "s"


def test_constant_values_are_stored_once(case):
    fields = gather(open_run(case), range(M)).fields
    assert fields["d"].values.shape == (1, N, 1)
    assert fields["U"].values.shape == (M, N, 3)
    assert fields["U"].parts == ("magnitude", "x", "y", "z")
    np.testing.assert_allclose(
        fields["U"].channel("magnitude"), np.linalg.norm(fields["U"].values, axis=2), rtol=1e-6
    )
    np.testing.assert_array_equal(fields["semiAxes"].channel("c"), fields["semiAxes"].values[:, :, 2])
    assert fields["taylorDeformation"].unit == ""


def test_failed_bodies_are_not_drawn(case, moved):
    cloud = clouds(moved)[-1]
    points, glyph = cloud.points.copy(), cloud.arrays["glyph"].copy()
    points[3] = np.nan
    glyph[4] = 1e30
    replace(case, M - 1, points=points, glyph=glyph)
    bodies = gather(open_run(case), range(M))
    assert bodies.present[-1].sum() == N - 2
    assert np.isfinite(bodies.x).all()
    assert np.isfinite(bodies.F).all()
    # They keep their last valid position.
    np.testing.assert_array_equal(bodies.x[-1, 3], bodies.x[-2, 3])


def test_some_of_the_bodies(case, moved):
    bodies = gather(open_run(case), range(M), most=5)
    np.testing.assert_array_equal(bodies.ids, [0, 2, 4, 7, 9])
    np.testing.assert_array_equal(bodies.x[-1], moved.x[-1, bodies.ids])


def test_some_of_the_times(case):
    whole, some = (gather(open_run(case), frames) for frames in (range(M), [0, 3, 6]))
    np.testing.assert_array_equal(whole.x[[0, 3, 6]][some.present], some.x[some.present])
    np.testing.assert_array_equal(whole.present[[0, 3, 6]], some.present)
    assert some.fields["d"].values.shape == (1, N, 1)


def test_some_of_the_arrays(case):
    assert set(gather(open_run(case), range(M), arrays=("U",)).fields) == {"U"}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("taylorDeformation", ("taylorDeformation", "")),
        ("U", ("U", "magnitude")),
        ("U:y", ("U", "y")),
        ("semiAxes", ("semiAxes", "a")),
        ("injector", ("injector", "")),
        ("fate", ("fate", "")),
        ("Ca", ("Ca", "")),
    ],
)
def test_arrays_by_name(case, text, expected):
    assert require_array(open_run(case), text) == expected


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("taylorDeformatoin", "Did you mean 'taylorDeformation'?"),
        ("glyph", "no such array"),
        ("U:w", "Allowed: magnitude, x, y, z"),
        ("d:x", "It has no components"),
    ],
)
def test_unknown_arrays_are_refused(case, text, said):
    with pytest.raises(InputError, match=said.replace("?", r"\?")):
        require_array(open_run(case), text)


class TestDamage:
    def test_a_damaged_list(self, case):
        pvd = case / "postProcessing/softCloud/softCloud.pvd"
        pvd.write_text(pvd.read_text()[:200])
        with pytest.raises(InputError, match=r"softCloud\.pvd"):
            open_run(case)

    def test_an_empty_list(self, case):
        pvd = case / "postProcessing/softCloud/softCloud.pvd"
        pvd.write_text('<VTKFile type="Collection"><Collection/></VTKFile>')
        with pytest.raises(InputError, match="lists no files"):
            open_run(case)

    @pytest.mark.parametrize("share", [0.0, 0.3, 0.9])
    def test_a_file_cut_short(self, case, share, capfd):
        results = open_run(case)
        path = case / "postProcessing/softCloud/softCloud_000002.vtp"
        path.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])
        fault = r"softCloud_000002\.vtp(: damaged \(| is damaged: ).*foamprb run"
        with pytest.raises(InputError, match=fault):
            gather(results, range(M))
        assert capfd.readouterr() == ("", "")

    def test_a_missing_file(self, case):
        (case / "postProcessing/softCloud/softCloud_000001.vtp").unlink()
        with pytest.raises(InputError, match=r"softCloud_000001\.vtp: missing"):
            gather(open_run(case), range(M))

    def test_a_file_of_another_run(self, case):
        replace(case, 2, shearRate=None)
        with pytest.raises(InputError, match=r"softCloud_000002\.vtp: no array 'shearRate'"):
            gather(open_run(case), range(M))

    def test_files_without_shapes_are_refused(self, case):
        replace(case, M - 1, glyph=None)
        with pytest.raises(InputError, match="no array 'glyph'"):
            open_run(case)

    def test_a_particle_twice(self, case, moved):
        ids = clouds(moved)[-1].arrays["origId"].copy()
        ids[3] = ids[4]
        replace(case, M - 1, origId=ids)
        with pytest.raises(InputError, match="a particle is in it twice"):
            gather(open_run(case), range(M))

    def test_a_damaged_table(self, case):
        (case / "postProcessing/softCloud/fates.csv").write_text("id,fate\n0\n")
        with pytest.raises(InputError, match=r"fates\.csv is no table: its lines have different"):
            open_run(case).fates()
        (case / "postProcessing/softCloud/fates.csv").write_text("id,fate\n0,stuck\n")
        with pytest.raises(InputError, match=r"fates\.csv is not the table"):
            open_run(case).fates()


def test_a_cloud_without_particles(tmp_path):
    folder = tmp_path / "postProcessing/softCloud"
    empty = clouds(motion(1, 1))[0]
    none = dataclasses.replace(
        empty, points=np.zeros((0, 3)), arrays={name: array[:0] for name, array in empty.arrays.items()}
    )
    folder.mkdir(parents=True)
    Series(ResultsFolder(folder, "softCloud")).append(none)
    bodies = gather(open_run(tmp_path), [0])
    assert bodies.x.shape == (1, 0, 3)


def test_few_of_many_bodies_take_memory_for_one_file_only(tmp_path):
    write_run(tmp_path, motion(20_000, 4), mesh=False)
    run = open_run(tmp_path)
    size = sum(array.nbytes for array in run.cloud(-1, set(run.components) - set(DERIVED)).arrays.values())
    tracemalloc.start()
    gather(run, range(4), most=10)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 2.0 * size


@pytest.mark.parametrize(("one", "equal"), [(0, 0), (0, 1), (1, 2)])
def test_shapes_in_single_precision_need_no_eigenvectors(one, equal):
    F = motion(500, 1).F[0] + 0.3 * np.random.default_rng(3).standard_normal((500, 3, 3))
    U, s, V = np.linalg.svd(F)
    s[:, equal] = s[:, one]
    F = (U * s[:, None]) @ V
    d, status = np.full(500, 2.0), np.ones(500)
    glyph = F.swapaxes(1, 2).reshape(-1, 9)
    names = ("semiAxes", "taylorDeformation")
    quick, exact = (derived(array, d, status, names) for array in (glyph.astype(np.float32), glyph))
    for name in names:
        np.testing.assert_allclose(quick[name], exact[name], rtol=0.0, atol=4e-7)
