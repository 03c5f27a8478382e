"""The pipe case of the tree, copied, edited and read."""

from __future__ import annotations

import csv
import json
import logging
import re
import shutil
from pathlib import Path

import pytest
from foam_writer import put_scalar
from paths import PIPE

from foamprb import execute, prepare
from foamprb.cli import main
from foamprb.errors import RunStopped

END = 0.006
"""End time of :func:`short_case`, s."""
EARLIER = 0.003
"""Time between two injections of it, s."""


def copy_of_pipe(folder: Path) -> Path:
    case = folder / "pipe"
    skipped = shutil.ignore_patterns("postProcessing", "coarse", "medium", "fine", "log.*")
    shutil.copytree(PIPE, case, ignore=skipped)
    return case


def edit(case: Path, pattern: str, text: str, file: str = "constant/softCloudProperties") -> None:
    path = case / file
    edited, n = re.subn(pattern, text, path.read_text(), flags=re.MULTILINE)
    assert n, f"{pattern} is not in {file}"
    path.write_text(edited)


def short_case(folder: Path) -> Path:
    """305 particles, the last of them injected after 4 ms; six write times until 6 ms; one on the wall."""
    case = copy_of_pipe(folder)
    edit(case, r"endTime\s+\S+;", f"endTime {END};")
    edit(case, r"writeInterval\s+\S+;", "writeInterval 0.001;")
    edit(case, r"parcelsPerSecond\s+\S+;", "parcelsPerSecond 75000;")
    edit(case, r"duration\s+\S+;", "duration 0.004;")
    edit(case, r"\(0 -0\.00165 0\)", "(0 -0.00165 0) (0 -0.002096 0)", "constant/softCloudPositions")
    return case


def stop_after(case: Path, time: float) -> None:
    """Run a case until a time, s."""
    # The command line may have closed the stream that an earlier test logged to.
    logging.getLogger("foamprb").handlers.clear()
    job = prepare(case, threads=1)
    with pytest.raises(RunStopped, match=r"stopped at t = .*add -resume"):
        execute(job, "latestTime", stop=lambda: job.cloud.time > 0.99 * time)


def time_folder(case: Path) -> Path:
    return max((f for f in case.iterdir() if re.fullmatch(r"[1-9]\d*", f.name)), key=lambda f: int(f.name))


def with_eddies(folder: Path) -> Path:
    """The short case with stochasticDispersionRAS in uniform turbulence."""
    case = short_case(folder)
    model = "dispersionModel stochasticDispersionRAS; patchInteractionModel"
    edit(case, "patchInteractionModel", model)
    put_scalar(time_folder(case), "k", "0 2 -2", 1e-4)
    put_scalar(time_folder(case), "epsilon", "0 2 -3", 0.05)
    return case


def message(case: Path, capsys: pytest.CaptureFixture[str], *options: str) -> str:
    """The one message of a run that must fail."""
    assert main(["run", "-case", str(case), *options]) == 1
    err = capsys.readouterr().err
    assert "Traceback" not in err
    assert err.startswith("--> foamprb Error : ")
    assert len(err.strip().splitlines()) == 1
    return err


def fates(case: Path) -> list[dict[str, str]]:
    with (case / "postProcessing/softCloud/fates.csv").open() as file:
        return list(csv.DictReader(file))


def results(case: Path) -> dict[str, bytes]:
    """All files of a run but the checkpoint before the last, which tells of interruptions.

    So does the manifest, which lists it: of the manifest only the other names. It must list all files.
    """
    folder = case / "postProcessing/softCloud"
    files = [file for file in folder.rglob("*") if file.is_file()]
    manifest = folder / "manifest.json"
    listed = {folder / name for name in json.loads(manifest.read_text())["files"]}
    assert listed == {*files} - {manifest}
    early = sorted(folder.glob("checkpoint/*"), key=lambda file: float(file.stem))[:-1]
    found = {file: file.read_bytes() for file in files if file not in (*early, manifest)}
    # The text of the settings, of which more may differ than what acts, is left out of the record.
    record = json.loads(found[folder / "run.json"])
    del record["settings"], record["functions"]
    found[folder / "run.json"] = json.dumps(record).encode()
    found[manifest] = b"\n".join(str(file.relative_to(folder)).encode() for file in sorted(found))
    return {str(file.relative_to(folder)): data for file, data in found.items()}
