"""Page in Chromium: drawing, selection, controls, and no request to any network."""

from __future__ import annotations

import base64
import csv
import io
import math
import re
import shutil
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from view_run import Motion, modes, motion, write_run

from foamprb.view.colours import LIGHT, colour_map, colour_of_name, rgb
from foamprb.view.notebook import ViewPage
from foamprb.view.picture import picture
from foamprb.view.results import open_run
from foamprb.view.scene import VIEW_ANGLE, Scene
from foamprb.view.show import Request, make_scene, write_page

CHROMIUM = shutil.which("chromium")
pytestmark = [pytest.mark.browser, pytest.mark.skipif(CHROMIUM is None, reason="chromium is not on PATH")]

SOFTWARE = (
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
)
WIDTH, HEIGHT = 1200, 800
N, M = 30, 8


@pytest.fixture(scope="module")
def moved() -> Motion:
    few = motion(N, M)
    return few._replace(radius=3.0 * few.radius)


@pytest.fixture(scope="module")
def request_(tmp_path_factory, moved) -> Request:
    case = tmp_path_factory.mktemp("browser") / "cube"
    write_run(case, moved, fates=True)
    return Request(case, slice="z=0.02", enlargement=1.5)


@pytest.fixture(scope="module")
def address(request_) -> str:
    return write_page(request_, None, 30.0, "1.2.3").as_uri()


@pytest.fixture(scope="module")
def scene(request_) -> Scene:
    return make_scene(request_, open_run(request_.case), range(M))


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    api = pytest.importorskip("playwright.sync_api")
    with api.sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=CHROMIUM, args=list(SOFTWARE))
        yield chromium
        chromium.close()


class Tab:
    """Page of the browser, with its messages and requests."""

    def __init__(self, browser: Any, address: str, words: str = "", **options: Any) -> None:
        size = {"width": WIDTH, "height": HEIGHT}
        self.page = browser.new_page(**{"viewport": size, "color_scheme": "light", **options})
        self.messages: list[str] = []
        self.requests: list[str] = []
        self.page.on("console", lambda message: self.messages.append(message.text))
        self.page.on("pageerror", lambda error: self.messages.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(f"{address}#{words}")
        self.run("foamprb.ready")
        self.run("foamprb.draw()")

    def run(self, script: str) -> Any:
        return self.page.evaluate(f"async () => await ({script})")

    def wait(self, condition: str) -> None:
        """Wait for a condition; the policy of the page forbids Playwright's own function."""
        until = time.monotonic() + 30.0
        while not self.run(condition):
            assert time.monotonic() < until, condition
            time.sleep(0.05)

    def text(self, name: str) -> str:
        return str(self.page.locator(f"#{name}").inner_text())

    def pixels(self) -> NDArray[np.uint8]:
        """Return the picture on the screen, (height, width, 3)."""
        self.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        return np.array(Image.open(io.BytesIO(self.page.screenshot())).convert("RGB"))


@pytest.fixture
def tab(browser, address, request) -> Iterator[Tab]:
    found = getattr(request, "param", {})
    opened = Tab(browser, address, **found)
    yield opened
    try:
        assert opened.messages == []
        assert [url for url in opened.requests if not url.startswith((address, "blob:"))] == []
    finally:
        opened.page.close()


NAKED = pytest.mark.parametrize("tab", [{"words": "naked"}], indirect=True)


def projected(scene: Scene, points: NDArray[np.float64], width: int, height: int) -> NDArray[np.float64]:
    """Return pixels, (n, 2), and depth of points in a picture without texts."""
    camera = scene.camera
    across = np.cross(camera.up, camera.towards)
    across /= np.linalg.norm(across)
    upright = np.cross(camera.towards, across)
    seen = points - camera.focus - camera.distance(width / height) * camera.towards
    depth = -(seen @ camera.towards)
    scale = 0.5 * height / math.tan(math.radians(VIEW_ANGLE / 2))
    return np.column_stack(
        [
            0.5 * width + scale * (seen @ across) / depth,
            0.5 * height - scale * (seen @ upright) / depth,
            depth,
        ]
    )


def in_front(scene: Scene, frame: int, width: int, height: int) -> list[int]:
    """Return the bodies whose centre no other body hides."""
    bodies = scene.bodies
    shown = np.flatnonzero(bodies.shown[frame])
    at = projected(scene, bodies.x[frame, shown], width, height)
    reach = 0.5 * height / math.tan(math.radians(VIEW_ANGLE / 2)) * 3.0 * bodies.radius[shown] / at[:, 2]
    clear = []
    for k, body in enumerate(shown):
        off = np.hypot(*(at[:, :2] - at[k, :2]).T)
        if not ((off < reach) & (at[:, 2] < at[k, 2])).any():
            clear.append(int(body))
    return clear


class TestPicture:
    def test_it_draws_without_messages(self, tab):
        assert tab.text("title") == "cube"
        assert tab.text("caption") == "30 bodies, drawn 1.5× larger"
        assert tab.text("clock") == "t = 0.4 s"
        image = tab.pixels()[:, : WIDTH - 300]
        # Bodies, walls and the plane: many colours, on white paper.
        assert len(np.unique(image.reshape(-1, 3), axis=0)) > 2000
        assert (image[5, 5] == 255).all()

    @NAKED
    def test_it_is_the_picture_that_VTK_draws(self, tab, scene, tmp_path):
        picture(scene, tmp_path / "vtk.png", (WIDTH, HEIGHT), LIGHT, texts=False)
        theirs = np.array(Image.open(tmp_path / "vtk.png").convert("RGB")).astype(float)
        ours = tab.pixels().astype(float)
        assert ours.shape == theirs.shape
        # Light and glass are not alike to the last shade, but everything is where it belongs.
        assert np.abs(ours - theirs).mean() < 10.0
        body = saturation(theirs) > 0.35
        assert 0.02 < body.mean() < 0.5
        both = body & (saturation(ours) > 0.35)
        # The same light on the same normals: bright where theirs is bright.
        brightness = [image.mean(axis=2)[both] for image in (ours, theirs)]
        assert np.corrcoef(*brightness)[0, 1] > 0.9
        assert both.sum() / (body | (saturation(ours) > 0.35)).sum() > 0.85
        paper = (theirs > 250).all(axis=2)
        assert ((ours > 250).all(axis=2) == paper).mean() > 0.99

    def test_quadratic_modes_are_drawn_as_VTK_draws_them(self, browser, tmp_path):
        moved = motion(4, 2, tumbling=0.0)
        x = np.array([[0.25, 0.3, 0.5], [0.75, 0.3, 0.5], [0.25, 0.75, 0.5], [0.75, 0.75, 0.5]])
        moved = Motion(moved.times, np.tile(x, (2, 1, 1)), moved.F, np.full(4, 0.15))
        write_run(tmp_path, moved, B=modes(4, 2, 0.25))
        request = Request(tmp_path, time=0.0, enlargement=1.0)
        with_modes = make_scene(request, open_run(tmp_path), range(2))
        opened = Tab(browser, write_page(request, None, 30.0, "").as_uri(), "naked")
        ours = saturation(opened.pixels().astype(float)) > 0.35
        shares = []
        for scene in (with_modes, replace(with_modes, bodies=replace(with_modes.bodies, B=None))):
            picture(scene, tmp_path / "vtk.png", (WIDTH, HEIGHT), LIGHT, texts=False)
            theirs = (
                saturation(np.array(Image.open(tmp_path / "vtk.png").convert("RGB")).astype(float)) > 0.35
            )
            shares.append((ours & theirs).sum() / (ours | theirs).sum())
        assert ours.mean() > 0.02
        assert shares[0] > 0.95
        assert shares[1] < shares[0] - 0.05
        assert opened.messages == []
        opened.page.close()

    @NAKED
    def test_bodies_have_the_colours_of_their_values(self, tab, scene):
        tab.page.evaluate("() => { document.getElementById('mark').click(); }")
        for name, part in (("taylorDeformation", ""), ("U", "x"), ("injector", "")):
            tab.run(f"foamprb.setColour('{name}', '{part}')")
            image = tab.pixels().astype(float)
            frame = scene.first
            bodies = scene.bodies
            right = total = 0
            for body in in_front(scene, frame, WIDTH, HEIGHT):
                x, y, _ = projected(scene, bodies.x[frame, [body]], WIDTH, HEIGHT)[0]
                if not (0 < x < WIDTH and 0 < y < HEIGHT):
                    continue
                if name == "injector":
                    expected = np.array(
                        rgb(colour_of_name(int(bodies.codes[name].codes[0, body]))), dtype=float
                    )
                else:
                    low, high = tab.run("[foamprb.state.low, foamprb.state.high]")
                    value = bodies.fields[name].channel(part)[frame, body]
                    table = colour_map("coolwarm" if low == -high else "viridis")
                    expected = table[round(255 * (value - low) / (high - low))].astype(float)
                found = image[int(y), int(x)]
                total += 1
                # Shading changes the brightness, hardly the hue.
                cosine = found @ expected / np.linalg.norm(found) / np.linalg.norm(expected)
                right += cosine > 0.985
            assert total >= 8
            assert right >= 0.9 * total, name

    def test_light_and_dark(self, tab):
        tab.page.emulate_media(color_scheme="dark")
        assert (tab.pixels()[5, 5] == (16, 21, 27)).all()
        tab.page.select_option("#theme", "light")
        assert (tab.pixels()[5, 5] == 255).all()
        tab.page.keyboard.press("d")
        assert (tab.pixels()[5, 5] == (16, 21, 27)).all()

    def test_the_mark_goes_with_the_material(self, browser, tmp_path):
        """The picture of rotating spheres changes only by their marks."""
        angle = 0.3 * np.arange(7)
        F = np.zeros((7, 2, 3, 3))
        F[..., 2, 2] = 1.0
        F[..., 0, 0] = F[..., 1, 1] = np.cos(angle)[:, None]
        F[..., 1, 0] = np.sin(angle)[:, None]
        F[..., 0, 1] = -F[..., 1, 0]
        x = np.broadcast_to([[0.2, 0.5, 0.5], [0.8, 0.5, 0.5]], (7, 2, 3))
        write_run(tmp_path, Motion(0.1 * np.arange(7), x, F, np.array([0.2, 0.2])), mesh=False)
        page = write_page(Request(tmp_path), None, 30.0, "")
        opened = Tab(browser, page.as_uri(), "naked")
        changed = []
        for _ in range(2):
            before, after = (opened.run(f"foamprb.show({t})") or opened.pixels().astype(int) for t in (4, 5))
            body = (before < 250).any(axis=2).sum()
            changed.append((np.abs(after - before) > 20).any(axis=2).sum() / body)
            opened.page.evaluate("() => { document.getElementById('mark').click(); }")
        assert changed[0] > 0.05
        assert changed[1] == 0.0
        assert opened.messages == []
        opened.page.close()


def saturation(image: NDArray[np.float64]) -> NDArray[np.float64]:
    most, least = image.max(axis=2), image.min(axis=2)
    return np.asarray((most - least) / np.maximum(most, 1.0))


class TestNumbers:
    def test_decoded_positions_are_the_positions_of_the_run(self, tab, moved):
        places = np.array(tab.run("Array.from(foamprb.data.x)")).reshape(M, N, 3)
        frame = tab.run("foamprb.data.scene.frame")
        present = np.array(
            [[tab.run(f"foamprb.data.present({t}, {i})") for i in range(N)] for t in (0, M - 1)]
        )
        late = np.arange(N) % 3 == 0
        np.testing.assert_array_equal(present[0], ~late)
        assert present[1].all()
        x = np.array(frame["middle"]) + frame["size"] * places
        assert np.abs(x - moved.x)[:, ~late].max() < 3e-7
        F = np.array(tab.run("Array.from(foamprb.data.F)")).reshape(M, N, 3, 3)
        F = tab.run("foamprb.data.shapeStep") * F
        assert np.abs(F - moved.F)[:, ~late].max() < 3e-4
        assert tab.run("Array.from(foamprb.data.ids)") == list(range(N))
        speed = np.array(
            [[tab.run(f"foamprb.data.fields.U.value({t}, {i}, 'magnitude')") for i in (1, 4)] for t in (0, 5)]
        )
        expected = np.linalg.norm(np.gradient(moved.x, 0.1, axis=0), axis=2)[[0, 5]][:, [1, 4]]
        np.testing.assert_allclose(speed, expected, rtol=1e-3)


class TestChoosing:
    @NAKED
    def test_a_click_meets_the_body_under_it(self, tab, scene):
        """Where a body's middle is, is computed here from the scene's camera."""
        chosen = in_front(scene, scene.first, WIDTH, HEIGHT)
        assert len(chosen) >= 8
        for body in chosen[:8]:
            x, y, _ = projected(scene, scene.bodies.x[scene.first, [body]], WIDTH, HEIGHT)[0]
            tab.page.mouse.click(x, y)
            assert tab.run("foamprb.state.chosen") == body
        tab.page.mouse.click(3, 3)
        assert tab.run("foamprb.state.chosen") == -1

    def test_the_edge_of_a_body_is_where_it_is_drawn(self, tab):
        """Pixels inside the outline of the selected body select it, pixels beyond do not."""
        tab.run("foamprb.choose(4)")
        for t in range(M):
            tab.run(f"foamprb.show({t})")
            wrong = tab.run("""(() => {
                const f = foamprb, at = f.placeOf(4);
                if (f.bodyAt(at.x, at.y) !== 4) return 0;
                let wrong = 0;
                for (let angle = 0; angle < 6.28; angle += 0.3) {
                    // Outwards until it is met no more: then never again.
                    let met = true;
                    for (let r = 1; r < 400; r++) {
                        const now = f.bodyAt(at.x + r * Math.cos(angle), at.y + r * Math.sin(angle)) === 4;
                        if (now && !met) wrong++;
                        met = now;
                        if (!now && r > 350) break;
                    }
                }
                return wrong;
            })()""")
            assert wrong <= 6

    def test_its_card_has_its_numbers_and_its_curve(self, tab, moved):
        tab.run("foamprb.choose(4)")
        assert tab.text("card-title") == "Body 4"
        assert tab.text("card-story") == "From soft, released at 0 s, active at 0.7 s"
        rows = tab.page.locator("#card-rows button").all_inner_texts()
        values = dict(row.split("\n") for row in rows)
        assert float(values["diameter at rest"].split()[0]) == pytest.approx(2e3 * moved.radius[4], rel=1e-3)
        axes = np.sort(np.linalg.svd(moved.F[4, 4], compute_uv=False))[::-1] * moved.radius[4] * 1e3
        assert values["semi-axis, a"].endswith(" mm")
        assert float(values["semi-axis, a"].split()[0]) == pytest.approx(axes[0], rel=2e-3)
        assert tab.page.locator("#chart svg path.curve").count() == 1
        assert "Taylor deformation" in tab.text("chart")
        tab.page.get_by_role("button", name="shear rate").click()
        assert "shear rate (1/s)" in tab.text("chart")

    @pytest.mark.parametrize("factor", [3.4e-9, 1.0, 5.6e9])
    def test_the_numbers_of_its_axis_are_not_cut_off(self, tab, factor):
        tab.run(f"foamprb.data.fields.shearRate.low[0] *= {factor}")
        tab.run("foamprb.choose(4)")
        tab.page.get_by_role("button", name="shear rate").click()
        left = tab.run("Math.min(...[...document.querySelectorAll('#chart text')].map(t => t.getBBox().x))")
        assert left >= 0.0

    def test_its_numbers_can_be_saved(self, tab, moved):
        tab.run("foamprb.choose(4)")
        with tab.page.expect_download() as waiting:
            tab.page.click("#card-table")
        assert waiting.value.suggested_filename == "cube_body_4.csv"
        with Path(waiting.value.path()).open() as file:
            table = list(csv.DictReader(file))
        assert len(table) == M
        assert [float(row["x [m]"]) for row in table] == pytest.approx(moved.x[:, 4, 0], abs=1e-6)

    def test_by_keys(self, tab):
        tab.page.focus("#canvas")
        tab.page.keyboard.press("n")
        first = tab.run("foamprb.state.chosen")
        tab.page.keyboard.press("n")
        assert tab.run("foamprb.state.chosen") > first >= 0
        tab.page.keyboard.press("p")
        assert tab.run("foamprb.state.chosen") == first
        tab.page.keyboard.press("Escape")
        assert tab.run("foamprb.state.chosen") == -1
        assert not tab.page.is_visible("#card")

    def test_by_number(self, tab):
        tab.page.fill("#wanted", "17")
        tab.page.click("#choose")
        assert tab.text("card-title") == "Body 17"
        tab.page.fill("#wanted", "400")
        tab.page.click("#choose")
        assert tab.text("status") == "No such body."

    @pytest.mark.parametrize(
        "tab", [{"has_touch": True, "viewport": {"width": 390, "height": 800}}], indirect=True
    )
    def test_by_a_tap(self, tab):
        spot = tab.run("""(() => {
            const f = foamprb;
            for (let i = 0; i < f.data.n; i++) {
                const at = f.placeOf(i);
                if (at.y > 90 && at.y < 600 && f.bodyAt(at.x, at.y) === i) return [i, at.x, at.y];
            }
        })()""")
        tab.page.touchscreen.tap(spot[1], spot[2])
        assert tab.run("foamprb.state.chosen") == spot[0]
        card = tab.page.locator("#card").bounding_box()
        assert card["x"] == 0
        assert card["y"] + card["height"] == pytest.approx(800, abs=1)

    def test_following(self, tab):
        tab.run("foamprb.choose(4)")
        tab.page.check("#follow")
        before = tab.run("foamprb.placeOf(4)")
        tab.page.focus("#canvas")
        tab.page.keyboard.press(".")
        after = tab.run("foamprb.placeOf(4)")
        assert (after["x"], after["y"]) == pytest.approx((before["x"], before["y"]), abs=0.5)

    def test_its_shapes_are_drawn_at_one_scale_beside_a_bar(self, tab, moved):
        """The area of an ellipsoid's shadow is π times the root of the determinant of its 2×2 part."""
        tab.run("foamprb.choose(4)")
        tab.run("foamprb.draw()")
        data = tab.run("document.getElementById('gallery').toDataURL()").split(",")[1]
        image = np.array(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGBA")).astype(float)
        label = tab.page.get_attribute("#gallery", "aria-label")
        assert label.startswith("Shape at 8 times from 0 s to 0.7 s, to scale; bar of ")
        # Columns of the bar, from its right end on.
        bar = (image[-14:-11, ::-1, 3] > 128).any(axis=0)[6:]
        pixel = 1e-3 * float(re.search(r"bar of (\S+) mm", label)[1]) / (bar.argmin() + 1.25)
        axes = tab.run("(a => [a.right.toArray(), a.up.toArray()])(foamprb.eye.axes())")
        tile = image.shape[1] // 4
        for k in range(M):
            G = np.array(axes) @ moved.F[k, 4] * moved.radius[4]
            area = np.pi * math.sqrt(np.linalg.det(G @ G.T)) / pixel**2
            top, left = k // 4 * (tile + 15), k % 4 * tile
            found = (image[top : top + tile, left : left + tile, :3].min(axis=2) < 235).sum()
            assert found == pytest.approx(area, rel=0.08)


class TestPlot:
    def test_median_and_band_are_those_of_the_shown_bodies(self, tab, scene):
        assert not tab.page.is_visible("#plot")
        tab.page.keyboard.press("t")
        tab.run("foamprb.draw()")
        found = np.array(tab.run("foamprb.plot.plot.data.slice(1)"))
        values = np.where(scene.bodies.shown, scene.bodies.fields["taylorDeformation"].channel(""), np.nan)
        expected = np.nanquantile(values, [0.95, 0.5, 0.05], axis=1)
        np.testing.assert_allclose(found, expected, rtol=2e-4, atol=1e-6)
        tab.page.click("#plot-close")
        assert not tab.page.is_visible("#plot")

    def test_a_click_sets_the_time_and_a_drag_filters(self, tab, scene):
        tab.page.click("#open-plot")
        tab.run("foamprb.draw()")
        over = tab.page.locator("#curves .u-over").bounding_box()
        tab.page.mouse.click(over["x"] + 0.99 * over["width"], over["y"] + 20)
        assert tab.run("foamprb.state.t") == M - 1
        tab.run("foamprb.show(4)")
        tab.page.mouse.move(over["x"] + 0.5 * over["width"], over["y"] + 5)
        tab.page.mouse.down()
        tab.page.mouse.move(over["x"] + 0.65 * over["width"], over["y"] + 0.5 * over["height"], steps=4)
        tab.page.mouse.up()
        box = tab.run("foamprb.plot.box")
        values = np.where(scene.bodies.shown, scene.bodies.fields["taylorDeformation"].channel(""), np.nan)
        inside = (scene.bodies.times >= box["from"]) & (scene.bodies.times <= box["to"])
        passing = ((values >= box["low"]) & (values <= box["high"]))[inside].any(axis=0)
        assert inside.tolist() == [False] * 4 + [True] + [False] * 3
        assert tab.text("caption").startswith(f"{passing.sum()} bodies")
        tab.page.click("#plot-clear")
        assert tab.text("caption").startswith("30 bodies")

    def test_curves_of_chosen_bodies_and_numbers_by_name(self, tab, scene):
        tab.run("foamprb.choose(4)")
        tab.page.check("#keep")
        tab.run("foamprb.choose(7)")
        tab.run("foamprb.draw()")
        assert tab.page.locator("#plot-keys span").all_inner_texts() == ["4", "7"]
        tab.page.select_option("#colour", "injector:")
        tab.run("foamprb.draw()")
        half = [scene.bodies.shown[:, k::2].sum(axis=1).tolist() for k in (0, 1)]
        assert tab.run("foamprb.plot.plot.data.slice(1)") == half


class TestTime:
    def test_the_slider_changes_the_time_and_the_picture(self, tab):
        before = tab.pixels()
        tab.page.focus("#time")
        tab.page.keyboard.press("ArrowRight")
        assert tab.run("foamprb.state.t") == 5
        assert tab.text("clock") == "t = 0.5 s"
        assert tab.page.get_attribute("#time", "aria-valuetext") == "0.5 s"
        assert (np.abs(tab.pixels().astype(int) - before) > 30).any(axis=2).mean() > 0.005
        tab.page.keyboard.press("Home")
        assert tab.text("clock") == "t = 0 s"
        assert tab.text("caption").startswith("20 bodies")

    def test_playing_and_stopping(self, tab):
        assert not tab.run("foamprb.state.playing")
        # 0.7 s in 8 s is 11.4 times slower than reality; a round number.
        assert tab.page.locator("#speed option:checked").inner_text() == "1/20×"
        tab.page.select_option("#speed", label="1/2×")
        tab.page.focus("#canvas")
        tab.page.keyboard.press(" ")
        assert tab.text("play-word") == "Stop"
        tab.wait("foamprb.state.t !== 4")
        tab.page.keyboard.press(" ")
        assert not tab.run("foamprb.state.playing")

    def test_step_by_step(self, tab):
        tab.page.click("#forward")
        assert tab.run("foamprb.state.t") == 5
        tab.page.click("#backward")
        tab.page.keyboard.press(",")
        assert tab.run("foamprb.state.t") == 3


class TestControls:
    def test_enlargement_is_shown(self, tab):
        tab.page.locator("#enlargement").fill("0")
        assert tab.text("caption") == "30 bodies, drawn to scale"
        assert tab.text("enlargement-text") == "to scale"

    def test_filters(self, tab):
        tab.run("foamprb.show(7)")
        assert tab.text("caption").startswith("29 bodies")
        tab.page.get_by_label("stuck on floor").uncheck()
        assert tab.text("caption").startswith("28 bodies")
        tab.page.check("#gone")
        assert tab.text("caption").startswith("29 bodies")
        tab.page.click("#injectors summary")
        tab.page.get_by_label("stiff").uncheck()
        assert tab.text("caption").startswith("15 bodies")
        tab.page.click("#by-range summary")
        tab.page.select_option("#filter", "d:")
        tab.page.fill("#filter-low", "0.07")
        tab.page.keyboard.press("Enter")
        count = tab.run("""(() => {
            const f = foamprb;
            let count = 0;
            for (let i = 0; i < f.data.n; i += 2) count += f.data.fields.d.value(0, i, "") >= 0.07;
            return count;
        })()""")
        assert tab.text("caption").startswith(f"{count} ")
        tab.page.fill("#filter-low", "a")
        tab.page.keyboard.press("Enter")
        assert tab.page.get_attribute("#filter-low", "aria-invalid") == "true"

    def test_colours_have_a_legend_with_a_unit(self, tab):
        tab.page.select_option("#colour", "U:magnitude")
        legend = tab.page.locator("#legends").inner_text()
        assert "Velocity, magnitude (m/s)" in " ".join(legend.split())
        tab.page.fill("#range-high", "0.25")
        tab.page.keyboard.press("Tab")
        assert tab.run("foamprb.state.high") == 0.25
        assert "≥ 250" in tab.page.locator("#legends").inner_text()
        tab.page.click("#range-all")
        assert not set("≤≥") & set(tab.page.locator("#legends").inner_text())
        tab.page.click("#range-now")
        assert tab.run("foamprb.state.low") > 0.0
        tab.page.select_option("#colour", "fate:")
        assert "escaped through lid" in tab.page.locator("#legends").inner_text()
        assert not tab.page.is_visible("#range-row")

    def test_trails_and_deposits(self, tab):
        tab.run("foamprb.show(7)")
        assert tab.page.input_value("#trails") == "fading"
        fading = tab.pixels()
        tab.page.select_option("#trails", "none")
        before = tab.pixels()
        assert (np.abs(fading.astype(int) - before) > 20).any(axis=2).mean() > 5e-4
        tab.page.select_option("#trails", "whole")
        with_paths = tab.pixels()
        assert (np.abs(with_paths.astype(int) - before) > 20).any(axis=2).mean() > 0.002
        tab.page.select_option("#deposits", "none")
        without = tab.pixels()
        mark = np.array(rgb(LIGHT.deposit))
        assert (np.abs(with_paths.astype(int) - mark).max(axis=2) < 12).any()
        assert not (np.abs(without.astype(int) - mark).max(axis=2) < 12).any()

    def test_walls_names_and_the_plane(self, tab):
        labels = tab.page.locator("#labels span")
        assert set(labels.all_inner_texts()) & {"floor", "lid", "sides"}
        tab.page.uncheck("#names")
        tab.run("foamprb.draw()")
        assert not any(label.is_visible() for label in labels.all())
        before = tab.pixels()
        tab.page.focus("#handle")
        tab.page.keyboard.press("ArrowUp")
        assert tab.text("offset-text") == "0.04 m"
        tab.page.hover("#handle")
        tab.page.mouse.down()
        tab.page.mouse.move(300, 200)
        tab.page.mouse.up()
        assert tab.text("offset-text") != "0.04 m"
        tab.page.select_option("#slice", "none")
        tab.run("foamprb.draw()")
        assert not tab.page.is_visible("#handle")
        tab.page.select_option("#opacity", "none")
        assert (np.abs(tab.pixels().astype(int) - before) > 10).any(axis=2).mean() > 0.05
        assert tab.page.locator(".legend h2").all_inner_texts() == ["Taylor deformation (a − c)/(a + c)"]

    def test_turning_moving_zooming(self, tab):
        tab.page.focus("#canvas")
        place = "[foamprb.eye.yaw, foamprb.eye.pitch, foamprb.eye.distance, foamprb.eye.target.x]"
        before = tab.run(place)
        for key in ("ArrowLeft", "ArrowUp", "+", "Shift+ArrowLeft"):
            tab.page.keyboard.press(key)
        after = tab.run(place)
        assert all(a != b for a, b in zip(before, after, strict=True))
        tab.page.mouse.move(300, 300)
        tab.page.mouse.down()
        tab.page.mouse.move(380, 320, steps=4)
        tab.page.mouse.up()
        assert tab.run("foamprb.state.chosen") == -1
        assert tab.run(place)[0] != after[0]
        tab.page.mouse.wheel(0, 300)
        tab.wait(f"foamprb.eye.distance > {after[2]}")
        tab.page.keyboard.press("0")
        assert tab.run(place) == pytest.approx(before)
        tab.page.keyboard.press("w")

    def test_a_frame_takes_the_wheel_after_a_click(self, browser, request_):
        """Before it, the wheel and a finger scroll the notebook or page around the frame."""
        outer = browser.new_page(viewport={"width": WIDTH, "height": HEIGHT})
        frame = ViewPage(write_page(request_, None, 30.0, "1.2.3"))._repr_html_()
        outer.set_content(f"<body>{frame}<div style='height: 2000px'>")
        inner = outer.frames[1]
        inner.wait_for_selector("#app:not(.loading)")
        distance = inner.evaluate("foamprb.eye.distance")
        touch = "document.getElementById('canvas').style.touchAction"
        assert inner.evaluate(touch) == "pan-y"
        outer.mouse.move(300, 300)
        outer.mouse.wheel(0, 100)
        outer.wait_for_function("scrollY === 100")
        assert inner.evaluate("foamprb.eye.distance") == distance
        outer.mouse.click(300, 300)
        outer.mouse.wheel(0, 100)
        inner.wait_for_function(f"foamprb.eye.distance > {distance}")
        assert inner.evaluate(touch) == ""
        assert outer.evaluate("scrollY") == 100
        outer.close()

    def test_the_address_restores_camera_time_and_body(self, tab, browser, address):
        place = "[...foamprb.eye.camera.position, foamprb.state.t, foamprb.state.chosen, foamprb.state.name]"
        tab.run(
            "(foamprb.choose(4), foamprb.show(6), foamprb.setColour('d', ''), foamprb.eye.turn(0.5, 0.2))"
        )
        tab.wait("location.hash.includes('body=4')")
        tab.wait("location.hash.includes('t=0.6')")
        other = Tab(browser, address, tab.run("location.hash").removeprefix("#"))
        assert other.run(place)[:3] == pytest.approx(tab.run(place)[:3], abs=1e-3)
        assert other.run(place)[3:] == [6, 4, "d"]
        other.page.close()

    def test_zooming_keeps_what_is_under_the_pointer(self, tab):
        at = tab.run("foamprb.placeOf(4)")
        tab.run("(foamprb.eye.target.set(foamprb.data.x[0], 0, 0), foamprb.eye.place())")
        tab.page.keyboard.press("0")
        tab.run(f"foamprb.eye.zoom(0.8, {at['x']}, {at['y']})")
        now = tab.run("foamprb.placeOf(4)")
        # Exact in the plane of the target, approximate in front of and behind it.
        assert math.hypot(now["x"] - at["x"], now["y"] - at["y"]) < 0.1 * 900

    def test_the_picture_can_be_saved_with_its_words(self, tab):
        with tab.page.expect_download() as waiting:
            tab.page.click("#picture")
        assert waiting.value.suggested_filename == "cube_t0.4.png"
        image = np.array(Image.open(waiting.value.path()).convert("RGB"))
        stage = tab.page.locator("#stage").bounding_box()
        assert image.shape[:2] == (2 * round(stage["height"]), 2 * round(stage["width"]))
        # Ink in the upper corners, where the title and the caption are.
        assert (image[20:120, 30:300].min(axis=2) < 60).any()
        assert (image[20:120, -300:-30].min(axis=2) < 60).any()
        # The scale bar in the lower right corner.
        assert (image[-80:-10, -300:-30].min(axis=2) < 60).any()

    def test_the_scale_bar_is_that_of_the_plane_of_the_focus(self, tab):
        for _ in range(2):
            label = tab.page.get_attribute("#compass", "aria-label")
            value, unit = re.search(r"scale bar of (\S+) (\w+)$", label).groups()
            length = float(value) * {"m": 1.0, "mm": 1e-3}[unit]
            assert value[0] in "125" or value.startswith("0.")
            pixels = tab.run(
                f"(() => {{ const e = foamprb.eye, along = {length} / foamprb.data.scene.frame.size, "
                "a = e.target.clone().project(e.camera), "
                "b = e.target.clone().addScaledVector(e.axes().right, along).project(e.camera); "
                "return (b.x - a.x) / 2 * e.width; })()"
            )
            assert 47.0 < pixels <= 120.5
            tab.run("foamprb.eye.zoom(0.1)")
            tab.run("foamprb.draw()")

    def test_the_keys_are_listed(self, tab):
        tab.page.keyboard.press("h")
        assert tab.page.is_visible("#about")
        assert "MIT License" in tab.text("about")
        tab.page.keyboard.press("Escape")
        assert not tab.page.is_visible("#about")

    def test_all_controls_are_reached_by_tab_and_have_names(self, tab):
        tab.page.click("#injectors summary")
        tab.page.click("#by-range summary")
        tab.page.focus("#canvas")
        reached = set()
        for _ in range(90):
            tab.page.keyboard.press("Tab")
            reached.add(tab.run("document.activeElement.id"))
        wanted = tab.run(
            "[...document.querySelectorAll('button, select, input')]"
            ".filter(e => e.checkVisibility({ visibilityProperty: true }) && e.id).map(e => e.id)"
        )
        assert set(wanted) <= reached


LAYOUTS = [(1440, 860), (1024, 640), (800, 1100), (390, 800), (800, 390)]


@pytest.mark.parametrize(
    ("size", "scheme"), [*((size, "light") for size in LAYOUTS), ((390, 800), "dark")], ids=str
)
def test_nothing_overlaps_and_nothing_is_cut(browser, address, size, scheme):
    opened = Tab(browser, address, viewport={"width": size[0], "height": size[1]}, color_scheme=scheme)
    assert opened.run("document.documentElement.scrollWidth") <= size[0]
    assert opened.run("document.documentElement.scrollHeight") <= size[1]
    boxes = opened.run("""(() => {
        const sides = ({ left, top, right, bottom }) => [left, top, right, bottom];
        const box = (e) => sides(e.getBoundingClientRect());
        const of = (q) => [...document.querySelectorAll(q)].filter(e => e.checkVisibility()).map(box);
        return [...of("#heading h1, #heading p"), ...of("#facts p"), ...of(".legend"), ...of("#compass"),
                ...of("#corner button, #transport button, #transport input, #transport select"),
                ...of("#transport output, #labels span:not([hidden])")];
    })()""")
    for left, top, right, bottom in boxes:
        assert left >= -0.5
        assert top >= -0.5
        assert right <= size[0] + 0.5
        assert bottom <= size[1] + 0.5
    for k, a in enumerate(boxes):
        for b in boxes[:k]:
            apart = a[0] >= b[2] - 0.5 or b[0] >= a[2] - 0.5 or a[1] >= b[3] - 0.5 or b[1] >= a[3] - 0.5
            assert apart, (a, b)
    assert opened.messages == []
    opened.page.close()


def test_missing_WebGL_is_reported(browser, address):
    page = browser.new_page()
    page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null;")
    page.goto(address)
    api = pytest.importorskip("playwright.sync_api")
    api.expect(page.locator("#notice")).to_contain_text("cannot be shown: it needs WebGL 2")
    page.close()


def test_a_hundred_thousand_bodies_stay_fluid(browser, tmp_path):
    """Two triangles each, and a new time costs a processor less than a frame at 30 a second."""
    write_run(tmp_path, motion(100_000, 3), mesh=False)
    path = write_page(Request(tmp_path), None, 1e3, "")
    opened = Tab(browser, path.as_uri(), "naked", viewport={"width": 320, "height": 200})
    times = opened.run("""(() => {
        const times = [];
        for (let k = 0; k < 15; k++) {
            const start = performance.now();
            foamprb.show(k % 3);
            times.push(performance.now() - start);
        }
        return times.sort((a, b) => a - b);
    })()""")
    assert times[len(times) // 4] < 33.0
    assert opened.run("(foamprb.draw(), foamprb.renderer.info.render.triangles)") < 210_000
    assert opened.messages == []
    opened.page.close()
