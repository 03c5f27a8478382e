"""The folders of results: found by cloud and region, by those who read what a run has written."""

from __future__ import annotations

import pytest

from foamprb.errors import InputError
from foamprb.results.folder import ResultsFolder
from foamprb.results.pvd import Entry, Series


def written(case, *places):
    for place in places:
        *region, cloud = place.split("/")
        Series(ResultsFolder.of_case(case, cloud, *region)).relist([Entry(0.0, f"{cloud}_000000.vtp")])


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
