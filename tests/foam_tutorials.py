"""OpenFOAM's tutorials, copied."""

from __future__ import annotations

import gzip
import shutil
from pathlib import Path

import pytest

TUTORIALS = Path("/usr/share/doc/openfoam-examples/examples")


def tutorial(name: str, target: Path) -> Path:
    """Copy a tutorial with its files unpacked; without it a test is skipped."""
    source = TUTORIALS / name
    if not source.is_dir():
        pytest.skip(f"no {source}")
    shutil.copytree(source, target)
    for zipped in target.rglob("*.gz"):
        zipped.with_suffix("").write_bytes(gzip.decompress(zipped.read_bytes()))
        zipped.unlink()
    return target
