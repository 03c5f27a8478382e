"""The public names, and their use on the pages."""

from __future__ import annotations

import ast
import doctest
import importlib
import inspect
import re

import pytest
from paths import ROOT

import foamprb

PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md"), *(ROOT / "cases").glob("*/README.md")])
# Whoever changes the package needs its other names.
PAGES.remove(ROOT / "docs/development.md")
# Directives of the reference, which name modules of the package.
REFERENCE = sorted((ROOT / "docs/reference").glob("*.md"))
PAGES = [page for page in PAGES if page not in REFERENCE]
SCRIPTS = sorted((ROOT / "cases").glob("*/*.py"))


def documented() -> list[str]:
    return re.findall(r"^    (\w+) {2,}\S", foamprb.__doc__ or "", re.MULTILINE)


def test_docstring_and_stub_name_the_same():
    assert sorted(foamprb.__all__) == sorted(documented()) == sorted(dir(foamprb))


def test_modules_list_their_own_names():
    """Completion of ``foamprb.analytic.`` offered Any, Callable, np and others."""
    modules = [value for name in foamprb.__all__ if inspect.ismodule(value := getattr(foamprb, name))]
    assert modules == [foamprb.analytic, foamprb.extend]
    for module in modules:
        assert dir(module) == sorted(module.__all__)
    # The names of the other module come from several.
    own = foamprb.analytic
    assert [name for name in dir(own) if getattr(own, name).__module__ != own.__name__] == []


def test_public_names_have_docstrings_and_belong_to_the_package():
    found = {name: getattr(foamprb, name) for name in foamprb.__all__}
    assert [name for name, value in found.items() if not value.__doc__] == []
    homes = {name: getattr(value, "__module__", value.__name__) for name, value in found.items()}
    assert [name for name, home in homes.items() if not home.startswith("foamprb.")] == []


def test_reference_has_every_public_name_once():
    pages = "".join(page.read_text() for page in REFERENCE)
    found = re.findall(r"^\.\. auto\w+:: foamprb\.(\w+)$", pages, re.MULTILINE)
    assert sorted(found) == sorted(foamprb.__all__)


def test_examples_of_docstrings_run():
    values = [getattr(foamprb, name) for name in foamprb.__all__]
    modules = {value.__module__ for value in values if hasattr(value, "__module__")} | {
        "foamprb.flow.analytic"
    }
    found = [doctest.testmod(importlib.import_module(module)) for module in sorted(modules)]
    assert sum(result.attempted for result in found) >= 7
    assert sum(result.failed for result in found) == 0


def test_other_names_are_refused():
    with pytest.raises(AttributeError, match="Clowd"):
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
        # In sentences as well; words with a slash, or such an end, are files.
        found |= set(re.findall(r"\bfoamprb(?:\.\w+)+", re.sub(r"\S*/\S*|\S+\.(sif|gz)\b", "", text)))
        names |= {(page.name, name) for name in found}
    for script in SCRIPTS:
        names |= {(script.name, name) for name in used(ast.parse(script.read_text()))}
    assert not {(file, name) for file, name in names if not is_public(name)}
