"""The public names: one list in three places, and no page needs another name."""

from __future__ import annotations

import ast
import re
from importlib import import_module
from pathlib import Path

import pytest
from paths import ROOT

import foamprb

PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md"), *(ROOT / "cases").glob("*/README.md")])
# Whoever changes the package needs its other names.
PAGES.remove(ROOT / "docs/development.md")
SCRIPTS = sorted((ROOT / "cases").glob("*/*.py"))


def documented() -> list[str]:
    return re.findall(r"^    (\w+) {2,}\S", foamprb.__doc__ or "", re.MULTILINE)


def test_docstring_list_and_table_name_the_same():
    assert sorted(foamprb.__all__) == list(foamprb.__all__)
    assert foamprb.__all__ == sorted(documented())
    assert list(foamprb._HOMES) == list(foamprb.__all__)


def test_every_public_name_has_a_docstring_and_a_home():
    faults = []
    for name, home in foamprb._HOMES.items():
        found = getattr(foamprb, name)
        own = getattr(found, "__module__", home).startswith("foamprb.")
        if not (own and found.__doc__ and found is getattr(import_module(home), name)):
            faults.append(name)
    assert not faults


def test_the_names_for_type_checkers_are_the_same():
    tree = ast.parse(Path(foamprb.__file__).read_text())
    (block,) = [node for node in tree.body if isinstance(node, ast.If)]
    homes = {
        alias.name: node.module
        for node in block.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    assert homes == foamprb._HOMES


def test_other_names_are_refused():
    with pytest.raises(AttributeError, match="no attribute 'Clowd'"):
        _ = foamprb.Clowd


def used(tree: ast.AST) -> set[str]:
    """What some Python text takes from foamprb, by full names."""
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "foamprb":
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names if alias.name.startswith("foamprb.")}
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            found |= {f"foamprb.{node.attr}"} if node.value.id == "foamprb" else set()
    return found


def is_public(name: str) -> bool:
    package, _, rest = name.partition(".")
    return package == "foamprb" and rest.split(".")[0] in {*foamprb.__all__, "__version__"}


def test_pages_and_scripts_of_cases_use_public_names_only():
    names = set()
    for page in PAGES:
        text = page.read_text()
        found = set().union(
            *(used(ast.parse(b)) for b in re.findall(r"```python\n(.*?)```", text, re.DOTALL))
        )
        # In sentences as well; words with a slash are files.
        found |= set(re.findall(r"\bfoamprb(?:\.\w+)+", re.sub(r"\S*/\S*", "", text)))
        names |= {(page.name, name) for name in found}
    for script in SCRIPTS:
        names |= {(script.name, name) for name in used(ast.parse(script.read_text()))}
    assert not {(file, name) for file, name in names if not is_public(name)}
