"""Steps and times of a run, of the cloud's dictionary and of system/controlDict."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest
from cloud_dictionary import Reader

from foamprb.cloud.limits import Limits
from foamprb.errors import InputError

OWN = "deltaT          2e-05;\n    endTime         0.4;"
CONTROL = "startTime 0; endTime 2; deltaT 0.25; writeControl runTime; writeInterval 0.5;"


def control(case: Path, text: str, scheme: str = "Euler") -> None:
    (case / "system").mkdir(exist_ok=True)
    (case / "system/controlDict").write_text(text)
    (case / "system/fvSchemes").write_text(f"ddtSchemes {{ default {scheme}; }}")


def times(read: Reader, own: str) -> tuple[float, float, float]:
    solution = read((OWN, own)).solution
    return solution.deltaT, solution.endTime, solution.writeInterval


@pytest.mark.parametrize(
    ("own", "text", "expected"),
    [
        ("", CONTROL, (0.25, 2.0, 0.5)),
        ("", CONTROL.replace("runTime", "adjustableRunTime"), (0.25, 2.0, 0.5)),
        ("", CONTROL.replace("runTime; writeInterval 0.5", "timeStep; writeInterval 4"), (0.25, 2.0, 1.0)),
        ("", "endTime 2; deltaT 0.25; writeInterval 4;", (0.25, 2.0, 1.0)),
        ("", CONTROL.replace("runTime", "cpuTime"), (0.25, 2.0, 2.0)),
        ("", "endTime 2; deltaT 0.25;", (0.25, 2.0, 2.0)),
        ("deltaT 0.125;", CONTROL, (0.125, 2.0, 0.5)),
        ("endTime 1; writeInterval 1;", CONTROL, (0.25, 1.0, 1.0)),
        # What the cloud says itself is not mixed with the flow's write interval.
        ("deltaT 0.1; endTime 1;", CONTROL, (0.1, 1.0, 1.0)),
    ],
)
def test_what_the_cloud_does_not_say_is_the_cases(
    case: Path, read: Reader, own: str, text: str, expected: tuple[float, float, float]
) -> None:
    control(case, text)
    assert times(read, own) == expected


def test_a_note_says_what_was_taken(case: Path, read: Reader, notes: list[str]) -> None:
    control(case, CONTROL)
    read((OWN, "endTime 1;"))
    assert notes == [
        "constant/softCloudProperties: solution/deltaT is 0.25 s, that of system/controlDict.",
        "constant/softCloudProperties: solution/writeInterval is 0.5 s, that of system/controlDict.",
    ]


@pytest.mark.parametrize("scheme", ["steadyState", "localEuler rDeltaT"])
def test_iterations_of_a_steady_solver_are_no_time(case: Path, read: Reader, scheme: str) -> None:
    control(case, "endTime 500; deltaT 1;", scheme)
    with pytest.raises(InputError) as caught:
        read((OWN, ""))
    assert str(caught.value).split("\n")[0] == "2 mistakes:"
    assert "line 3: solution/deltaT is missing. Allowed: a number > 0." in str(caught.value)
    assert "line 3: solution/endTime is missing. Allowed: a number > 0." in str(caught.value)


def test_a_control_dictionary_that_cannot_be_read_gives_nothing(
    case: Path, read: Reader, notes: list[str]
) -> None:
    control(case, "endTime 2; deltaT 0.25; #inputMode merge")
    with pytest.raises(InputError, match="solution/deltaT is missing"):
        read((OWN, ""))
    assert "system/controlDict, line 1: '#inputMode' is not supported" in notes[0]


def test_functions_of_the_solver_do_not_hide_the_times_of_a_control_dictionary(
    case: Path, read: Reader
) -> None:
    control(case, "endTime 2; deltaT 0.25; functions { #includeFunc streamlines(p, U) }")
    assert read((OWN, "")).solution.deltaT == 0.25


def test_a_write_interval_of_the_case_that_does_not_fit_names_its_file(case: Path, read: Reader) -> None:
    control(case, CONTROL)
    with pytest.raises(
        InputError,
        match=re.escape(
            "system/controlDict, line 1: writeInterval is 0.5. Allowed: a multiple of deltaT = 0.3"
        ),
    ):
        read((OWN, "deltaT 0.3;"))


@pytest.mark.parametrize(
    ("own", "message"),
    [
        ("deltaT 1e-20; endTime 0.4;", "endTime is 0.4, with deltaT = 1e-20 that is 4e+19 steps"),
        ("deltaT 1e-5; endTime 1e25;", "endTime is 1e+25, with deltaT = 1e-05 that is 1e+30 steps"),
        ("deltaT 1e-5; endTime 1e11;", "that is 1e+16 steps. Allowed: fewer than 9.01e+15."),
        ("deltaT 1e-5; endTime 1; writeInterval 1e25;", "writeInterval is 1e+25, with deltaT = 1e-05"),
    ],
)
def test_steps_that_cannot_be_counted_are_refused(read: Reader, own: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        read((OWN, own))
    assert str(caught.value).startswith("constant/softCloudProperties, line ")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_only_existing_arrays_can_be_written(read: Reader) -> None:
    assert read((OWN, OWN)).solution.writeFields == ()
    assert read((OWN, f"{OWN} writeFields (Ur J);")).solution.writeFields == ("Ur", "J")
    with pytest.raises(InputError, match=re.escape("writeFields is '(Uc nu)'. Allowed: J, Uc, Ur, active, ")):
        read((OWN, f"{OWN} writeFields (Uc nu);"))


def test_limits_of_particles_are_those_of_their_entries(read: Reader) -> None:
    limits = read((OWN, f"{OWN} maxStretch 5; maxSize 0.25; maxSubSteps 7; maxCells 2;")).solution.limits
    assert limits == Limits(maxStretch=5.0, maxSize=0.25, maxSubSteps=7.0, maxCells=2.0)
    assert read((OWN, OWN)).solution.limits == Limits()
    assert Limits().maxCells == math.inf
