"""The pages under docs/: links lead somewhere, and examples run."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from paths import ROOT
from validation.registry import CASES

from foamprb.body.material import MATERIALS
from foamprb.cli.main import _parser
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.measures import MEASURES

PAGES = sorted((ROOT / "docs").rglob("*.md"))
MODELS = sorted(page for page in PAGES if page.parent.name == "models" and page.stem != "index")


def targets(page: Path) -> list[str]:
    return [t for t in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", page.read_text()) if "://" not in t]


def test_links_lead_to_files():
    assert not [(page.name, t) for page in PAGES for t in targets(page) if not (page.parent / t).exists()]


def test_sections_link_every_page():
    sections = [ROOT / "docs" / f"{name}.md" for name in ("how-to", "evidence")]
    sections += [page for page in PAGES if page.stem == "index"]
    known = {(page.parent / t).resolve() for page in sections for t in targets(page)}
    assert {page for page in PAGES if page not in sections} <= known


def test_each_kind_of_file_has_three_commands():
    text = (ROOT / "docs/which-file.md").read_text()
    blocks = re.findall(r"```sh\n(.*?)```", text, re.DOTALL)
    assert len(blocks) == 6
    for block in blocks:
        lines = block.splitlines()
        assert len(lines) == 3
        for line in lines:
            if line.startswith("foamprb "):
                _parser().parse_args(shlex.split(re.sub(r" -(?=[a-z]{2})", " --", line))[1:])
    for page in ("README.md", "docs/index.md"):
        assert "which-file.md" in (ROOT / page).read_text().partition("\n## ")[0].partition("::::")[0]


def test_pages_of_models_name_the_cases_that_check_them():
    faults = {}
    for page in MODELS:
        text = page.read_text().partition("**Checked by**")[2].partition("\n\n")[0]
        named = set(re.findall(r"`([A-Za-z]+)`", text))
        if not named & set(CASES) or not named <= {*CASES, *INTEGRATORS, "solve_ivp"}:
            faults[page.name] = named
    assert not faults


def test_page_of_integrators_lists_all():
    """With whether the solid has inertia, and the order."""
    page = (ROOT / "docs" / "integrators.md").read_text()
    listed = re.findall(r"^\| `(\w+)` \| (yes|no) \| (\d)(?:\(\d\))? \|", page, re.MULTILINE)
    assert listed == [(i.name, "yes" if i.inertia else "no", str(i.order)) for i in INTEGRATORS.values()]
    assert all(f"`{name}`" in (ROOT / "docs" / "settings.md").read_text() for name in INTEGRATORS)


def test_page_of_files_lists_the_arrays_of_a_cloud():
    page = (ROOT / "docs/reference/files.md").read_text().partition("## Arrays of a cloud")[2]
    listed = re.findall(r"^\| `(\w+)` \| ([\w/ ]*?) ?\|", page.partition("\n## ")[0], re.MULTILINE)
    assert listed == [(name, measure.unit) for name, measure in MEASURES.items()]


def test_example_of_a_solid_runs(monkeypatch):
    before = dict(MATERIALS)
    monkeypatch.setattr("foamprb.body.material.MATERIALS", dict(before))
    page = (ROOT / "docs" / "models" / "materials.md").read_text()
    (code,) = re.findall(r"<!-- run -->\n```python\n(.*?)```", page, re.DOTALL)
    exec(code, {"__name__": "example"})
    import foamprb.body.material as material

    yeoh = material.MATERIALS["yeoh"]
    # Twice the stiffness of neo-Hooke's at I₁ = 3 + 1/k.
    assert yeoh.derivatives(5.0, 3.0, 1.0, 1.0, 3.0, 0.5)[0] == pytest.approx(1.0)
