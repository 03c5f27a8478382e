"""Which times a value or a selection means, and what is said of one that is not there."""

from __future__ import annotations

from pathlib import Path

import pytest

from foamprb.errors import InputError
from foamprb.flow.read.times import choose_times, listed, pick_time

NAMES = ("0", "0.1", "0.25", "1", "1e1", "100")
CASE = Path("case")


@pytest.mark.parametrize(
    ("time", "position"),
    [("latestTime", 5), ("0.25", 2), (0.25, 2), ("10", 4), (10, 4), ("1e1", 4), ("2.5e-1", 2), (0, 0),
     (1.0 + 5e-10, 3), (100 * (1 - 9e-10), 5)],
)  # fmt: skip
def test_a_time_is_the_name_or_the_number(time, position):
    """To a billionth of it: names of times are rounded."""
    assert pick_time(CASE, NAMES, time) == position


@pytest.mark.parametrize(
    ("time", "message"),
    [
        (0.3, r"^case: no time 0\.3; the times are 0, 0\.1, 0\.25, 1, 1e1, 100\.$"),
        (1.0 + 2e-9, "no time"),
        (1e-12, "no time"),
        ("now", r"^case: time 'now' is neither a number nor latestTime; the times are 0, "),
    ],
)
def test_a_time_that_is_not_there_is_named_with_those_that_are(time, message):
    with pytest.raises(InputError, match=message):
        pick_time(CASE, NAMES, time)


def test_two_names_of_a_time_are_told_apart_by_the_letter():
    names = ("1", "1.0", "2")
    assert pick_time(CASE, names, "1") == 0
    assert pick_time(CASE, names, "1.0") == 1
    with pytest.raises(
        InputError, match=r"1 and 1\.0 are the same time\. Remove one, or say which: -time 1 or"
    ):
        pick_time(CASE, names, 1)
    for selection in (None, "0.5:1.5", "1,1.0"):
        with pytest.raises(InputError, match=r"^case: 1 and 1\.0 are the same time; remove one\.$"):
            choose_times(CASE, names, selection)
    assert choose_times(CASE, names, "1.0,2") == ("1.0", "2")


@pytest.mark.parametrize(
    ("selection", "chosen"),
    [
        (None, NAMES),
        ("0.1:1", NAMES[1:4]),
        (":0.25", NAMES[:3]),
        ("1:", NAMES[3:]),
        (":", NAMES),
        ("1,0.1", ("0.1", "1")),
        ("100 0:0.1", ("0", "0.1", "100")),
        ("latestTime", ("100",)),
        (" 0.25 , latestTime ", ("0.25", "100")),
        # Names are rounded: ends count to a billionth.
        ("0.10000000005:0.24999999995", ("0.1", "0.25")),
        ("1:1", ("1",)),
    ],
)
def test_selections_of_times(selection, chosen):
    assert choose_times(CASE, NAMES, selection) == chosen


@pytest.mark.parametrize(
    ("selection", "message"),
    [
        ("2:3", r"^case: no time in 2:3; the times go from 0 to 100\.$"),
        ("0.1001:0.2499", "no time in"),
        ("a:b", r"'a:b' is no range of times, such as 0\.1:0\.5, 0\.1: or :0\.5\."),
        ("nan:1", "is no range of times"),
        ("0.1:0.2:0.3", "is neither a number nor latestTime"),
        ("7", "no time 7"),
    ],
)
def test_selections_of_nothing(selection, message):
    with pytest.raises(InputError, match=message):
        choose_times(CASE, NAMES, selection)


def test_many_names_are_listed_without_the_middle():
    assert listed([]) == "(none)"
    assert listed(map(str, range(12))) == ", ".join(map(str, range(12)))
    assert listed(map(str, range(13))) == "0, 1, 2, 3, 4, …, 8, 9, 10, 11, 12"
