"""The mutation run: what it changes, and that it tells what a test notices from what none does."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import sys

import pytest
from paths import ROOT

SOURCE = b'''"""Not 1 + 1 in a docstring."""

from __future__ import annotations

LIMIT: float = 0.5


def sum_of(a: int | str, b: float = 1) -> int | float:
    """Return 2 * a."""
    if a < b and not isinstance(a, bool):
        a -= 1
        log.info("below %d", 2)
    if a > 9:
        raise ValueError(f"{a + 1} is more than 9")
    store(a, b)
    for c, d in zip(a, b, strict=True):
        store(c, d)
    return min(a, LIMIT) * b
'''

CHANGES = [
    ("comparison", "    if a < b and", "    if (a > b) and"),
    ("arithmetic", "    return min(a, LIMIT) * b", "    return (min(a, LIMIT) / b)"),
    ("constant", "LIMIT: float = 0.5", "LIMIT: float = 1.0"),
    ("constant", "b: float = 1)", "b: float = 2)"),
    ("constant", "        a -= 1", "        a -= 2"),
    ("logic", "a < b and not isinstance(a, bool)", "(a < b or not isinstance(a, bool))"),
    ("logic", "and not isinstance(a, bool)", "and isinstance(a, bool)"),
    ("logic", "return min(", "return max("),
    ("branch", '        a -= 1\n        log.info("below %d", 2)', "        pass"),
    ("statement", "        a -= 1", "        pass"),
    ("statement", "    store(a, b)", "    pass"),
    ("argument", "store(a, b)", "store(b, a)"),
    ("argument", "zip(a, b,", "zip(b, a,"),
    ("argument", "store(c, d)", "store(d, c)"),
    ("statement", "        store(c, d)", "        pass"),
]

BODY = """
LIMIT = 10


def scaled(x, by):
    if x > LIMIT:
        return LIMIT
    return x * by
"""
TEST = """
import time

from foamprb.body.shape import scaled


def test_scaled():
    assert scaled(3, 2) == 6


def test_quick():
    assert True
"""


@pytest.fixture(scope="module")
def tool():
    loader = importlib.machinery.SourceFileLoader("mutate", str(ROOT / "tools/hardening/mutate"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("mutate", loader))
    sys.modules["mutate"] = module
    loader.exec_module(module)
    yield module
    del sys.modules["mutate"]


def test_each_kind_is_made_and_nothing_else(tool):
    """No messages, annotations or docstrings, nothing that only refuses, and no other order of min."""
    made = {(m.kind, m.of(SOURCE).decode()) for m in tool.mutations("file", SOURCE)}
    text = SOURCE.decode()
    for kind, old, new in CHANGES:
        assert text.count(old) == 1
        assert (kind, text.replace(old, new)) in made, (kind, new)
    others = {("comparison", "a > 9", "(a < 9)"), ("constant", "a > 9", "a > 10")}
    others |= {("argument", "isinstance(a, bool)", "isinstance(bool, a)")}
    assert made == {(kind, text.replace(old, new)) for kind, old, new in {*CHANGES, *others}}


def test_what_changes_nothing_is_not_made(tool):
    """Guards against a division by zero, and the order of the vectors of an inner product."""
    source = b"length = max(_inner(a, b), 1e-300)\n"
    assert [m.kind for m in tool.mutations("file", source)] == ["logic"]


def test_bytes_before_a_change_may_be_of_any_letters(tool):
    source = "angle = 'µm θ', 1.5\n".encode()
    (mutation,) = tool.mutations("file", source)
    assert mutation.of(source).decode() == "angle = 'µm θ', 3.0\n"


def test_a_seed_gives_the_same_again_and_more_of_them(tool):
    few, more = (tool.choose(ROOT, tool.WINGS, n, 7, "body/") for n in (5, 9))
    assert few == more[:5]
    assert len(set(more)) == 9
    assert few != tool.choose(ROOT, tool.WINGS, 5, 8, "body/")
    for mutation in more:
        assert mutation.changes((ROOT / mutation.file).read_bytes())


@pytest.fixture
def tree(tmp_path):
    root = tmp_path / "tree"
    for name, text in (
        ("foamprb/__init__.py", ""),
        ("foamprb/body/__init__.py", ""),
        ("foamprb/body/shape.py", BODY),
        ("tests/body/test_shape.py", TEST),
        ("pyproject.toml", "[tool.pytest.ini_options]\n"),
    ):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    return root


def test_survivors_are_what_no_test_notices(tool, tree, tmp_path):
    chosen = tool.choose(tree, ("body",), 100, 1, "")
    said = []
    results = tool.run(tree, tmp_path / "out", chosen, said.append, jobs=2, extra=60.0)
    noticed = {r.difference.splitlines()[-2]: r for r in results if r.outcome == "caught"}
    survived = {line for r in results if r.outcome == "survived" for line in r.difference.splitlines()}
    # Nothing asks what becomes of more than the limit.
    assert "+LIMIT = 11" in survived
    assert "+        pass" in survived
    assert "+    if (x < LIMIT):" not in survived
    assert any("x / by" in r.difference for r in results if r.outcome == "caught")
    assert {r.test for r in noticed.values()} == {"tests/body/test_shape.py::test_scaled"}
    assert (tree / "foamprb/body/shape.py").read_text() == BODY
    # A second run finds all results there.
    again = tool.run(tree, tmp_path / "out", chosen, pytest.fail)
    assert again == results
    table = tool.table(results)
    n = len(results)
    assert f"| `body/` | {n} | {n - 2} | 0 | 2 | 0 | {1 - 2 / n:.0%} |" in table
    # Interrupted before the tests that are further off were asked, it asks those, and nothing else.
    record = tmp_path / "out/results.jsonl"
    lines = [line.replace('"survived"', '"unjudged"') for line in record.read_text().splitlines()]
    record.write_text("\n".join(lines) + "\n")
    said.clear()
    third = tool.run(tree, tmp_path / "out", chosen, said.append)
    assert [r.outcome for r in third] == [r.outcome for r in results]
    assert len([line for line in said if line.startswith(("survived", "caught"))]) == 2


def test_the_nearest_tests_are_those_that_import_a_file_by_the_fewest_steps(tool, tmp_path):
    for name, text in (
        ("foamprb/body/shape.py", ""),
        ("foamprb/body/__init__.py", "from foamprb.body.shape import area\n"),
        ("foamprb/body/other.py", "import foamprb.body.shape\n"),
        ("tests/shapes.py", "from foamprb.body.shape import area\n"),
        ("tests/body/test_a.py", "from foamprb.body.other import what\nfrom shapes import ball\n"),
        ("tests/body/test_b.py", "from foamprb.body import shape\n"),
        ("tests/body/test_c.py", "import math\n"),
        ("tests/body/test_shape.py", "import math\n"),
        ("tests/cloud/test_shape.py", "from foamprb.body import shape\n"),
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    near = tool.nearest(tool.imports(tmp_path), "foamprb/body/shape.py")
    assert near == [f"tests/body/test_{name}.py" for name in ("shape", "b", "a", "c")]


def test_only_tests_that_reach_what_is_changed_are_asked(tool, tree, tmp_path):
    """By a call, by compiling it, or in a process of their own."""
    (tree / "foamprb/body/other.py").write_text(
        "def _link(function):\n    return 1\n\n\ndef called(x):\n    return 3 * x\n\n\n"
        "def compiled(x):\n    return 4 * x\n\n\ndef elsewhere(x):\n    return 5 * x\n\n\n"
        "def never(x):\n    return 6 * x\n"
    )
    (tree / "tests/body/test_shape.py").write_text("def test_nothing():\n    pass\n")
    for name, line in (
        ("called", "assert called(1)"),
        ("compiled", "assert _link(compiled)"),
        ("elsewhere", "subprocess.run([sys.executable, '-c', PROGRAM], check=True)"),
    ):
        (tree / f"tests/body/test_{name}.py").write_text(
            "import subprocess\nimport sys\n\nfrom foamprb.body.other import _link, called, compiled\n\n"
            "PROGRAM = 'from foamprb.body.other import elsewhere; elsewhere(1)'\n\n\n"
            f"def test_{name}():\n    {line}\n"
        )
    source = (tree / "foamprb/body/other.py").read_bytes()
    tests = tool.nearest(tool.imports(tree), "foamprb/body/other.py")
    lane = tool.Lane(tree, tmp_path / "lane")
    trials = tool.Trials(lane, tmp_path / "trials.json")
    reaching = {}
    for mutation in tool.mutations("foamprb/body/other.py", source):
        where = tool.place(mutation, source)
        name = source.decode().splitlines()[int(where.partition(":")[2]) - 1][4:].partition("(")[0]
        reaching[name] = list(trials.that_reach(tests, where))
    assert reaching.pop("_link") == ["tests/body/test_compiled.py"]
    assert reaching.pop("never") == []
    assert reaching == {name: [f"tests/body/test_{name}.py"] for name in ("called", "compiled", "elsewhere")}
    # The second time they are not tried again.
    (lane.tree / "tests/body/test_called.py").unlink()
    again = tool.Trials(lane, tmp_path / "trials.json")
    assert again.of("tests/body/test_called.py") == trials.of("tests/body/test_called.py")


def test_a_change_belongs_to_the_innermost_function_that_runs_it(tool):
    """A default belongs to what stands around the function, and a decorator's line is its first."""
    source = b"A = 1\n\n@cache\ndef f(x=2):\n    g = lambda y=3: y + 4\n    class B:\n        c = 5\n"
    where = {m.text: tool.place(m, source) for m in tool.mutations("f.py", source) if m.kind == "constant"}
    assert where == {"2": "f.py", "3": "f.py", "4": "f.py:3", "5": "f.py:5", "6": "f.py:3"}


def test_interval_of_a_score(tool):
    """Wilson (1927): by numbers that fulfil (p − k/n)² = z² p (1 − p)/n at both ends."""
    for noticed, n in ((14, 16), (0, 5), (300, 300), (270, 300)):
        for p in tool.interval(noticed, n):
            assert (p - noticed / n) ** 2 == pytest.approx(1.959963984540054**2 * p * (1.0 - p) / n, abs=1e-9)
    low, high = tool.interval(270, 300)
    assert low < 0.9 < high


def test_tests_that_do_not_end_are_out_of_time(tool, tree, tmp_path):
    (tree / "foamprb/body/shape.py").write_text(
        "def count(n):\n    while n > 0:\n        n -= 1\n    return n\n"
    )
    (tree / "tests/body/test_shape.py").write_text(
        "from foamprb.body.shape import count\n\n\ndef test_count():\n    assert count(3) == 0\n"
    )
    chosen = [m for m in tool.choose(tree, ("body",), 100, 1, "") if m.kind == "statement"]
    (result,) = tool.run(tree, tmp_path / "out", chosen, lambda _: None, extra=3.0)
    assert result.outcome == "time"


def test_a_table_is_put_between_its_marks(tool, tmp_path):
    page = tmp_path / "page.md"
    page.write_text(f"before\n{tool.BEGIN}\nold\n{tool.END}\nafter\n")
    tool.write(page, "new")
    assert page.read_text() == f"before\n{tool.BEGIN}\nnew\n{tool.END}\nafter\n"
    page.write_text("no marks")
    with pytest.raises(SystemExit):
        tool.write(page, "new")
