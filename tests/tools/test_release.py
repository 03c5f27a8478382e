"""The scripts of a release: what they check of the paper, and of a built site."""

from __future__ import annotations

import runpy
from pathlib import Path

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
