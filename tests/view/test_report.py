"""Report: its numbers, its independence of a network, and its contrast on both backgrounds."""

from __future__ import annotations

import html
import re
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from view_run import PATCHES, motion, write_run

from foamprb.cli import main
from foamprb.errors import InputError
from foamprb.results.folder import TOUCHED
from foamprb.results.tables import write_table
from foamprb.view.report import plots
from foamprb.view.report.page import table
from foamprb.view.report.report import stuck_at_release, write_report

N = 60
LARGEST = {
    "maxD": 0.65, "maxShearRate": 100.0, "maxShearStress": 0.1, "maxReynolds": 0.01, "curvatureNumber": 0.2,
    "maxBulletAmplitude": 0.3,
}  # fmt: skip
"""Largest values on the paths, and the largest of these."""


@pytest.fixture(scope="module")
def case(tmp_path_factory) -> Path:
    """Sixty bodies in the unit cube: a third sticks to the floor, a third leaves, a third is on its way."""
    case = tmp_path_factory.mktemp("report") / "cube"
    folder = write_run(case, motion(N, 4))
    random = np.random.default_rng(1)
    fate = np.array(["active", "stuck", "escaped"])[np.arange(N) % 3]
    places = {"active": "", "stuck": PATCHES[0], "escaped": PATCHES[2]}
    x = random.uniform(0.05, 0.95, (N, 3))
    x[fate == "stuck", 2] = 0.0
    write_table(
        folder / "fates.csv",
        {
            "id": np.arange(N), "Ca": np.full(N, 0.5), "t0": np.zeros(N), "t1": random.uniform(0.1, 0.3, N),
            **{f"{k}1": x[:, i] for i, k in enumerate("xyz")},
            "fate": fate.tolist(), "patch": [places[f] for f in fate], "D": random.uniform(0.0, 0.4, N),
            **{name: np.linspace(0.0, most, N) for name, most in LARGEST.items()},
            "minGap": np.full(N, np.inf),
        },
    )  # fmt: skip
    return case


@pytest.fixture(scope="module")
def page(case) -> str:
    return write_report(case).read_text(encoding="utf-8")


class Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.ids: list[str] = []
        self.links: list[str] = []
        self.sources: list[str] = []
        self.unnamed = 0
        self.open: list[str] = []

    def handle_starttag(self, tag: str, attributes) -> None:
        given = dict(attributes)
        self.ids += [given["id"]] if "id" in given else []
        self.links += [given["href"]] if tag == "a" else []
        self.sources += [given[key] for key in ("src", "srcset") if key in given]
        self.unnamed += (tag == "img" and not given.get("alt")) or (
            tag == "svg" and not given.get("aria-label")
        )
        if tag not in ("meta", "img", "source", "link", "br", "path", "use", "rect", "image"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if tag not in ("path", "use", "rect", "image"):
            assert self.open.pop() == tag


def test_the_headline_is_the_largest_deformation_on_the_paths(page):
    """Not that at the end; the table has the shares beyond the limits."""
    assert '<span class="figures">0.65</span>largest D on the paths' in page
    text = re.sub("<[^>]+>", " ", page.split("Largest values on the paths</caption>")[1])
    assert re.search(r"curvature number\s+0.1\s+0.198\s+0.2\s+50 % \(37.7–62.3 %\) beyond 0.1", text)
    assert re.search(r"Reynolds number\s+0.005\s+0.0099\s+0.01\s+0 % \(0–6.02 %\) beyond 0.1", text)


def test_the_head_warns_of_particles_beyond_the_model(page):
    head = html.unescape(page.partition('id="bodies"')[0])
    assert "20 of 60 particles reached a bullet amplitude beyond 0.2" in head
    assert "particles 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, … (column maxBulletAmplitude of fates)" in head


def test_the_page_needs_no_network(page):
    reader = Reader()
    reader.feed(page)
    assert all(source.startswith("data:") for source in reader.sources)
    assert not [link for link in reader.links if "://" in link]
    assert "default-src 'none'" in page
    assert "<script" not in page


def test_every_picture_has_a_name_and_every_id_is_there_once(page):
    reader = Reader()
    reader.feed(page)
    assert reader.unnamed == 0
    assert [name for name in set(reader.ids) if reader.ids.count(name) > 1] == []
    inner = [link[1:] for link in reader.links if link.startswith("#")]
    assert inner
    assert set(inner) <= set(reader.ids)


def test_no_header_of_a_table_is_empty(page):
    assert "Largest values on the paths" in page
    assert not re.search(r"<th[^>]*></th>", page)


def test_no_level_of_headings_is_left_out(case):
    text = write_report(case, case / "warned.html").read_text(encoding="utf-8")
    levels = [1, *map(int, re.findall(r"<h([1-6])", text))]
    assert ">Warnings<" in text
    assert max(np.diff(levels)) <= 1


def test_texts_of_a_table_are_escaped():
    text = '<b>a & "b"'
    made = table(text, [text, text], [[text, text]])
    escaped = html.escape(text)
    assert made.count(escaped) == 6
    assert "<b>" not in made


def test_links_lead_to_files(case, page):
    reader = Reader()
    reader.feed(page)
    outer = [link for link in reader.links if not link.startswith("#")]
    assert len(outer) > 8
    assert all((case / "postProcessing/softCloud" / link).exists() for link in outer)


def test_the_numbers_are_those_of_the_table(page):
    """Wilson's interval of 20 of 60 is (p + z²/2n ± z √(p(1 − p)/n + z²/4n²))/(1 + z²/n), z = 1.96."""
    p, z = 1.0 / 3.0, 1.959964
    middle, half = p + z * z / (2 * N), z * np.sqrt(p * (1 - p) / N + z * z / (4 * N * N))
    low, high = (100.0 * (middle + side * half) / (1 + z * z / N) for side in (-1, 1))
    share = f"33.3 % ({low:.3g}–{high:.3g} %)"
    for number, what in (
        (N, "injected"),
        *((N // 3, f"{fate}, {share}") for fate in ("active", "stuck", "escaped")),
    ):
        assert f'<span class="figures">{number}</span>{what}' in page
    assert f'<td class="n">{share}</td>' in page
    assert re.search(r'<th scope="row">floor</th><td class="n">20</td><td class="n">1</td>', page)


def test_no_section_says_only_that_there_is_nothing(page):
    """Neither particleTracks nor particleHistogram ran, and the results have no record."""
    sections = re.findall(r'<section id="(\w+)"', page)
    assert sections == ["scene", "fates", "deposition", "residence", "deformation", "files"]
    assert "did not have" not in page
    assert "No record: the run has no run.json" in page.partition("<main>")[0]


def luminance(colour: str) -> float:
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a: str, b: str) -> float:
    low, high = sorted((luminance(a), luminance(b)))
    return (high + 0.05) / (low + 0.05)


def test_letters_and_marks_stand_out_on_both_grounds(page):
    """WCAG 2.2 AA: 4.5 for letters, 3 for marks (1.4.3, 1.4.11)."""
    schemes = re.findall(r":root \{([^}]*)\}", page)
    assert len(schemes) == 2
    for scheme in schemes:
        colour = dict(re.findall(r"--(\w+): (#\w{6})", scheme))
        for ground in ("paper", "panel"):
            for ink in ("ink", "soft", "accent", "warn"):
                assert contrast(colour[ink], colour[ground]) >= 4.5
        for fate, mark in plots.FATES.items():
            assert contrast(mark, colour["paper"]) >= 2.9, fate


def test_plots_take_the_colours_of_the_page(page):
    svg = "".join(re.findall(r"<svg.*?</svg>", page, re.DOTALL))
    assert "currentColor" in svg
    assert not re.search(r"#17202a|#000000", svg)


def test_particles_that_were_not_followed_are_refused(case, capsys):
    assert main(["report", "-case", str(case), "-paths", "x"]) == 1
    assert "numbers of particles are needed" in capsys.readouterr().err


def test_a_run_that_has_not_ended(tmp_path, capsys):
    write_run(tmp_path, motion(3, 2))
    assert main(["report", "-case", str(tmp_path)]) == 1
    assert "the run has not ended" in capsys.readouterr().err


@pytest.mark.parametrize("record", ['{"warnings": 3}', '{"versions": 1}'])
def test_an_edited_record_is_one_message(case, record):
    file = case / "postProcessing/softCloud/run.json"
    file.write_text(record)
    try:
        with pytest.raises(InputError, match=r"run\.json is damaged: (warnings|versions) is [13], not"):
            write_report(case)
    finally:
        file.unlink()


def test_places_of_release_are_drawn_across_their_plane():
    y = np.linspace(0.0, 2e-3, 21)
    x = np.stack([np.full(21, 0.5), y, 3.0 * y**2], axis=1)
    fates = np.where(y < 1e-4, "stuck", "escaped")
    svg = plots.by_origin(x, fates).svg
    assert all(text in svg for text in ("y [mm]", "z [mm]", "stuck (1)", "escaped (20)"))


def test_names_are_no_formulas():
    """A dollar in the name of a patch began a formula, whose errors ended the report."""
    assert "a$b_$^" in plots.shares({"a$b_$^": {"stuck": 3}}).svg


def test_legends_have_a_place_of_their_own(monkeypatch):
    """A search for a free place took seconds on a busy computer, and matplotlib warned of it."""
    monkeypatch.delattr("matplotlib.legend.Legend._find_best_position")
    x = np.arange(4.0)
    assert "stuck" in plots.shares({"wall": {"stuck": 3}}).svg
    assert "stuck" in plots.histogram({"stuck": x}, "t", "s").svg
    assert "median" in plots.curves([("median", x, x)], ("t", "s"), ("D", "1")).svg


def test_the_flow_of_a_large_mesh_is_not_reconstructed(case, tmp_path, monkeypatch):
    """The report shows walls, which need the mesh alone; only its picture has streamlines."""
    monkeypatch.setattr("foamprb.flow.read.openfoam.Reconstruction", None)
    monkeypatch.setattr("foamprb.view.show.MOST_CELLS", 0)
    write_report(case, tmp_path / "report.html")
    assert "Deposition on walls" in (tmp_path / "report.html").read_text()


def test_bodies_that_touched_a_wall_at_their_release_are_told():
    fates = {"fate": np.array(["stuck"] * 77 + ["escaped"] * 23), TOUCHED: np.arange(100) < 50}
    said = stuck_at_release(fates, 100)
    assert said.startswith("stuck 77, of these 50 touched at release; of the others 54")
    assert stuck_at_release({**fates, TOUCHED: np.zeros(100, dtype=int)}, 100) == ""
