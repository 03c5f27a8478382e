"""All dictionaries of OpenFOAM's tutorials, read as OpenFOAM's own parser reads them."""

from __future__ import annotations

import gzip
import math
import subprocess
from pathlib import Path
from typing import Any

import pytest
from foam_tutorials import TUTORIALS

from foamprb.dictionary.grammar import parse_dictionary, read_dictionary
from foamprb.dictionary.tree import Dictionary, Entry, Stream

pytestmark = [pytest.mark.openfoam, pytest.mark.nightly]
NOT_READ = {
    "incompressible/lumpedPointMotion/building/steady/system": "a macro named by the program",
    "multiphase/overInterDyMFoam/twoSimpleRotors/system": "OpenFOAM leaves out an undefined macro",
}
FILES = (file for kind in ("system", "constant") for file in TUTORIALS.glob(f"**/{kind}/*"))
CASES = sorted({file.parent for file in FILES if file.is_file()})


def plain(entry: Entry) -> Any:
    """The values of an entry; OpenFOAM writes numbers with six digits."""
    if isinstance(entry, Dictionary):
        return {key.strip('"'): plain(value) for key, value in entry.entries.items()}
    if isinstance(entry, Stream):
        return [word.strip('"') for word in entry.tokens]
    return [plain(item) for item in entry.items]


def alike(a: Any, b: Any) -> bool:
    if isinstance(a, dict):
        return isinstance(b, dict) and a.keys() == b.keys() and all(alike(a[key], b[key]) for key in a)
    if isinstance(a, list):
        return isinstance(b, list) and len(a) == len(b) and all(map(alike, a, b))
    try:
        return math.isclose(float(a), float(b), rel_tol=1e-4)
    except ValueError:
        return a == b


@pytest.mark.parametrize("folder", CASES, ids=lambda folder: str(folder.relative_to(TUTORIALS)))
def test_dictionaries_are_those_of_foam_dictionary(folder: Path, tmp_path: Path) -> None:
    """Beside their neighbours, which they may include, without code and other things that OpenFOAM reads."""
    if reason := NOT_READ.get(str(folder.relative_to(TUTORIALS))):
        pytest.skip(reason)
    here = tmp_path / folder.name
    here.mkdir()
    for file in folder.iterdir():
        if file.is_file():
            data = gzip.decompress(file.read_bytes()) if file.suffix == ".gz" else file.read_bytes()
            (here / file.name.removesuffix(".gz")).write_bytes(data)
    for file in sorted(here.iterdir()):
        text = file.read_text(errors="replace")
        if "FoamFile" not in text or any(
            word in text for word in ("#calc", "#code", "#eval", "#remove", "#includeFunc")
        ):
            continue
        done = subprocess.run(
            ["foamDictionary", "-expand", file], cwd=tmp_path, capture_output=True, text=True
        )
        if done.returncode or "FoamFile" not in done.stdout:
            continue
        theirs = parse_dictionary(done.stdout[done.stdout.index("FoamFile") :], file, tmp_path)
        assert alike(plain(read_dictionary(file, tmp_path)), plain(theirs)), file.name
