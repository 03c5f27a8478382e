"""Each file and each entry of a case, changed once: the run is refused, or the change acts on nothing."""

from __future__ import annotations

import gzip
import json
import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import fields
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

import pytest
from paths import PIPE
from pipe_case import copy_of_pipe

from foamprb import prepare
from foamprb.body.material import MATERIALS
from foamprb.dictionary.constraints import NoEffect, Only
from foamprb.dictionary.grammar import parse_dictionary
from foamprb.dictionary.schema import hints_of, rule_of
from foamprb.dictionary.tree import Dictionary, DictionaryList, Entry, Stream
from foamprb.errors import InputError
from foamprb.run.restart import fingerprint, refuse_changes
from foamprb.settings.libs import load_libs
from foamprb.settings.solution import Solution


class Begun(NamedTuple):
    """A case, its flow, and the fingerprint of its run."""

    case: Path
    flows: dict[Any, Any]
    marks: dict[str, Any]


SETTINGS = Path("constant/softCloudProperties")
SOLID = """
import foamprb
from foamprb.body.tensor import log_ratio


def energy(I1, I2, J, mu, lame, k):
    log_J = log_ratio(J)
    return 0.5 * mu * (I1 - 3.0) - mu * log_J + (0.5 + k) * lame * log_J * log_J


foamprb.add_material("own", energy, parameter=foamprb.Parameter("share", 0.0, 1.0))
"""
TEXT = """
libs ("solid.py");
solution
{
    deltaT 2e-5; maxDeltaT 4e-5; endTime 1; writeInterval 0.01; writeFields (Uc); writePrecision double;
    startFrom startTime; maxFailedFraction 0.4; maxStretch 50; maxSize 0.5; maxSubSteps 1e5; maxCells 100;
    accept (unbalanced); transient no; tracers no; scale 1; mixture no; rotatingZones relative;
    interpolationSchemes { U linear; }
    integrationSchemes { U Euler; shape rosenbrock; tolerance 1e-4; roughnessShare 0.05; }
}
constantProperties
{
    rho0 2560; rhoInf 1.208;
    solid
    {
        type own; share 0.5; bulkModulus 1e5; referenceShearRate 900; viscosity 0.01; surfaceTension 1e-4;
        Ca { type uniform; uniformDistribution { minValue 0.1; maxValue 0.2; } }
    }
    shape { type ellipsoid; axisRatios (1.2 1 0.9); orientation axes; e1 (1 0 0); e2 (0 1 0); }
}
subModels
{
    particleForces
    {
        ellipsoidDrag { type oberbeck; } gravity; virtualMass { Cvm 0.5; }
        BrownianMotion { T 293; seed 3; } wallLift { cutOff 10; }
    }
    tractionModel roscoe;
    shapeModel affine;
    dispersionModel none;
    fates { ruptured { stretch 9; } }
    injectionModels
    {
        inlet
        {
            type patchInjection; patch inlet; parcelsPerSecond 3000; duration 0.1; SOI 0;
            sizeDistribution { type fixedValue; fixedValueDistribution { value 5e-06; } }
        }
        points
        {
            type manualInjection; positionsFile "softCloudPositions"; SOI 0.1; U0 (0 0 0.1);
            rho0 1000; solid { viscosity 0.02; }
            sizeDistribution { type fixedValue; fixedValueDistribution { value 4e-06; } }
        }
    }
    patchInteractionModel localInteraction;
    localInteractionCoeffs
    {
        patches ( wall { type rebound; e 0.5; mu 0.1; } inlet { type escape; } outlet { type escape; } );
        touching ellipsoid;
    }
}
cloudFunctions { paths { type particleTracks; trackInterval 50; maxSamples 50; } }
"""

SIZES = "type uniform; uniformDistribution { minValue 4e-6; maxValue 5e-6; }"
OTHER = {
    "solution/deltaT": "4e-5",
    "solution/maxDeltaT": "6e-5",
    "solution/writeFields": "(active)",
    "solution/writePrecision": "single",
    "solution/startFrom": "latestTime",
    "solution/accept": "()",
    "solution/tracers": "yes",
    "solution/rotatingZones": "absolute",
    "solution/interpolationSchemes/U": "cellPoint",
    "constantProperties/shape/orientation": "random",
    "subModels/particleForces/ellipsoidDrag/type": "brennerProlate",
    "subModels/tractionModel": "jeffery",
    "subModels/shapeModel": "quadratic",
    "subModels/localInteractionCoeffs/touching": "centre",
}
"""Other values of entries that are no numbers."""
WHOLE = {
    "constantProperties/solid": "type neoHooke; poissonsRatio 0.4; Ca 0.1; referenceShearRate 900;",
    "constantProperties/solid/Ca": "type fixedValue; fixedValueDistribution { value 0.1; }",
    "constantProperties/shape": "type sphere;",
    "subModels/injectionModels/inlet/sizeDistribution": SIZES,
    "subModels/injectionModels/points/sizeDistribution": SIZES,
    "subModels/localInteractionCoeffs/patches/wall": "type stick;",
    "subModels/localInteractionCoeffs/patches/inlet": "type stick;",
    "subModels/localInteractionCoeffs/patches/outlet": "type stick;",
    "cloudFunctions/paths": "type particleStatistics;",
}
"""Other models, with their entries, in place of a dictionary whose ``type`` changes."""
WITHOUT_EFFECT = {
    "solution/endTime": "a run may go on for longer",
    "solution/writeInterval": "write times change no particle",
    "solution/startFrom": "is about the beginning of a run",
    "solution/maxFailedFraction": "a run that ended with too many failures may go on",
    "solution/accept": "lets a run begin, or not",
    "solution/tracers": "points of the fluid follow after the bodies",
    "solution/interpolationSchemes/U": "both words are the same interpolation",
    "solution/rotatingZones": "the case has none",
}
ONE_VALUE = {
    "libs": "the solid is defined there; the file itself is changed below",
    "solution/transient": "the flow has one time",
    "solution/scale": "lengths of a case are in m",
    "solution/mixture": "there is one phase",
    "solution/integrationSchemes/U": "the only word",
    "solution/integrationSchemes/shape": "one integrator has virtual mass and Brownian motion",
    "subModels/particleForces/gravity": "no value",
    "subModels/dispersionModel": "the flow is laminar",
    "subModels/injectionModels/inlet/type": "other entries",
    "subModels/injectionModels/inlet/patch": "fluid enters through one patch",
    "subModels/injectionModels/points/type": "other entries",
    "subModels/injectionModels/points/positionsFile": "the file itself is changed below",
    "subModels/patchInteractionModel": "other entries",
}
"""Entries that this case allows no other value, and why."""


def entries_of(entry: Entry) -> Iterator[Entry]:
    """All values, and the dictionaries with another model."""
    if isinstance(entry, Stream) or entry.path in WHOLE:
        yield entry
    if not isinstance(entry, Stream):
        for part in entry.items if isinstance(entry, DictionaryList) else entry.dictionary().entries.values():
            yield from entries_of(part)


def text_of(entry: Entry) -> str:
    if isinstance(entry, Dictionary):
        inner = "\n".join(map(text_of, entry.entries.values()))
        return f"{entry.key} {{\n{inner}\n}}" if entry.parent else inner
    if isinstance(entry, DictionaryList):
        return f"{entry.key} (\n{' '.join(map(text_of, entry.items))}\n);"
    return f"{entry.key} {entry.text};"


def changed(tokens: Sequence[str]) -> tuple[str, ...]:
    """The tokens with another last number; empty without a number."""
    for k in reversed(range(len(tokens))):
        with suppress(ValueError):
            number = f"{int(tokens[k]) + 1}" if tokens[k].isdigit() else f"{1.05 * float(tokens[k])}"
            return (*tokens[:k], number, *tokens[k + 1 :])
    return ()


ROOT_ENTRIES = parse_dictionary(TEXT, SETTINGS, Path())
ENTRIES = {entry.path: entry for entry in entries_of(ROOT_ENTRIES)}


@pytest.fixture(scope="module")
def begun(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Begun]:
    case = copy_of_pipe(tmp_path_factory.mktemp("changes"))
    (case / SETTINGS).write_text(TEXT)
    (case / "constant/solid.py").write_text(SOLID)
    flows: dict[Any, Any] = {}
    solids = dict(MATERIALS)
    job = prepare(case, flows=flows)
    yield Begun(case, flows, json.loads(json.dumps(fingerprint(job.settings, job.cloud))))
    load_libs([])
    MATERIALS.clear()
    MATERIALS.update(solids)


def is_refused(begun: Begun, flows: dict[Any, Any]) -> str:
    """The message with which the changed case is refused; empty if it continues."""
    job = prepare(begun.case, flows=flows)
    try:
        stored: Any = SimpleNamespace(header={"fingerprint": begun.marks})
        refuse_changes(stored, fingerprint(job.settings, job.cloud), "case")
    except InputError as error:
        return str(error)
    return ""


def test_the_case_has_all_entries_of_solution() -> None:
    hints = hints_of(Solution)
    kinds = {field.name: rule_of(hints[field.name]) for field in fields(Solution)}
    names = {name for name, rule in kinds.items() if not isinstance(rule, NoEffect | Only)}
    assert names - {"period"} == {*ROOT_ENTRIES.entries["solution"].dictionary().entries}


@pytest.mark.parametrize("path", ENTRIES)
def test_a_changed_entry_is_refused(path: str, begun: Begun, monkeypatch: pytest.MonkeyPatch) -> None:
    entry = ENTRIES[path]
    if isinstance(entry, Stream):
        other = OTHER.get(path) or " ".join(changed(entry.tokens))
        if not other:
            # A new entry belongs to one of the tables above.
            assert path in ONE_VALUE or path.rpartition("/")[0] in WHOLE
            return
        monkeypatch.setattr(entry, "tokens", (other,))
    else:
        monkeypatch.setattr(entry, "entries", parse_dictionary(WHOLE[path], SETTINGS, Path()).entries)
    (begun.case / SETTINGS).write_text(text_of(ROOT_ENTRIES))
    if path in ONE_VALUE:
        with pytest.raises(InputError):
            prepare(begun.case, flows=begun.flows)
    else:
        assert bool(is_refused(begun, begun.flows)) == (path not in WITHOUT_EFFECT)


UNREAD = {
    "README.md", "Allrun", "Allclean", ".gitignore",
    "constant/turbulenceProperties", "system/fvSolution", "system/fvSchemes", "system/blockMeshDict",
    "system/controlDict", "0/U", "0/p", "249/p.gz",
}  # fmt: skip
"""Files of the solver, which act by its results; the settings give the times of ``controlDict``."""


BINARY = {"249/U.gz": (24, 6), "owner.gz": (4, 0), "neighbour.gz": (4, 0), "points.gz": (24, 6)}
"""Size of an item of the list in a file, and a byte of it that is significant."""


def with_change(name: str, data: bytes) -> bytes:
    """The contents of a file with another number, or with a line more."""
    for ending, (size, byte) in BINARY.items():
        if name.endswith(ending):
            match = re.search(rb"\n(\d+)\n?\(", data)
            assert match
            place = match.end() + int(match[1]) // 2 * size + byte
            return data[:place] + bytes([data[place] ^ 1]) + data[place + 1 :]
    digits = [match.start() for match in re.finditer(rb"(?<=[ .(])\d(?=[^\n]*[;)])", data)]
    if not digits:
        return data + b"\n"
    return data[: digits[-1]] + b"%d" % (9 - int(data[digits[-1] :][:1])) + data[digits[-1] + 1 :]


FILES = [
    str(file.relative_to(PIPE))
    for file in sorted(PIPE.rglob("*"))
    if file.is_file() and "postProcessing" not in file.parts and not file.name.startswith("log.")
]


@pytest.mark.parametrize("name", [*FILES, "constant/solid.py"])
def test_a_changed_file_is_refused(name: str, begun: Begun) -> None:
    (begun.case / SETTINGS).write_text(TEXT)
    file = begun.case / name
    before = file.read_bytes()
    packed = file.suffix == ".gz"
    data = gzip.decompress(before) if packed else before
    new = with_change(name, data)
    assert new != data
    file.write_bytes(gzip.compress(new) if packed else new)
    try:
        message = is_refused(begun, {})
    except InputError as error:
        message = str(error)
    finally:
        file.write_bytes(before)
    assert bool(message) == (name not in UNREAD)
