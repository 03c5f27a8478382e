"""Studies: values of entries, one flow for all runs, and going on."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import norm

import foamprb
from foamprb.cli import main
from foamprb.errors import InputError, RunInterrupted
from foamprb.run import job, sweep
from foamprb.run.sweep import read_study

STIFFNESS = "constantProperties/solid/Ca"


def study(folder: Path, text: str) -> Path:
    path = folder / "study.toml"
    path.write_text(text)
    return path


def test_values_are_lists_ranges_and_tables_and_the_last_changes_first(tmp_path):
    path = study(
        tmp_path,
        """
        case = "pipe"
        [entries]
        "solution/deltaT" = { from = 1e-6, to = 1e-4, number = 3, spacing = "log" }
        solution.maxSubSteps = 7
        [entries.constantProperties.solid]
        nu = { from = 0, to = 0.4, number = 2 }
        shape = ["sphere", [1, 2]]
        """,
    )
    found = read_study(path)
    assert found.case == tmp_path / "pipe"
    assert len(found) == 3 * 2 * 2
    assert [found.overrides(k)["solution/deltaT"] for k in (1, 5, 9)] == [1e-6, 1e-5, 1e-4]
    names = ["solution/deltaT", "solution/maxSubSteps", "constantProperties/solid/nu"]
    assert found.paths == (*names, "constantProperties/solid/shape")
    assert [found.overrides(k)["constantProperties/solid/shape"] for k in (1, 2, 3)] == [
        "sphere",
        [1, 2],
        "sphere",
    ]
    assert found.overrides(3) == dict(zip(found.paths, (1e-6, 7, 0.4, "sphere"), strict=True))
    every = {tuple(map(str, found.overrides(k).values())) for k in range(1, 13)}
    assert len(every) == 12
    assert found.described(12) == "deltaT 0.0001, maxSubSteps 7, nu 0.4, shape (1 2)"
    assert found.folder(12) == tmp_path / "study/012"


def test_names_of_entries_are_as_long_as_they_must_be(tmp_path):
    path = study(tmp_path, '[entries]\n"a/b/c" = 1\n"d/b/c" = 2\n"c" = 3\n')
    assert read_study(path).described(1) == "a/b/c 1, d/b/c 2, c 3"


def test_a_latin_hypercube_has_a_value_in_each_part_of_each_distribution(tmp_path):
    path = study(
        tmp_path,
        """
        [design]
        type = "latinHypercube"
        number = 20
        seed = 7
        [entries]
        a = { from = 1, to = 10000, spacing = "log" }
        fixed = 3
        b = { distribution = "normal", expectation = 10, variance = 1.4142135, minValue = 0, maxValue = 20 }
        c = ["yes", "no"]
        """,
    )
    found = read_study(path)
    a, fixed, b, c = zip(*found.rows, strict=True)
    assert len(found) == 20
    assert set(fixed) == {3}
    assert sorted(c) == 10 * ["no"] + 10 * ["yes"]
    shares = np.log10(a) / 4.0, norm.cdf(b, 10.0, 1.0)
    for values in shares:
        assert np.floor(np.sort(values) * 20.0).tolist() == list(range(20))
    assert read_study(path) == found
    path.write_text(path.read_text().replace("seed = 7", "seed = 8"))
    assert read_study(path).rows[0] != found.rows[0]


def test_a_sobol_design_changes_one_entry_at_a_time(tmp_path):
    text = '[design]\ntype = "sobol"\nnumber = 8\n[entries]\na = { from = 0, to = 1 }\nb = [1, 2, 3]'
    rows = read_study(study(tmp_path, text)).rows
    assert len(rows) == 8 * 4
    for k in range(0, 32, 4):
        (a, b), (c, d), (e, f), other = rows[k : k + 4]
        assert (c, f) == other
        assert (a, b) == (e, d)


def test_mistakes_in_designs_are_named(tmp_path):
    head = "[design]\ntype = 'sobol'\nnumber = 4\n"
    cases = {
        "design = 1\n[entries]\na = 1": "design is 1. Needed: a table with type, number, seed",
        "[design]\nkind = 1\n[entries]\na = 1": "design: kind is not known",
        "[design]\ntype = 'sobel'\n[entries]\na = 1": "Did you mean 'sobol'",
        "[design]\ntype = 'sobol'\nnumber = 6\n[entries]\na = [1]": "from 2 to 100000, a power of 2",
        f"{head}seed = -1\n[entries]\na = [1]": "seed is -1. Allowed: an integer >= 0",
        f"{head}[entries]\na = [1]": "no entry varies",
        f"{head}[entries]\na = {{ from = 1, to = 1 }}": "from and to are both 1",
        f"{head}[entries]\na = {{ from = 1, to = 2, number = 3 }}": "Omit number",
        f"{head}[entries]\na = {{ distribution = 'uniform', least = 2 }}": "toml: a.*least is not known",
        f"{head}[entries]\na = {{ distribution = 'norm' }}": "distribution is 'norm'. Did you mean 'normal'",
        f"{head}[entries]\na = {{ distribution = 'uniform', minValue = 2, maxValue = 1 }}": "toml: a.*below",
        f"{head}[entries]\na = {{ distribution = 'uniform', minValue = 2 }}": "study.toml: a.*maxValue",
        "[entries]\na = { distribution = 'uniform', minValue = 2, maxValue = 3 }": "Needed: .design.",
        "[design]\ntype = 'sobol'\nnumber = 65536\n[entries]\na = [1, 2]": "196608 runs of a Sobol design",
    }
    for text, message in cases.items():
        with pytest.raises(InputError, match=message):
            read_study(study(tmp_path, text))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[entries", "study.toml is no study: "),
        ("cases = 1", "cases is not known. Did you mean 'case'?"),
        ("case = 1", "case is 1. Allowed: a text in quotes"),
        ("", r"no entries. Needed: \[entries\]"),
        ("[entries]\na = []", "a has no values"),
        ('[entries]\n"a/b" = [1, 2]\na.b = [3, 4]', "entries has a/b twice, in quotes and as a table"),
        ("[entries]\na = { from = 1, number = 2 }", "a range needs from and to, two numbers"),
        (
            "[entries]\na = { from = 1, to = 2, number = 1 }",
            "number is 1. Allowed: an integer from 2 to 100000",
        ),
        ("[entries]\na = { from = 1, to = 2, number = 2, spacing = 'lin' }", "Did you mean 'linear'?"),
        ("[entries]\na = { from = 0, to = 2, number = 2, spacing = 'log' }", "from and to above 0"),
        (
            "[entries]\na = { from = 1, to = 2, number = 1000 }\nb = { from = 1, to = 2, number = 1000 }",
            "up to 100000",
        ),
    ],
)
def test_mistakes_are_named(tmp_path, text, message):
    with pytest.raises(InputError, match=message):
        read_study(study(tmp_path, text))


def test_a_study_is_the_runs_of_its_values_with_one_flow(case, tmp_path, monkeypatch, capsys):
    text = f'case = "pipe"\n[entries]\n"{STIFFNESS}" = [0.1, 0.5]\n'
    path = study(tmp_path, text)
    assert main(["sweep", str(path), "-list"]) == 0
    assert capsys.readouterr().out.split("\n")[:2] == ["1  Ca 0.1", "2  Ca 0.5"]
    read = []
    monkeypatch.setattr(job, "_read_flow", lambda *given, own=job._read_flow: read.append(1) or own(*given))
    assert main(["sweep", str(path), "-threads", "2"]) == 0
    assert len(read) == 1
    out = capsys.readouterr().out
    assert "Run 2 of 2: Ca 0.5: " in out
    assert f"Comparison: {tmp_path / 'study/comparison.html'}" in out
    for number, Ca in ((1, 0.1), (2, 0.5)):
        alone = foamprb.prepare(case, output=tmp_path / f"alone{number}", overrides={STIFFNESS: Ca})
        foamprb.execute(alone)
        own = (tmp_path / f"study/00{number}/softCloud/fates.csv").read_text()
        assert own == (tmp_path / f"alone{number}/softCloud/fates.csv").read_text()
    log = (tmp_path / "study/001/log.foamprb").read_text()
    assert "Fate of the particles" in log
    page = (tmp_path / "study/comparison.html").read_text()
    # Going on keeps what has ended, and does not mix it with other values.
    before = {
        number: (tmp_path / f"study/00{number}/softCloud/run.json").stat().st_mtime_ns for number in (1, 2)
    }
    path.write_text(text.replace("0.5", "0.6"))
    assert main(["sweep", str(path)]) == 1
    out = capsys.readouterr().out
    assert "Run 2 of 2: Ca 0.6: " in out
    assert "a run with other values of the entries is here" in out
    after = {
        number: (tmp_path / f"study/00{number}/softCloud/run.json").stat().st_mtime_ns for number in (1, 2)
    }
    assert before == after
    # The earlier second run is none of this study.
    assert "1 runs that have ended" in (tmp_path / "study/comparison.html").read_text()
    runs = foamprb.open_runs(tmp_path / "study/*")
    assert list(runs) == ["001", "002"]
    clouds = foamprb.open_runs(tmp_path / "study/*/softCloud")
    assert list(clouds) == ["001/softCloud", "002/softCloud"]
    np.testing.assert_array_equal(clouds.table()["D"], runs.table()["D"])
    table = runs.table()
    assert sorted(set(table[STIFFNESS].tolist())) == [0.1, 0.5]
    n = len(runs["001"].table()["id"])
    np.testing.assert_array_equal(table["D"][table["run"] == "002"], runs["002"].table()["D"])
    assert len(table["id"]) == 2 * n
    # A pattern that the shell has expanded, which finds the page, too.
    assert list(foamprb.open_runs(*sorted((tmp_path / "study").iterdir()))) == ["001", "002"]
    for text in (
        '<td class="n">0.1</td>',
        "stuck: wall",
        "Distribution of residence time",
    ):
        assert text in page
    for name, run in runs.items():
        D = run.table()["maxD"]
        last = "".join(rf'<td class="n">{np.quantile(D, share):.4g} \([^<]*\)</td>' for share in (0.5, 0.95))
        assert re.search(rf"<tr><t[dh][^>]*>{name}</t[dh]>(?:(?!</tr>).)*{last}</tr>", page)


def test_one_run_of_a_job_array(case, tmp_path, capsys):
    """The log of the first would never be opened."""
    path = study(tmp_path, f'case = "pipe"\n[entries]\n"{STIFFNESS}" = [0.1, 0.5]\n')
    (tmp_path / "study/001").mkdir(parents=True)
    os.mkfifo(tmp_path / "study/001/log.foamprb")
    assert main(["sweep", str(path), "-run", "1"]) == 1
    assert "log.foamprb: no regular file" in capsys.readouterr().out
    shutil.rmtree(tmp_path / "study")
    assert main(["sweep", str(path), "-run", "3"]) == 1
    assert "-run 3: the study has the runs 1 to 2" in capsys.readouterr().err
    assert main(["sweep", str(path), "-run", "2"]) == 0
    assert [folder.name for folder in (tmp_path / "study").iterdir()] == ["002"]


def test_a_study_without_its_case_starts_no_run(tmp_path, capsys):
    path = study(tmp_path, 'case = "pip"\n[entries]\n"solution/deltaT" = [1e-5, 2e-5]\n')
    assert main(["sweep", str(path)]) == 1
    assert f"study.toml: case: {tmp_path / 'pip'} is no folder" in capsys.readouterr().err
    assert not (tmp_path / "study").exists()


def test_a_run_that_cannot_start_does_not_stop_the_others(case, tmp_path, capsys):
    """Nor do brackets in its name, which are no pattern."""
    path = study(tmp_path, 'case = "pipe"\n[entries]\n"solution/deltaT" = [-1.0, 2e-5]\n')
    path = path.rename(tmp_path / "s[1].toml")
    assert main(["sweep", str(path)]) == 1
    out = capsys.readouterr().out
    assert "Run 1 of 2: deltaT -1: " in out
    assert "Run 2 of 2: deltaT 2e-05: " in out
    assert "1 runs that have ended" in (tmp_path / "s[1]/comparison.html").read_text()
    assert not (case / "postProcessing").exists()


@pytest.mark.parametrize("options", [[], ["-list"], ["-run", "2"]])
def test_a_misspelt_entry_is_reported_once_and_starts_no_run(case, tmp_path, capsys, options):
    path = study(tmp_path, 'case = "pipe"\n[entries]\n"solution/deltaTT" = [1e-5, 2e-5]\n')
    assert main(["sweep", str(path), *options]) == 1
    captured = capsys.readouterr()
    assert captured.err.count("solution/deltaTT") == 1
    assert "Did you mean 'deltaT'?" in captured.err
    assert not captured.out
    assert not (tmp_path / "study").exists()


def test_a_signal_ends_the_study_and_the_same_command_continues(case, tmp_path, monkeypatch, capsys):
    path = study(tmp_path, f'case = "pipe"\n[entries]\n"{STIFFNESS}" = [0.1, 0.5]\n')

    def interrupted(job, start_from):
        raise RunInterrupted("stopped at t = 1 s.", 15)

    with monkeypatch.context() as patch:
        patch.setattr(sweep, "execute_until_signal", interrupted)
        assert main(["sweep", str(path)]) == 128 + 15
    captured = capsys.readouterr()
    assert "Run 1 of 2: Ca 0.1: stopped. The same command continues." in captured.err
    assert "Run 2" not in captured.out + captured.err


def test_folders_without_results_are_named(tmp_path):
    (tmp_path / "a").mkdir()
    with pytest.raises(InputError, match="no results here"):
        foamprb.open_runs(tmp_path / "a")
    with pytest.raises(InputError, match="no results there"):
        foamprb.open_runs(tmp_path / "*")
