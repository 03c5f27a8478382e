"""The examples run, each with the number that it asserts, and draw a picture; the page shows them all."""

from __future__ import annotations

import re
import runpy
import sys
from pathlib import Path

import pytest
from matplotlib import pyplot as plt
from paths import ROOT

EXAMPLES = sorted((ROOT / "examples").glob("*.py"))


@pytest.mark.usefixtures("solids")
@pytest.mark.parametrize("script", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs(script: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    picture = tmp_path / "picture.png"
    monkeypatch.setattr(sys, "argv", [str(script), str(picture)])
    monkeypatch.setenv("MPLBACKEND", "agg")
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(script), run_name="__main__")
    # An example ends with its process, here the figures would remain: matplotlib warns of the twenty-first.
    plt.close("all")
    assert picture.stat().st_size > 5000
    assert "assert " in script.read_text()
    assert len(script.read_text().splitlines()) <= 60


def test_the_gallery_has_a_card_code_and_a_download_of_each() -> None:
    gallery = runpy.run_path(str(ROOT / "docs/conf.py"))["gallery"]
    text = gallery((ROOT / "docs/examples.md").read_text())
    for pattern in (r":img-top: {}\.png", r"literalinclude\}} \.\./{}\.py", r"<\.\./{}\.py>"):
        pattern = pattern.format(r"examples/(\w+)")
        assert sorted(re.findall(pattern, text)) == [path.stem for path in EXAMPLES]


def test_the_page_shows_every_example():
    page = (ROOT / "docs/examples.md").read_text()
    assert sorted(re.findall(r"!\[.*?\]\(examples/(\w+)\.png\)", page)) == [path.stem for path in EXAMPLES]
    assert all((ROOT / "docs/examples" / f"{path.stem}.png").exists() for path in EXAMPLES)
