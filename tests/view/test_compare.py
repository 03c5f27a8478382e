"""Comparison of runs: differences with intervals, and indices of a Sobol design."""

from __future__ import annotations

import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from figures.indices import exact, ishigami

from foamprb.errors import InputError
from foamprb.run.sweep import read_study
from foamprb.view.report.compare import write_comparison
from foamprb.view.results import summary_of
from foamprb.view.runs import Runs
from foamprb.view.sensitivity import design_of, sobol_indices

N = 400


def fates(side, D=0.1, y=None):
    """A table of fates: the particles for which ``side`` is true leave there, the others straight on."""
    n = len(side)
    return {
        "id": np.arange(n), "t0": np.zeros(n), "t1": np.linspace(1.0, 2.0, n), "D": np.full(n, D),
        "x0": np.zeros(n), "y0": np.arange(n) / n if y is None else y, "z0": np.zeros(n),
        "fate": np.full(n, "escaped"), "patch": np.where(side, "side", "straight"),
    }  # fmt: skip


def runs_of(tables, overrides):
    """Runs with such fates and replaced entries, numbered from 1 on."""
    names = [f"{k:03d}" for k in range(1, len(tables) + 1)]
    made = {
        name: SimpleNamespace(
            fates=lambda table=table: table,
            record={"settings": {"overrides": {path: f"{value};" for path, value in entries.items()}}},
        )
        for name, table, entries in zip(names, tables, overrides, strict=True)
    }
    return Runs(made, {name: Path("study") / name for name in names})


def cells(page: Path, caption: str) -> list[list[str]]:
    """The rows of a table."""
    text = page.read_text().partition(f"<caption>{caption}")[2].partition("</table>")[0]
    rows = re.findall(r"<tr>(.*?)</tr>", text.partition("<tbody>")[2])
    return [re.findall(r"<t[dh][^>]*>(.*?)</t[dh]>", row) for row in rows]


def test_runs_of_the_same_particles_are_compared_in_pairs(tmp_path):
    y = np.arange(N) / N
    tables = [fates(y < 0.3), fates(y < 0.34), fates(y < 0.34, y=y + 1.0)]
    runs = runs_of(tables, [{"a": 1}, {"a": 2}, {"a": 3}])
    first, other = cells(write_comparison(runs, tmp_path / "page.html"), "Differences")
    assert first[:2] == ["a 2", "yes"]
    assert other[:2] == ["a 3", "no"]
    (d, low, high), (same, far_low, far_high) = (
        [float(x.replace("−", "-")) for x in re.fullmatch(r"(\S+) \((\S+) to (\S+)\) %", row[2]).groups()]
        for row in (first, other)
    )
    assert d == same == pytest.approx(4.0)
    # Only 16 of 400 particles change: with n₁₂ = 0 and n₂₁ = 16 the standard error is 0.98 %.
    assert low > 1.5
    assert high < 6.5
    assert far_low < -2.0
    assert far_high > 10.0
    assert first[4].startswith("0 ")


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """A Sobol design of three entries, and one that does not vary."""
    path = tmp_path_factory.mktemp("study") / "s.toml"
    angle = "{ from = -3.14159265358979, to = 3.14159265358979 }"
    entries = f'x = {angle}\ny = {angle}\n"sub/z" = {angle}\nfixed = 5'
    path.write_text(f'[design]\ntype = "sobol"\nnumber = 4096\nseed = 3\n[entries]\n{entries}\n')
    return read_study(path)


def test_indices_of_ishigamis_function(study):
    """sin x + 7 sin² y + 0.1 z⁴ sin x, whose indices are known in closed form, to 2 %."""
    entries = np.array(study.rows, dtype=float)
    assert (entries[:, 3] == 5.0).all()
    f = ishigami(entries[:, :3])
    indices = {name: np.array(values) for name, values in sobol_indices(f.reshape(-1, 5)).items()}
    for kind, expected in zip(("first", "total"), exact(), strict=True):
        np.testing.assert_allclose(indices[kind], expected, atol=0.02)
        assert (indices[f"{kind}Low"] <= expected).all()
        assert (expected <= indices[f"{kind}High"]).all()


def test_page_of_a_design_has_indices(tmp_path, study):
    """The share of one outlet follows one entry, whose indices are 1; a row that lacks a run is left out."""
    n = 5 * 19
    rows = [study.overrides(number) for number in range(1, n + 1)]
    tables = [fates(np.arange(N) < N * (0.5 + 0.1 * row["x"])) for row in rows]
    runs = runs_of(tables, rows)
    del runs.runs["007"]
    page = write_comparison(runs, tmp_path / "page.html")
    listed = cells(page, "Indices of Sobol by 80 runs")
    assert "3 rows of the design are left out" in page.read_text()
    assert "Differences from the first run" not in page.read_text()
    found = {(what, entry): (first, total) for what, entry, first, total in listed}
    # Times and D are the same in all runs.
    assert {what for what, _ in found} == {"share escaped: side", "share escaped: straight"}
    for text in found["share escaped: side", "x"]:
        value, low, high = map(float, re.fullmatch(r"(\S+) \((\S+) to (\S+)\)", text).groups())
        assert low <= 1.0 <= high
        assert value == pytest.approx(1.0, abs=0.2)
    table = runs.indices()
    assert table["result"].tolist() == [row[0] for row in listed]
    assert table["entry"].tolist()[:3] == ["x", "y", "sub/z"]
    assert f"{table['total'][0]:.4g}" == found["share escaped: side", "x"][1].split()[0]
    for entry in ("y", "z"):
        assert [text.split()[0] for text in found["share escaped: side", entry]] == ["0", "0"]


def test_patches_of_runs_meet_by_place(tmp_path):
    """The second run has other names; its patches are those of the first where area and centre agree."""
    y = np.arange(N) / N
    runs = runs_of([fates(y < 0.3), fates(y < 0.3)], [{"a": 1}, {"a": 2}])
    runs["002"].fates()["patch"] = np.where(y < 0.3, "port_1", "port_2")
    places = {"side": (1e-6, [0.0, 0.0, 0.0]), "straight": (1e-6, [0.01, 0.0, 0.0])}

    def record(names, shift):
        patches = [
            {"name": name, "area": 1.02 * area, "centre": [c[0] + shift, *c[1:]]}
            for name, (area, c) in zip(names, places.values(), strict=True)
        ]
        return {"patches": patches}

    runs["001"].record.update(record(places, 0.0))
    runs["002"].record.update(record(("port_1", "port_2"), 1e-5))
    page = write_comparison(runs, tmp_path / "page.html")
    assert "<title>Comparison: 001, 002</title>" in page.read_text()
    assert "The patch port_1 of 002 lies where side of the first run does" in page.read_text()
    first, second = cells(page, "Share of the particles")
    assert first[1:] == second[1:]
    assert first[1].startswith("30 ")
    runs["002"].record.update(record(("port_1", "port_2"), 1e-3))
    assert len(cells(write_comparison(runs, page), "Share of the particles")[0]) == 5


def test_runs_without_particles_and_without_a_design(tmp_path):
    y = np.arange(0.0)
    runs = runs_of([fates(y < 0.3), fates(y < 0.3)], [{"a": 1}, {"a": 2}])
    (row,) = cells(write_comparison(runs, tmp_path / "page.html"), "Differences")
    assert row == ["a 2", "yes", "", ""]
    with pytest.raises(InputError, match="no Sobol design among the 2 runs that have ended"):
        runs.indices()


def test_other_studies_are_no_designs(study):
    names = [f"{k}" for k in range(1, 61)]
    rows = [study.overrides(k) for k in range(1, 61)]
    entries = {
        name: {path: str(value) for path, value in row.items()} for name, row in zip(names, rows, strict=True)
    }
    numbers = {name: int(name) for name in names}
    assert design_of(numbers, entries, names).paths == ("x", "y", "sub/z")
    assert design_of(dict.fromkeys(names), entries, names) is None
    shuffled = dict(zip(names, list(entries.values())[::-1], strict=True))
    assert design_of(numbers, shuffled, names) is None
    grid = {name: {"a": str(k // 4), "b": str(k % 4)} for k, name in enumerate(names)}
    assert design_of(numbers, grid, names) is None


def test_summary_counts_fates_by_patch():
    table = fates(np.arange(N) < 100)
    table["fate"][-20:] = "stuck"
    summary = summary_of(table)
    assert list(zip(summary["fate"], summary["patch"], summary["particles"], strict=True)) == [
        ("escaped", "straight", 280), ("escaped", "side", 100), ("stuck", "straight", 20)
    ]  # fmt: skip
    assert summary["share"][1] == 100 / 400
    assert summary["shareLow"][1] == pytest.approx(0.2101, abs=1e-4)
