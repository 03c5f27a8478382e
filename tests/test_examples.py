"""The examples run, each with the number that it asserts, and draw a picture; the page shows them all."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from paths import ROOT

EXAMPLES = sorted((ROOT / "examples").glob("*.py"))


@pytest.mark.parametrize("script", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs(script: Path, tmp_path: Path) -> None:
    picture = tmp_path / "picture.png"
    command = [sys.executable, str(script), str(picture)]
    done = subprocess.run(command, capture_output=True, text=True, env=None, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert picture.stat().st_size > 5000
    assert "assert " in script.read_text()
    assert len(script.read_text().splitlines()) <= 60


def test_the_page_shows_every_example():
    page = (ROOT / "docs/examples.md").read_text()
    assert sorted(re.findall(r"!\[.*?\]\(examples/(\w+)\.png\)", page)) == [path.stem for path in EXAMPLES]
    assert all((ROOT / "docs/examples" / f"{path.stem}.png").exists() for path in EXAMPLES)
