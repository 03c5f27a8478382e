"""The scripts of a release: what they check of the paper, and of a built site."""

from __future__ import annotations

import re
import runpy
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from paths import ROOT


def test_paper_lacks_only_what_the_owner_gives():
    paper = runpy.run_path(str(ROOT / "tools/release"))["paper"]()
    missing = {check.name for check in paper if not check.met}
    assert missing <= {"authors with affiliations", "references are complete"}


def test_links_of_a_site_are_followed_to_anchors(tmp_path: Path):
    (tmp_path / "a.html").write_text(
        '<a href="b.html#one"></a><a href="b.html#two"></a><a href="c.html"></a>'
    )
    (tmp_path / "b.html").write_text('<p id="one"></p><a href="https://elsewhere.org/x"></a>')
    broken = runpy.run_path(str(ROOT / "tools/site_check"))["broken"]
    assert broken(tmp_path) == ["a.html: b.html#two", "a.html: c.html"]


def test_locked_versions_are_allowed_ones():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    locked: dict[str, list[str]] = {}
    for name, version in re.findall(
        r"^([a-z0-9-]+)==([^\s;]+)", (ROOT / "requirements/run.txt").read_text(), re.M
    ):
        locked.setdefault(name, []).append(version)
    for bounds in (*project["dependencies"], *project["optional-dependencies"]["view"]):
        need = Requirement(bounds)
        versions = locked[need.name]
        assert all(need.specifier.contains(version) for version in versions), bounds


@pytest.mark.parametrize("name", ["run", "build"])
def test_each_locked_package_has_a_hash_and_no_address(name):
    """An address would be that of the computer that made the lock."""
    text = (ROOT / f"requirements/{name}.txt").read_text()
    packages = re.split(r"^(?=\S)", text, flags=re.MULTILINE)[1:]
    assert len(packages) > 20
    assert all("--hash=sha256:" in package for package in packages)
    assert "://" not in text
