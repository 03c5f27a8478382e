"""A cloud's dictionary that is small and sound, and a reader of it with some of its text replaced."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest

from foamprb.errors import InputError
from foamprb.settings.settings import Settings, read_settings

CLOUD = """
FoamFile { version 2.0; format ascii; class dictionary; object softCloudProperties; }
solution
{
    deltaT          2e-05;
    endTime         0.4;
}
constantProperties
{
    rho0            2560;
    rhoInf          1.208;
    solid { type neoHooke; poissonsRatio 0.4; shearModulus 1000; }
}
subModels
{
    particleForces { ellipsoidDrag; }
    injectionModels
    {
        inlet
        {
            type patchInjection; patch inlet; parcelsPerSecond 1000; duration 0.1;
            sizeDistribution { type fixedValue; fixedValueDistribution { value 5e-6; } }
        }
    }
    patchInteractionModel localInteraction;
    localInteractionCoeffs
    {
        patches ( wall { type stick; } "(inlet|outlet)" { type escape; } );
    }
}
"""

Reader = Callable[..., Settings]


@pytest.fixture
def case(tmp_path: Path) -> Path:
    (tmp_path / "constant").mkdir()
    (tmp_path / "constant/transportProperties").write_text("transportModel Newtonian; nu 1.5e-5;")
    (tmp_path / "constant/g").write_text("dimensions [0 1 -2 0 0 0 0]; value (0 -9.81 0);")
    (tmp_path / "constant/positions").write_text("((0 0 0))")
    return tmp_path


@pytest.fixture
def notes(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What is logged from now on, whatever an earlier run of the command line has done to the log."""
    found: list[str] = []

    class Handler(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            found.append(record.getMessage())

    log = logging.getLogger("foamprb")
    monkeypatch.setattr(log, "handlers", [Handler()])
    monkeypatch.setattr(log, "level", logging.INFO)
    log.manager._clear_cache()
    return found


@pytest.fixture
def read(case: Path) -> Reader:
    """Read the dictionary above with some of its text replaced."""

    def read(*changes: tuple[str, str]) -> Settings:
        text = CLOUD
        for old, new in changes:
            assert text.count(old) == 1, old
            text = text.replace(old, new)
        (case / "constant/softCloudProperties").write_text(text)
        return read_settings(case)

    return read


def unexpected(read: Reader, mistakes: Iterable[tuple[str, str, str]]) -> list[tuple[str, str]]:
    """Return the mistakes, each an old text, a new one and a message, whose message is not the only one.

    Each comes with the message that there was, empty if there was none.
    """
    found = []
    for old, new, message in mistakes:
        text = ""
        try:
            read((old, new))
        except InputError as error:
            text = str(error)
        if message not in text or "\n" in text or not text.startswith("constant/softCloudProperties, line "):
            found.append((new or old, text))
    return found
