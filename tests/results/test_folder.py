"""Folders of results, found by cloud and region, and the names of files in them."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from foamprb.errors import InputError
from foamprb.results.folder import ResultsFolder, fault_of_function, fault_of_word, file_name
from foamprb.results.pvd import Series, SnapshotFile


def written(case, *places):
    for place in places:
        *region, cloud = place.split("/")
        folder = ResultsFolder.of_case(case, cloud, *region)
        folder.path.mkdir(parents=True)
        Series(folder).relist([SnapshotFile(0.0, f"{cloud}_000000.vtp")])


@pytest.mark.parametrize(
    ("places", "options", "found"),
    [
        (["softCloud"], {}, "softCloud"),
        (["cells"], {}, "cells"),
        (["cells", "softCloud"], {}, "softCloud"),
        (["cells", "softCloud"], {"cloud": "cells"}, "cells"),
        (["air/softCloud"], {}, "air/softCloud"),
        (["air/softCloud"], {"region": "air"}, "air/softCloud"),
        (["air/cells"], {"cloud": "cells"}, "air/cells"),
        (["softCloud", "air/softCloud"], {}, "softCloud"),
        (["softCloud", "air/cells"], {"cloud": "cells"}, "air/cells"),
        (["softCloud", "air/softCloud"], {"region": "air"}, "air/softCloud"),
        (["air/softCloud", "water/softCloud"], {"region": "water"}, "water/softCloud"),
    ],
)
def test_results_are_found_by_cloud_and_region(tmp_path, places, options, found):
    written(tmp_path, *places)
    folder = ResultsFolder.find(tmp_path, **options)
    assert folder.path == tmp_path / "postProcessing" / found
    assert folder == ResultsFolder.of_case(tmp_path, folder.cloud, folder.region)


@pytest.mark.parametrize(
    ("places", "options", "message"),
    [
        ([], {}, "no results here"),
        (["a", "b"], {}, "results of 2 clouds: a, b. Choose one with -cloud"),
        (["air/a", "air/b"], {"region": "air"}, "air/a, air/b. Choose one with -cloud"),
        (["air/softCloud", "water/softCloud"], {}, "air/softCloud, water/softCloud. Choose one with -region"),
        (["softCloud"], {"cloud": "softClod"}, "no results of a cloud 'softClod'.*softCloud"),
        (["softCloud", "air/softCloud"], {"region": "aire"}, "no results of region 'aire'.*air"),
    ],
)
def test_missing_and_ambiguous_results_are_refused(tmp_path, places, options, message):
    written(tmp_path, *places)
    with pytest.raises(InputError, match=message):
        ResultsFolder.find(tmp_path, **options)


def test_a_folder_of_a_cloud_is_no_region(tmp_path):
    written(tmp_path, "softCloud")
    inner = tmp_path / "postProcessing/softCloud/series"
    inner.mkdir()
    (inner / "series.pvd").touch()
    assert ResultsFolder.find(tmp_path).cloud == "softCloud"


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
