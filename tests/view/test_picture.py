"""Pictures and films by VTK, which draws them without a display by Debian's libegl1."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from PIL import Image
from view_run import modes, motion, write_run
from vtkmodules.util.numpy_support import vtk_to_numpy

from foamprb.cli import main
from foamprb.view.canvas import Canvas
from foamprb.view.colours import DARK, LIGHT, rgb
from foamprb.view.picture import _drawing, draw, mark, sphere_for, trails
from foamprb.view.results import open_run
from foamprb.view.show import Request, make_scene, make_still
from foamprb.view.surfaces import bulges

drawn = pytest.mark.browser


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    folder = tmp_path_factory.mktemp("picture") / "cube"
    few = motion(12, 5)
    write_run(folder, few._replace(radius=4.0 * few.radius))
    return folder


def image(path):
    return np.array(Image.open(path).convert("RGB"))


class TestMeshes:
    def test_a_body_is_the_unit_sphere_under_F(self, random):
        """Points and normals, in single precision: x = c + s F X; n ⊥ the images of the tangents."""
        sphere = sphere_for(1)
        F = np.eye(3) + 0.4 * random.standard_normal((2, 3, 3))
        place, size = random.standard_normal((2, 3)), np.array([0.5, 2.0])
        mesh = draw(sphere, place, F, size, np.zeros((2, 3), dtype=np.uint8))
        v = len(sphere.points)
        points = vtk_to_numpy(mesh.GetPoints().GetData()).reshape(2, v, 3)
        normals = vtk_to_numpy(mesh.GetPointData().GetNormals()).reshape(2, v, 3)
        for k in range(2):
            expected = place[k] + size[k] * sphere.points @ F[k].T
            np.testing.assert_allclose(points[k], expected, atol=1e-6)
            tangents = np.cross(sphere.points, random.standard_normal(3)) @ F[k].T
            assert np.abs(np.einsum("ij,ij->i", normals[k], tangents)).max() < 1e-5
        np.testing.assert_allclose(np.linalg.norm(normals, axis=2), 1.0, rtol=1e-6)

    def test_the_normals_of_a_quadratic_mode_are_those_of_its_surface(self, random):
        sphere = sphere_for(1)
        F = np.eye(3) + 0.1 * random.standard_normal((2, 3, 3))
        K = bulges(F, modes(2, 1, 0.2)[0])
        place, size = random.standard_normal((2, 3)), np.array([0.5, 2.0])
        mesh = draw(sphere, place, F, size, np.zeros((2, 3), dtype=np.uint8), K)
        v = len(sphere.points)
        points = vtk_to_numpy(mesh.GetPoints().GetData()).reshape(2, v, 3)
        normals = vtk_to_numpy(mesh.GetPointData().GetNormals()).reshape(2, v, 3)
        along = np.cross(sphere.points, random.standard_normal(3))

        def surface(X, k):
            return place[k] + size[k] * (X @ F[k].T + np.einsum("ijk,vj,vk->vi", K[k], X, X))

        for k in range(2):
            np.testing.assert_allclose(points[k], surface(sphere.points, k), atol=1e-6)
            tangents = surface(sphere.points + 1e-4 * along, k) - surface(sphere.points - 1e-4 * along, k)
            assert np.abs(np.einsum("ij,ij->i", normals[k], tangents / 2e-4)).max() < 1e-5
            assert np.einsum("ij,ij->i", normals[k], points[k] - place[k]).min() > 0.0

    def test_the_sphere_is_round_and_coarser_for_more(self):
        sizes = [len(sphere_for(n).points) for n in (10, 10_000, 100_000)]
        assert sizes == sorted(sizes, reverse=True)
        assert sizes[-1] < 100
        np.testing.assert_allclose(np.linalg.norm(sphere_for(10).points, axis=1), 1.0, rtol=1e-12)

    def test_the_mark_lies_on_the_sphere_along_three_circles_and_around_one_axis(self):
        shape = mark()
        np.testing.assert_allclose(np.linalg.norm(shape.points, axis=1), 1.0, rtol=1e-12)
        near = np.abs(shape.points).min(axis=1) < 0.05
        around = shape.points[:, 0] > 0.95
        assert (near | around).all()
        assert (np.abs(shape.points).min(axis=0) < 0.05).all()


class TestTrails:
    def test_a_trail_ends_at_its_body_and_fades(self, case):
        scene = make_scene(Request(case), open_run(case), range(5))
        points, colours = trails(scene, 4)
        bodies = scene.bodies
        newest = [np.abs(points[:, 1] - x).max(axis=1).argmin() for x in bodies.x[4, bodies.present[3]]]
        np.testing.assert_allclose(points[newest, 1], bodies.x[4, bodies.present[3]])
        assert set(colours[newest, 1, 3]) == {216}
        tail = bodies.times[4] - scene.trail
        assert colours[:, 0, 3].min() == 0 if tail > 0.0 else colours[:, 0, 3].min() < 216

    def test_it_does_not_cross_the_domain_with_a_body_that_jumps(self, case):
        scene = make_scene(Request(case), open_run(case), range(5))
        all_of_them = len(trails(scene, 1)[0])
        scene.bodies.x[1, 1] += 50.0
        assert len(trails(scene, 1)[0]) == all_of_them - 1


def test_the_legend_of_a_picture_names_the_extremes_of_all_times(case):
    run, request = open_run(case), Request(case, time=0.1)
    assert make_still(request, run).extremes == pytest.approx(make_scene(request, run, range(5)).extremes)


@drawn
class TestPictures:
    def test_a_picture(self, case, tmp_path, capfd):
        path = tmp_path / "a.png"
        options = ["-png", str(path), "-size", "800x500", "-slice", "x", "-colour", "U:y"]
        assert main(["view", "-case", str(case), *options]) == 0
        captured = capfd.readouterr()
        assert captured.err == ""
        assert captured.out.startswith("12 bodies")
        found = image(path)
        assert found.shape == (500, 800, 3)
        assert (found[2, 400] == rgb(LIGHT.paper)).all()
        assert len(np.unique(found.reshape(-1, 3), axis=0)) > 1000

    def test_a_dark_one(self, case, tmp_path):
        path = tmp_path / "b.png"
        assert main(["view", "-case", str(case), "-png", str(path), "-size", "400x300", "-dark"]) == 0
        assert (image(path)[2, 200] == rgb(DARK.paper)).all()

    @pytest.mark.parametrize("colour", ["injector", "fate", "d"])
    def test_other_colours(self, case, tmp_path, colour):
        path = tmp_path / "c.png"
        options = ["-png", str(path), "-size", "400x300", "-colour", colour]
        assert main(["view", "-case", str(case), *options]) == 0
        assert path.exists()

    def test_a_gif_has_all_times(self, case, tmp_path):
        pytest.importorskip("imageio")
        path = tmp_path / "a.gif"
        assert main(["view", "-case", str(case), "-film", str(path), "-size", "300x200"]) == 0
        with Image.open(path) as film:
            assert film.n_frames == 5
            frames = []
            for k in range(5):
                film.seek(k)
                frames.append(np.array(film.convert("RGB")).astype(int))
        assert all(np.abs(a - b).mean() > 0.2 for a, b in pairwise(frames))
        assert [file.name for file in tmp_path.iterdir()] == ["a.gif"]

    def test_a_film_has_all_times(self, case, tmp_path):
        ffmpeg = pytest.importorskip("imageio_ffmpeg")
        path = tmp_path / "a.mp4"
        assert main(["view", "-case", str(case), "-film", str(path), "-size", "321x201"]) == 0
        frames, seconds = ffmpeg.count_frames_and_secs(str(path))
        assert frames == 5
        assert seconds == pytest.approx(1.25)

    def test_a_time_of_ones_own(self, case, tmp_path):
        paths = [tmp_path / f"{k}.png" for k in range(2)]
        for path, time in zip(paths, ("0", "0.2"), strict=True):
            assert (
                main(["view", "-case", str(case), "-png", str(path), "-size", "300x200", "-time", time]) == 0
            )
        assert (image(paths[0]) != image(paths[1])).any()

    def test_bodies_beyond_the_picture_are_left_out(self, case):
        scene = make_scene(Request(case), open_run(case), range(5))
        drawing = _drawing(Canvas((900, 300)), scene, LIGHT, texts=True)
        eye = drawing.canvas.camera
        focus, ahead = np.array(eye.GetFocalPoint()), np.subtract(eye.GetFocalPoint(), eye.GetPosition())
        across = np.cross(ahead, eye.GetViewUp())
        slope = math.tan(math.radians(0.5 * eye.GetViewAngle()))
        places = focus + np.array([[0.0], [2.9 * slope], [4.0 * slope]]) * across
        places = np.vstack([places, focus - 2.0 * ahead])
        assert drawing._visible(places, np.zeros(4)).tolist() == [True, True, False, False]
        assert drawing._visible(places, np.full(4, np.linalg.norm(ahead))).all()
        drawing.canvas.close()

    def test_the_scale_bar_has_a_round_length_in_the_plane_of_the_focus(self, case):
        scene = make_scene(Request(case), open_run(case), range(5))
        canvas = _drawing(Canvas((900, 900)), scene, LIGHT, texts=True).canvas
        actors, eye = canvas.actors, canvas.camera
        assert actors["scale"].GetInput() == "200 mm"
        bar = np.ptp(vtk_to_numpy(actors["scale bar"].GetMapper().GetInput().GetPoints().GetData())[:, 0])
        height = (
            2.0
            * np.linalg.norm(np.subtract(eye.GetPosition(), eye.GetFocalPoint()))
            * math.tan(math.radians(eye.GetViewAngle() / 2))
        )
        assert bar / 900 == pytest.approx(0.2 / height, rel=1e-6)
        canvas.close()
