"""Dictionaries that would take all memory, all time or all of the stack end in one message each."""

from __future__ import annotations

import gzip
import os
import resource
from pathlib import Path

import pytest

from foamprb.dictionary.grammar import MOST_BYTES, MOST_FILES, read_dictionary, read_dictionary_list
from foamprb.dictionary.tree import Dictionary
from foamprb.errors import InputError


def read(folder: Path, text: str) -> Dictionary:
    (folder / "dictionary").write_text(text)
    return read_dictionary(folder / "dictionary", folder)


def refusal(folder: Path, text: str) -> str:
    with pytest.raises(InputError) as caught:
        read(folder, text)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_nested_dictionaries(tmp_path: Path) -> None:
    deepest = "a " + "{ a " * 99 + "{ b 1; }" + " }" * 99
    assert read(tmp_path, deepest).entries
    text = refusal(tmp_path, "a\n{\n" * 3000 + "b 1;" + "}" * 3000)
    assert text == "dictionary, line 201: 'a' is nested too deeply: more than 100 dictionaries."
    assert "nested too deeply" in refusal(tmp_path, "a ( b { " * 3000 + "} );" * 3000)


def test_dictionaries_that_macros_nest(tmp_path: Path) -> None:
    lines = ["a0 { b 1; }", *(f"a{i + 1} {{ inner $a{i}; }}" for i in range(3000))]
    assert "line 101: '$a99' is nested too deeply" in refusal(tmp_path, "\n".join(lines))
    # Merged into one another they stay flat.
    lines = ["a0 { b0 1; }", *(f"a{i + 1} {{ $a{i}; b{i + 1} 1; }}" for i in range(300))]
    assert len(read(tmp_path, "\n".join(lines)).entries["a300"].dictionary().entries) == 301


@pytest.mark.parametrize(
    ("first", "line"),
    [
        ("a0 1;", "a{1} $a{0} $a{0};"),
        ("a0 { b 1; c 2; }", "a{1} {{ x $a{0}; y $a{0}; }}"),
        ("a0 { b 1; c 2; }", "a{1} ( x {{ p $a{0}; }} y {{ q $a{0}; }} );"),
    ],
)
def test_macros_that_double(tmp_path: Path, first: str, line: str) -> None:
    """2^60 words from 60 lines."""
    text = refusal(tmp_path, "\n".join([first, *(line.format(i, i + 1) for i in range(60))]))
    assert "expands too far: all macros together to more than 200000 words." in text


def test_an_entry_that_names_itself_has_an_end(tmp_path: Path) -> None:
    assert "'$a' is not defined above" in refusal(tmp_path, "a $a;")
    assert "'$a' is not defined above" in refusal(tmp_path, "a { $a; }")
    root = read(tmp_path, "a 1; a $a $a; a $a $a;")
    assert root.entries["a"].text == "1 1 1 1"


@pytest.mark.parametrize("name", ["/dev/zero", "/dev/urandom", "pipe", "folder"])
def test_what_is_no_file_is_not_included(tmp_path: Path, name: str) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "folder").mkdir()
    assert refusal(tmp_path, f'#include "{name}"').endswith("cannot be included: is not a file.")
    assert read(tmp_path, f'#includeIfPresent "{name}" a 1;').entries.keys() == {"a"}
    with pytest.raises(InputError, match=r"pipe: is not a file \(case"):
        read_dictionary(tmp_path / "pipe", tmp_path)


def test_names_that_no_file_can_have(tmp_path: Path) -> None:
    assert "cannot be included" in refusal(tmp_path, '#include "a\0b"')
    assert "cannot be included" in refusal(tmp_path, f'#include "{"x" * 5000}"')
    assert read(tmp_path, '#includeIfPresent "a\0b" a 1;').entries.keys() == {"a"}
    assert read(tmp_path, f'#includeIfPresent "{"x" * 5000}" a 1;').entries.keys() == {"a"}


def test_includes_that_double(tmp_path: Path) -> None:
    for i in range(60):
        (tmp_path / f"f{i}").write_text(f'#include "f{i + 1}"\n#include "f{i + 1}"\n')
    (tmp_path / "f60").write_text("a 1;")
    assert f"exceeds the limit of {MOST_FILES} included files." in refusal(tmp_path, '#include "f0"')


def test_includes_in_a_long_row(tmp_path: Path) -> None:
    for i in range(300):
        (tmp_path / f"f{i}").write_text(f'#include "f{i + 1}"')
    (tmp_path / "f300").write_text("a 1;")
    assert "is included too deeply: more than 100 levels." in refusal(tmp_path, '#include "f0"')


def test_includes_in_a_circle(tmp_path: Path) -> None:
    (tmp_path / "f0").write_text('#include "f1"')
    (tmp_path / "f1").write_text('#include "f0"')
    assert refusal(tmp_path, '#include "f0"') == "f1, line 1: '\"f0\"' includes itself."
    (tmp_path / "link").symlink_to(tmp_path / "dictionary")
    assert refusal(tmp_path, '#include "link"') == "dictionary, line 1: '\"link\"' includes itself."


@pytest.mark.parametrize("kind", ["plain", "link"])
def test_a_file_from_outside_that_is_no_dictionary_is_not_shown(tmp_path: Path, kind: str) -> None:
    """A case may come from anywhere, and its log go anywhere."""
    (tmp_path / "secrets").write_text("first\nuser:key:1234\n{")
    case = tmp_path / "case"
    case.mkdir()
    (case / "link").symlink_to(tmp_path / "secrets")
    (case / "dictionary").write_text(
        f'#include "{tmp_path}/secrets"' if kind == "plain" else '#include "link"'
    )
    with pytest.raises(InputError) as caught:
        read_dictionary(case / "dictionary", case)
    file = tmp_path / "secrets" if kind == "plain" else case / "link"
    assert str(caught.value) == f"{file}, line 1: the included file is not a dictionary."
    # What lies in the case, or was named by the user, is shown.
    (case / "own").write_text("first\nuser:key:1234\n{")
    (case / "dictionary").write_text('#include "own"')
    with pytest.raises(InputError, match="own, line 1: 'first' has no closing"):
        read_dictionary(case / "dictionary", case)
    with pytest.raises(InputError, match="line 1: 'first' has no closing"):
        read_dictionary(tmp_path / "secrets", case)


@pytest.fixture
def little_memory():
    """Half a gigabyte beyond what is in use."""
    used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (used + (512 << 20), hard))
    yield
    resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def test_a_compressed_file_of_a_gigabyte(tmp_path: Path, little_memory: None) -> None:
    block = gzip.compress(b"\n" * (1 << 24), 1)
    (tmp_path / "boundary.gz").write_bytes(block * 64)
    for reader in (read_dictionary, read_dictionary_list):
        with pytest.raises(InputError, match=r"boundary.gz: has more than 8 MiB, too large for a dictionary"):
            reader(tmp_path / "boundary.gz", tmp_path)
    assert "'\"boundary.gz\"' cannot be included: has more than 8 MiB" in refusal(
        tmp_path, '#include "boundary.gz"'
    )


def test_includes_share_the_limit_of_size(tmp_path: Path) -> None:
    (tmp_path / "part").write_text("// " + "x" * (MOST_BYTES // 3) + "\na 1;\n")
    assert read(tmp_path, '#include "part"\n' * 2).entries.keys() == {"a"}
    assert "line 3: '\"part\"' cannot be included: has more than 8 MiB" in refusal(
        tmp_path, '#include "part"\n' * 3
    )


def test_a_number_of_entries_with_many_digits(tmp_path: Path) -> None:
    (tmp_path / "boundary").write_text("9" * 5000 + " ( a { b 1; } )")
    with pytest.raises(InputError, match="stands where a number and a list"):
        read_dictionary_list(tmp_path / "boundary", tmp_path)
