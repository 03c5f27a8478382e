"""Which of a plain and a compressed file is read."""

from __future__ import annotations

import gzip
import tracemalloc

import numpy as np
import pytest

from foamprb.dictionary import files
from foamprb.dictionary.dimensions import described, read_dimensions
from foamprb.dictionary.files import existing, read_bytes
from foamprb.dictionary.grammar import read_dictionary
from foamprb.errors import InputError


def compress(path, text):
    with gzip.open(f"{path}.gz", "wt") as file:
        file.write(text)


def test_a_dictionary_may_be_compressed_but_the_plain_one_counts(tmp_path):
    path = tmp_path / "transportProperties"
    compress(path, "nu 1e-6;")
    assert read_dictionary(path, tmp_path).entries["nu"].text == "1e-6"
    path.write_text("nu 2e-6;")
    assert read_dictionary(path, tmp_path).entries["nu"].text == "2e-6"
    assert existing(path) == path


def test_an_included_file_may_be_compressed(tmp_path):
    compress(tmp_path / "more", "b 2;")
    (tmp_path / "dict").write_text('#include "more"\nc $b;')
    assert read_dictionary(tmp_path / "dict", tmp_path).entries["c"].text == "2"


def test_files_of_openfoams_etc(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.setenv("WM_PROJECT_DIR", str(tmp_path / "openfoam"))
    monkeypatch.delenv("WM_PROJECT_SITE", raising=False)
    (tmp_path / "openfoam/etc/caseDicts").mkdir(parents=True)
    (tmp_path / "openfoam/etc/caseDicts/set").write_text("a 1;")
    (tmp_path / "dict").write_text('#includeEtc "caseDicts/set"')
    assert read_dictionary(tmp_path / "dict", tmp_path).entries["a"].text == "1"
    (tmp_path / "home/.OpenFOAM/caseDicts").mkdir(parents=True)
    (tmp_path / "home/.OpenFOAM/caseDicts/set").write_text("a 2;")
    assert read_dictionary(tmp_path / "dict", tmp_path).entries["a"].text == "2"
    (tmp_path / "dict").write_text('#includeEtc "caseDicts/none"')
    with pytest.raises(InputError, match=r"dict, line 1: .*none.+ is in none of the folders .*DIR"):
        read_dictionary(tmp_path / "dict", tmp_path)


def test_a_file_that_cannot_be_read_is_named(tmp_path):
    (tmp_path / "broken.gz").write_bytes(b"no gzip")
    with pytest.raises(InputError, match=r"broken\.gz: cannot be read"):
        read_bytes(tmp_path / "broken.gz")
    assert existing(tmp_path / "none") is None


def test_a_file_that_unpacks_to_many_times_its_size_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(files, "MOST_UNPACKED", 1000)
    path = tmp_path / "U.gz"
    path.write_bytes(gzip.compress(b" " * 100_000))
    with pytest.raises(InputError, match=r"U.gz: holds more than 200 times its size, .* after gunzip U.gz"):
        read_bytes(path)
    assert len(read_bytes(path, 500)) == 500


def test_a_compressed_file_takes_memory_for_what_it_holds(tmp_path):
    text = np.random.default_rng(1).bytes(3_000_000)
    (tmp_path / "U.gz").write_bytes(gzip.compress(text, 1))
    tracemalloc.start()
    try:
        assert read_bytes(tmp_path / "U.gz") == text
        assert tracemalloc.get_traced_memory()[1] < 3 * len(text)
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("[0 1 -1 0 0 0 0]", "[0 1 -1 0 0 0 0], those of a velocity"),
        ("[0 1 -1 0 0]", "[0 1 -1 0 0 0 0], those of a velocity"),
        ("[m/s]", "[0 1 -1 0 0 0 0], those of a velocity"),
        ("[ kg m^-1 s^-1 ]", "[1 -1 -1 0 0 0 0], those of a dynamic viscosity"),
        ("[Pa s]", "[1 -1 -1 0 0 0 0], those of a dynamic viscosity"),
        ("[0 0.5 0 0 0 0 0]", "[0 0.5 0 0 0 0 0]"),
        ("[acceleration]", "[0 1 -2 0 0 0 0], those of an acceleration"),
        ("[velocity/length]", "[0 0 -1 0 0 0 0], those of a rate, such as a velocity's gradient"),
        ("[]", "[0 0 0 0 0 0 0], those of a number without unit"),
    ],
)
def test_dimensions(text, expected):
    assert described(read_dimensions(text)) == expected


@pytest.mark.parametrize(
    "text", ["", "0", "[0 1 -1]", "[m s-1]", "[furlong]", "[0 1 -1 0 0 0 0", "[0 1 a 0 0]"]
)
def test_what_is_no_dimensions(text):
    assert read_dimensions(text) is None


def test_a_link_that_leads_to_itself_has_a_message(tmp_path):
    (tmp_path / "g").symlink_to("g")
    with pytest.raises(InputError, match=r"^g: "):
        read_dictionary(tmp_path / "g", tmp_path)
