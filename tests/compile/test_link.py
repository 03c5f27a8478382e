"""Formulas become machine code once, and the code is found again by whoever has the same formulas."""

import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from small_program import renamed

import foamprb
from foamprb.body.choice import choice
from foamprb.body.tensor import longest_stretch, principal_frame
from foamprb.compile import link as compiling
from foamprb.compile.link import link, separate
from foamprb.compile.processor import processor

FIRST, SECOND = 2, 3
LANES = 16


def has_registers_of_512_bits():
    return processor().register == 8


PROGRAM = """
import foamprb.flow
from foamprb.body.tensor import det
from foamprb.compile.link import is_compiled, link
f = link(det)
print(is_compiled(f), f((1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 3.0)), is_compiled(f))
"""


MODELS = """
import sys
import foamprb.flow
from foamprb.body.choice import choice
from foamprb.compile.link import link, separate

def doubled(x):
    return x + x

def halved(x):
    return 0.5 * x

@choice
def model(x):
    return x

@separate
def twice(x):
    return model(model(x))

def entry(x):
    return twice(x)

for name in sys.argv[1:]:
    print(link(entry, {model: globals()[name]})(1.0))
"""


def element(values, row):
    return values[row]


def sum_of_two(values):
    return element(values, FIRST) + element(values, SECOND)


@separate
def roots(values):
    for i in range(LANES):
        values[i] = math.sqrt(values[i])


def roots_of_both(values, others):
    roots(values)
    roots(others)


def doubled(x):
    return x + x


@separate
def doubled_apart(x):
    return x + x


@choice
def changed(x):
    return x


def changed_twice(x):
    return changed(changed(x))


def changed_thrice(x):
    return changed(changed_twice(x))


def multiplied(factor, function):
    def result(x):
        return factor * function(x)

    return result


def ratio(x, y):
    return x + y if x * y > 7 else x / y - y


@pytest.fixture
def cache(tmp_path, monkeypatch):
    """An empty cache, with nothing compiled in this process."""
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path / "cache"))
    monkeypatch.setattr(compiling, "_dispatchers", {})
    return tmp_path / "cache"


def run(source, cache):
    environment = {**os.environ, "PYTHONPATH": str(source), "FOAMPRB_CACHE_DIR": str(cache)}
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True, cwd=cache.parent
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def test_code_is_found_by_another_installation_of_the_same_source(tmp_path):
    package = Path(foamprb.__file__).parent
    copy = tmp_path / "elsewhere"
    shutil.copytree(package, copy / package.name, ignore=shutil.ignore_patterns("__pycache__"))
    assert run(package.parent, tmp_path / "cache") == ["False", "6.0", "True"]
    assert run(copy, tmp_path / "cache") == ["True", "6.0", "True"]


def test_constants_are_no_reason_to_compile_a_function_again(cache):
    assert link(sum_of_two)(np.arange(5.0)) == 5.0
    (code,) = [d for d in compiling._dispatchers.values() if d.py_func.__name__ == "element"]
    assert len(code.signatures) == 1


def test_a_function_that_may_not_be_replaced_is_an_error(cache):
    with pytest.raises(ValueError, match=r"test_link\.changed_twice is no slot and no choice"):
        link(changed_thrice, {changed_twice: doubled})


def test_functions_that_a_function_captures_are_a_part_of_it(cache):
    """Each composition is told apart, in this process and in the cache."""
    for _ in range(2):
        for function, factor in ((doubled, 2.0), (doubled_apart, 2.0), (multiplied(3.0, doubled), 6.0)):
            for one in (1.0, 5.0):
                assert link(multiplied(one, function))(1.5) == one * factor * 1.5


def test_called_functions_are_found_by_other_processes(cache, monkeypatch):
    assert link(changed_twice, {changed: doubled_apart})(1.25) == 5.0
    monkeypatch.setattr(compiling, "_dispatchers", {})
    assert link(changed_thrice, {changed: doubled_apart})(1.25) == 10.0
    (code,) = [d for d in compiling._dispatchers.values() if d.py_func.__name__ == "doubled_apart"]
    assert sum(code.stats.cache_hits.values()) == 1


def test_global_names_of_long_functions_are_read_without_their_attributes():
    names = [f"name_{k}" for k in range(300)]
    scope = {}
    exec(f"def f():\n    def g(): return inner.attribute\n    return {' + '.join(names)}, g", scope)
    assert compiling._global_names(scope["f"].__code__) == {*names, "inner"}


def test_functions_of_one_name_are_told_apart(tmp_path):
    """Numba numbers functions as they come, so that one of another process may have the same number."""
    (tmp_path / "models.py").write_text(MODELS)
    # What else is in the name depends on the order of a set.
    environment = {**os.environ, "FOAMPRB_CACHE_DIR": str(tmp_path / "cache"), "PYTHONHASHSEED": "0"}
    for names in (["doubled"], ["halved", "doubled"]):
        done = subprocess.run(
            [sys.executable, "models.py", *names],
            env=environment,
            capture_output=True,
            text=True,
            cwd=tmp_path,
        )
        assert done.returncode == 0, done.stderr
        factors = {"doubled": "4.0", "halved": "0.25"}
        assert done.stdout.split() == [factors[name] for name in names]


def test_results_of_operators_have_the_types_of_their_operands(cache):
    f = link(ratio)
    for x in (3, 3.25, np.float32(3.5), np.int8(3), True):
        for y in (2, 2.75, np.float32(2.5), np.int8(2)):
            assert f(x, y) == ratio(x, y)
            assert type(f(x, y)) is type(np.asarray(ratio(x, y)).item())


def scaled(x, factor=2.0):
    return factor * x


def scaled_by_default(x):
    return scaled(x)


def test_code_changes_with_the_defaults_of_what_it_calls(cache, monkeypatch):
    """They are no part of a function's byte code."""
    assert link(scaled_by_default)(1.5) == 3.0
    monkeypatch.setattr(scaled, "__defaults__", (3.0,))
    monkeypatch.setattr(compiling, "_dispatchers", {})
    assert link(scaled_by_default)(1.5) == 4.5


def first_and_second(x):
    pair = Pair(x, 2.0 * x)
    return pair.first - pair.second


class Pair(NamedTuple):
    first: float
    second: float


class Riap(NamedTuple):
    second: float
    first: float


def test_code_changes_with_the_fields_of_what_it_makes(cache, monkeypatch):
    assert link(first_and_second)(1.0) == -1.0
    monkeypatch.setitem(globals(), "Pair", Riap)
    monkeypatch.setattr(compiling, "_dispatchers", {})
    assert link(first_and_second)(1.0) == 1.0


@pytest.mark.skipif(not has_registers_of_512_bits(), reason="the processor has no registers of 512 bits")
def test_what_is_called_uses_the_widest_registers(cache):
    f = link(roots_of_both)
    values, others = np.arange(16.0), np.arange(16.0) ** 2
    f(values, others)
    np.testing.assert_array_equal(values, np.sqrt(np.arange(16.0)))
    (assembly,) = f.py_func.__globals__["roots"].inspect_asm().values()
    assert re.search(r"vsqrtpd[^\n]*%zmm", assembly)


def test_what_else_a_function_carries_does_not_change_its_code(cache, monkeypatch):
    """A wrapper's ``__wrapped__`` has another address in every process."""
    keys = []
    for mark in (object(), object()):
        monkeypatch.setattr(compiling, "_dispatchers", {})
        monkeypatch.setattr(doubled, "mark", mark, raising=False)
        link(doubled)
        keys += compiling._dispatchers
    assert keys[0] == keys[1]


def test_bound_of_the_stretches():
    """No stretch is longer, and of spheres and prolate spheroids the longest is it."""
    random = np.random.default_rng(0)
    F = np.eye(3) + 0.4 * random.standard_normal((200, 3, 3))
    F = F[np.linalg.det(F) > 0.1]
    longest = np.max(principal_frame(tuple(F.reshape(-1, 9).T))[1], axis=0)
    bound = longest_stretch(tuple(F.reshape(-1, 9).T))
    assert (bound >= longest * (1.0 - 1e-12)).all()
    assert (bound <= longest * np.sqrt(2.0)).all()
    turn, _ = np.linalg.qr(random.standard_normal((3, 3)))
    prolate = turn @ np.diag([2.5, 0.7, 0.7])
    assert longest_stretch(tuple(prolate.ravel())) == pytest.approx(2.5, rel=1e-12)
    assert longest_stretch(tuple(1.5 * turn.ravel())) == pytest.approx(1.5, rel=1e-7)


class Places(NamedTuple):
    low: int
    high: int


places = Places(2, 3)


def difference(values):
    return element(values, places.high) - element(values, places.low)


def test_named_numbers_are_constants_of_the_code_that_reads_them(cache):
    """Other numbers are other code; a function that is given one is compiled once for all."""
    values = np.array([1.0, 2.0, 4.0, 8.0])
    assert link(difference)(values) == 4.0
    assert link(renamed(difference, places=Places(0, 3)))(values) == 7.0
    (code,) = [d for d in compiling._dispatchers.values() if d.py_func.__name__ == "element"]
    assert len(code.signatures) == 1


def called_late(x):
    return 3.0 * x


def never_calls(x):
    k = 3
    if k - 3 > 0:
        return called_late(x)
    return x


def always_calls(x):
    return called_late(x) + 1.0


def both_of_them(x):
    return never_calls(x) + always_calls(x)


def test_function_whose_first_caller_needs_it_no_more_is_there_for_the_next(cache):
    """The linker leaves out what nothing refers to yet."""
    assert link(both_of_them)(2.0) == 9.0
