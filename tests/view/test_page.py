"""Contents and size of the page, and its independence of other files."""

from __future__ import annotations

import base64
import hashlib
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from foam_writer import GRADIENT
from page_reader import PageReader
from paths import ROOT
from view_run import modes, motion, write_run

import foamprb.view
from foamprb.cli import main
from foamprb.view import show
from foamprb.view.colours import DARK, LIGHT, rgb
from foamprb.view.encode import POSITION_BITS, SHAPE_STEP
from foamprb.view.show import Request, write_page

PAGE = Path(foamprb.view.__file__).parent / "page"
N, M = 40, 9


@pytest.fixture(scope="module")
def moved():
    return motion(N, M)


@pytest.fixture(scope="module")
def case(tmp_path_factory, moved):
    folder = tmp_path_factory.mktemp("view") / "duct <of> glass & steel"
    write_run(folder, moved, fates=True)
    return folder


@pytest.fixture(scope="module")
def text(case):
    return write_page(Request(case, slice="z"), None, 30.0, "1.2.3").read_text(encoding="utf-8")


@pytest.fixture
def page(text):
    return PageReader(text)


def test_a_page_loads_no_library_of_pictures_and_saved_code_none_of_the_compiler(case, tmp_path):
    words = ["view", "-case", str(case), "-noBrowser", "-output", str(tmp_path / "a.html")]
    assert main(words) == 0
    heavy = ("matplotlib", "pyvista", "scipy.sparse", "scipy.spatial", "numba.typed.typeddict",
             "vtkmodules.vtkRenderingCore")  # fmt: skip
    code = f"import sys\nfrom foamprb.cli import main\nassert main({words}) == 0\n"
    code += f"print([name for name in {heavy} if name in sys.modules])"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.splitlines()[-1] == "[]"


class TestContents:
    def test_particles_of_each_time(self, page, moved):
        ids = page.whole(page.scene["bodies"]["ids"])
        np.testing.assert_array_equal(ids, np.arange(N))
        present = page.present()
        assert page.scene["times"] == pytest.approx(moved.times)
        late = np.arange(N) % 3 == 0
        assert not present[: M // 3 + 1, late].any()
        assert present[M // 3 + 1 :].all()
        assert present[:, ~late].all()

    def test_places_and_shapes(self, page, moved):
        present = page.present()
        x = page.values(page.scene["bodies"]["places"])
        # The box is that of the mesh, a unit cube.
        assert np.abs(x - moved.x)[present].max() < 0.51 / 2**POSITION_BITS + 1e-12
        F = page.values(page.scene["bodies"]["shapes"]).reshape(M, N, 3, 3)
        assert np.abs(F - moved.F)[present].max() < 0.51 * SHAPE_STEP
        radius = page.values(page.scene["bodies"]["radius"])
        np.testing.assert_allclose(radius, moved.radius, rtol=1e-6)

    def test_quadratic_modes(self, page, moved, tmp_path):
        assert page.scene["bodies"]["modes"] is None
        B = modes(N, M, 0.15)
        write_run(tmp_path, moved, mesh=False, B=B)
        page = PageReader(write_page(Request(tmp_path), None, 30.0, "").read_text(encoding="utf-8"))
        off = page.values(page.scene["bodies"]["modes"]) - B
        assert np.abs(off)[page.present()].max() < 0.51 * SHAPE_STEP
        assert "quadraticShape" not in page.scene["fields"]

    def test_arrays(self, page, moved):
        fields = page.scene["fields"]
        assert next(iter(fields)) == "taylorDeformation"
        assert {"Ca", "t0", "t1", "shearRate", "U"} <= set(fields)
        spec = fields["taylorDeformation"]
        found = page.field(spec)[..., 0][page.present()]
        stretch = np.linalg.svd(moved.F, compute_uv=False)
        expected = ((stretch[..., 0] - stretch[..., 2]) / (stretch[..., 0] + stretch[..., 2]))[page.present()]
        np.testing.assert_allclose(found, expected, rtol=4e-5, atol=1e-6)
        ranges = spec["ranges"][""]
        assert ranges["usual"][0] == ranges["whole"][0] == 0.0
        assert ranges["whole"][1] >= expected.max() - 1e-6
        assert ranges["extremes"] == pytest.approx([expected.min(), expected.max()], abs=1e-5)

    def test_names(self, page):
        codes = page.scene["codes"]
        assert codes["fate"]["meanings"] == ["active", "stuck on floor", "escaped through lid"]
        assert page.whole(codes["fate"])[0, :3].tolist() == [0, 1, 2]
        assert codes["injector"]["meanings"] == ["soft", "stiff"]

    def test_patches_and_triangles(self, page):
        assert [s["name"] for s in page.scene["surfaces"]] == ["floor", "lid", "sides"]
        area = 0.0
        for surface in page.scene["surfaces"]:
            points = page.values(surface["points"])
            a, b, c = points[page.whole(surface["triangles"])].transpose(1, 0, 2)
            area += 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
        assert area == pytest.approx(6.0, rel=1e-5)

    def test_streamlines_and_the_grid_of_the_flow(self, page):
        """The flow of the cube is linear."""
        flow = page.scene["flow"]
        start = page.whole(flow["lines"]["start"])
        points = page.values(flow["lines"]["points"])
        assert start[-1] == len(points)
        along = np.diff(points, axis=0)
        u = (0.5 * (points[1:] + points[:-1])) @ GRADIENT.T
        inside = np.isin(np.arange(1, len(points)), start[1:-1], invert=True)
        along, u = along[inside], u[inside]
        sizes = np.linalg.norm(along, axis=1) * np.linalg.norm(u, axis=1)
        cosines = np.einsum("ij,ij->i", along, u) / sizes
        assert cosines[sizes > 1e-3].min() > 0.98
        assert flow["plane"][1] == [0.0, 0.0, 1.0]
        speed, rate = flow["values"]
        assert [speed["unit"], rate["unit"]] == ["m/s", "1/s"]
        n = speed["shape"]
        x = np.linspace(0.0, 1.0, n[0])
        places = np.stack(np.meshgrid(x, x, x, indexing="ij"), axis=-1)[..., ::-1]
        expected = np.linalg.norm(places @ GRADIENT.T, axis=-1)
        found = page.whole(speed) / 255.0 * speed["range"][1]
        assert np.abs(np.minimum(expected, speed["range"][1]) - found).max() < 0.003 * speed["range"][1]

    def test_titles_are_text(self, text, page):
        assert page.scene["title"] == "duct <of> glass & steel"
        assert "<title>duct &lt;of&gt; glass &amp; steel – softCloud</title>" in text
        assert '<meta property="og:title" content="duct &lt;of&gt; glass &amp; steel – softCloud">' in text
        assert "<of>" not in text


class TestOnItsOwn:
    def test_it_names_no_other_file_and_no_address_to_load(self, text):
        plain = re.sub(r"<script>.*?</script>", "", text, flags=re.DOTALL)
        assert not re.search(r'\b(?:src|href|srcset|action|poster|data)\s*=\s*"', plain)
        assert "url(" not in plain
        assert "@import" not in plain

    def test_the_policy_allows_its_own_script_and_nothing_else(self, text):
        policy = re.search(r'Content-Security-Policy" content="([^"]*)"', text)[1]
        rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
        assert rules["default-src"] == "'none'"
        assert rules["connect-src"] == "'none'"
        for rule, tag in (("script-src", "script"), ("style-src", "style")):
            (content,) = re.findall(rf"<{tag}>(.*?)</{tag}>", text, re.DOTALL)
            digest = base64.b64encode(hashlib.sha256(content.encode()).digest()).decode()
            assert rules[rule] == f"'sha256-{digest}'"

    def test_the_licence_goes_with_it(self, text):
        assert "The MIT License" in text
        assert "three.js authors" in text
        assert "Leon Sorokin" in text
        assert all((PAGE / f"LICENSE.{name}").read_text() in text for name in ("three", "uplot"))

    def test_the_bundle_is_that_of_the_sources(self):
        """Otherwise: tools/viewer/build."""
        done = subprocess.run([ROOT / "tools/viewer/fingerprint"], capture_output=True, text=True, check=True)
        first = (PAGE / "bundle.js").read_text(encoding="utf-8").splitlines()[0]
        assert f"sources {done.stdout.strip()} " in first

    def test_every_control_has_a_name(self):
        page = (PAGE / "page.html").read_text()
        labelled = set(re.findall(r'<label[^>]* for="([^"]*)"', page))
        for tag in re.findall(r"<(?:input|select)\b[^>]*>", page):
            name = re.search(r'id="([^"]*)"', tag)[1]
            within = re.search(rf'<label[^>]*>[^<]*<(?:input|select)[^>]*id="{name}"', page)
            assert name in labelled or "aria-label=" in tag or within, tag
        for button in re.findall(r"<button\b.*?</button>", page, re.DOTALL):
            assert re.sub(r"<svg.*?</svg>|<[^>]*>", "", button, flags=re.DOTALL).strip(), button


class TestColours:
    @pytest.mark.parametrize(("style", "block"), [(LIGHT, 0), (DARK, 1)])
    def test_the_page_and_the_pictures_have_the_same(self, style, block):
        blocks = re.findall(r":root[^{]*\{([^}]*)\}", (PAGE / "page.css").read_text())
        values = dict(re.findall(r"--([\w-]+): (#\w{6})", blocks[block]))
        assert {name: values[name] for name in style._fields if name != "plane"} == {
            name: value for name, value in style._asdict().items() if name != "plane"
        }

    @pytest.mark.parametrize("block", [0, 1])
    def test_words_can_be_read(self, block):
        """WCAG AA: 4.5 for text, 3 for marks of controls."""
        blocks = re.findall(r":root[^{]*\{([^}]*)\}", (PAGE / "page.css").read_text())
        colours = dict(re.findall(r"--([\w-]+): (#\w{6})", blocks[block]))
        for ground in ("paper", "panel", "raised"):
            for word in ("ink", "soft", "accent"):
                assert contrast(colours[word], colours[ground]) >= 4.5, (word, ground)
            assert contrast(colours["deposit"], colours[ground]) >= 3.0
        assert contrast(colours["accent-ink"], colours["accent"]) >= 4.5
        assert contrast(colours["edge"], colours["paper"]) >= 3.0


def contrast(a: str, b: str) -> float:
    """Contrast ratio of WCAG 2.2."""

    def luminance(colour: str) -> float:
        channels = np.array(rgb(colour)) / 255.0
        linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
        return float(linear @ [0.2126, 0.7152, 0.0722])

    light, dark = sorted((luminance(a), luminance(b)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


class TestSize:
    def test_ten_thousand_bodies_at_a_hundred_times_are_below_30_MB(self, tmp_path):
        """From a fifth of them, whose shapes turn by 0.35 to 1 radians from time to time; with all arrays."""
        write_run(tmp_path, motion(2000, 100), mesh=False)
        path = write_page(Request(tmp_path), None, 1e6, "")
        page = PageReader(path.read_text(encoding="utf-8"))
        assert len(page.scene["times"]) == 100
        assert {"taylorDeformation", "U", "shearRate", "semiAxes", "age", "d"} <= set(page.scene["fields"])
        own = sum(map(len, re.findall(r'id="section-\d+">([^<]*)<', page.text)))
        assert path.stat().st_size - own + 5 * own < 30e6

    @pytest.mark.parametrize(
        ("bodies", "times", "limit", "notes"),
        [(2000, 20, 30.0, r""), (2000, 20, 1.7, r"\d+ of 20 times are shown\.")],
    )
    def test_times_give_way(self, tmp_path, capsys, bodies, times, limit, notes):
        write_run(tmp_path, motion(bodies, times), mesh=False)
        path = tmp_path / "page.html"
        assert main(["view", "-case", str(tmp_path), "-output", str(path), "-maxSize", str(limit)]) == 0
        assert path.stat().st_size <= limit * 1e6
        scene = PageReader(path.read_text(encoding="utf-8")).scene
        assert re.fullmatch(notes, " ".join(scene["notes"]))
        assert ("times fit in" in capsys.readouterr().out) == (limit < 30.0)
        assert scene["times"][-1] == pytest.approx(0.1 * (times - 1))
        assert len(scene["fields"]) >= 6

    def test_of_a_large_run_no_more_times_are_read_than_could_fit(self, tmp_path, monkeypatch):
        write_run(tmp_path, motion(5000, 50), mesh=False)
        read = []
        gathered = show.gather
        monkeypatch.setattr(show, "gather", lambda *given: read.append(gathered(*given)) or read[-1])
        path = write_page(Request(tmp_path, bodies=4900), None, 1.5, "")
        assert path.stat().st_size <= 1.5e6
        assert max(len(bodies.times) for bodies in read) <= 1.5e6 / (8 * 4900)
        # Few bodies tell the size of the page, which is packed once.
        assert [len(bodies.ids) for bodies in read].count(4900) == 1
        assert path.stat().st_size > 0.8 * 1.5e6


class TestCommand:
    def test_it_writes_beside_the_results(self, case, capsys):
        assert main(["view", "-case", str(case)]) == 0
        assert "40 bodies at 9 times" in capsys.readouterr().out
        assert (case / "postProcessing/softCloud/softCloud.html").stat().st_size > 500_000

    def test_without_a_mesh_the_bodies_alone(self, tmp_path, capsys):
        write_run(tmp_path, motion(5, 3), mesh=False)
        assert main(["view", "-case", str(tmp_path)]) == 0
        captured = capsys.readouterr()
        assert "No geometry is shown" in captured.out
        page = PageReader((tmp_path / "postProcessing/softCloud/softCloud.html").read_text())
        assert page.scene["surfaces"] == []
        assert page.scene["flow"] is None
        results = tmp_path / "postProcessing"
        write_page(Request(results, results=results), None, 1.5, "")
        assert "-case names the case." in capsys.readouterr().out

    @pytest.mark.parametrize(
        ("options", "said"),
        [
            (["-colour", "shearrate"], "Did you mean 'shearRate'?"),
            (["-range", "1", "0"], "the second must be the larger one"),
            (["-enlargement", "0"], "-enlargement 0: a number > 0 is needed"),
            (["-bodies", "0"], "-bodies 0: a number >= 1 is needed"),
            (["-slice", "q"], "-slice q: not a plane"),
            (["-slice", "z=7"], "misses the mesh"),
            (["-maxSize", "0.1"], "-maxSize 0.1: at least 1 (MB) is needed"),
            (["-size", "big", "-png", "a.png"], "-size big: not a width and a height like 1600x900"),
            (["-png", "a.jpg"], "the name must end in .png"),
            (["-film", "a.avi"], "the name must end in .mp4 or .gif"),
            (["-cloud", "hard"], "no results of a cloud 'hard'"),
            (["-flowTime", "3"], "no time 3"),
            (["-png", "a.png", "-film", "a.gif"], "not allowed with argument"),
        ],
    )
    def test_mistakes_end_in_one_message(self, case, capsys, options, said, monkeypatch):
        monkeypatch.setenv("DISPLAY", ":0")
        assert main(["view", "-case", str(case), *options]) == (2 if said.startswith("not allowed") else 1)
        err = capsys.readouterr().err
        assert said in err
        assert len(err.strip().splitlines()) == 1

    def test_a_time_that_was_not_written_is_reported(self, case, capsys):
        assert main(["view", "-case", str(case), "-time", "0.33"]) == 0
        assert "-time 0.33 s was not written; the nearest is 0.3 s" in capsys.readouterr().out
        page = PageReader((case / "postProcessing/softCloud/softCloud.html").read_text())
        assert page.scene["first"] == 3

    def test_fewer_bodies(self, case):
        assert main(["view", "-case", str(case), "-bodies", "7"]) == 0
        page = PageReader((case / "postProcessing/softCloud/softCloud.html").read_text())
        assert page.scene["bodies"]["ids"]["shape"] == [7]
