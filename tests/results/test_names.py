"""Names that become names of files."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from foamprb.results.folder import fault_of_function, fault_of_word, file_name

WORDS = ["inlet", "out.let", "wall_1", "a:b", "(in|out)", "größe", "-x", "50%", "x" * 200]
OTHERS = ["", ".", "..", ".hidden", "a/b", "../../pwn", "/etc/passwd", "a b", "a\tb", "a\nb", "a;b", "{a}",
          'a"b', "a'b", "a\\b", "a\0b", "a\x07b", "x" * 201, "é" * 101, "\udcff"]  # fmt: skip


def test_words_may_be_names():
    assert not [name for name in WORDS if fault_of_word(name) or fault_of_function(name, "cloud")]


def test_others_may_not():
    assert not [name for name in OTHERS if not (fault_of_word(name) and fault_of_function(name, "cloud"))]


def test_names_of_files_of_the_results_are_taken():
    taken = [
        "checkpoint",
        "fates.csv",
        "failed.csv",
        "manifest",
        "cloud.pvd",
        "cloud_000000.vtp",
        "cloud_1234567",
    ]
    assert not [name for name in taken if fault_of_word(name)]
    faults = {fault_of_function(name, "cloud") for name in taken}
    assert faults == {"the results have a file of that name"}


def test_names_of_another_cloud_are_free():
    assert fault_of_function("other_000000.vtp", "cloud") == fault_of_function("cloud_00000", "cloud") == ""


@given(st.text() | st.text(st.sampled_from("./% a")) | st.sampled_from(OTHERS))
def test_any_name_becomes_a_file_in_its_folder(name):
    escaped = file_name(name) + ".csv"
    assert "/" not in escaped
    assert "\0" not in escaped
    assert escaped not in (".", "..")
    assert len(escaped.encode()) < 250
    escaped.encode()
    if not fault_of_word(name) and "%" not in name:
        assert file_name(name) == name


@given(st.text(st.sampled_from("./% aé2F\n")), st.text(st.sampled_from("./% aé2F\n")))
def test_different_names_stay_different(one, other):
    assert (file_name(one) == file_name(other)) == (one == other)


def test_long_names_stay_different():
    names = ["/" * 100 + end for end in "abc"]
    assert len({file_name(name) for name in names}) == 3
