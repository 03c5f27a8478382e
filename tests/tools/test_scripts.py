"""Every script of tools/ starts where it lies, says what it can do, and is in the list of tools/README.md."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

from benchmarks.records import PARTS
from paths import ROOT

TOOLS = ROOT / "tools"
LISTED = re.findall(r"^\| `(tools/[^`]+)` \|", (TOOLS / "README.md").read_text(), re.MULTILINE)


def is_script(path: Path) -> bool:
    """Whether a file is meant to be run; ``records.py`` runs itself."""
    if not path.is_file() or path.suffix not in ("", ".py") or path.name == "records.py":
        return False
    text = path.read_text()
    return text.startswith("#!") or '__name__ == "__main__"' in text


def environment():
    path = os.pathsep.join([str(ROOT), str(TOOLS)])
    return os.environ | {"PYTHONPATH": path, "COLUMNS": "100"}


def test_every_script_is_listed_and_every_listed_script_is_there():
    found = sorted(str(path.relative_to(ROOT)) for path in TOOLS.rglob("*") if is_script(path))
    assert sorted(LISTED) == found


def test_every_script_has_help():
    """It finds its modules from its own place."""
    variables, faults = environment() | {"PYTHONPATH": str(ROOT)}, {}
    for script in LISTED:
        shell = (ROOT / script).read_text().startswith(("#!/bin/sh", "#!/usr/bin/env bash"))
        command = ["bash" if shell else sys.executable, script, "-help"]
        done = subprocess.run(command, cwd=ROOT, env=variables, capture_output=True, text=True)
        if done.returncode or done.stderr or not done.stdout.lower().startswith("usage: "):
            faults[script] = done.stdout + done.stderr
    assert not faults


def test_parts_of_the_benchmark_are_there():
    """Each has what the benchmark calls."""
    program = f"import importlib\nfor p in {PARTS}: importlib.import_module('benchmarks.' + p).measure"
    done = subprocess.run([sys.executable, "-c", program], env=environment(), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_commands_in_the_pages_name_files_that_are_there():
    pages = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md"), *ROOT.glob("cases/*/README.md")]
    pages += [*TOOLS.rglob("*.md"), *TOOLS.rglob("*.in"), ROOT / ".ci/run"]
    missing = {
        (page.name, name)
        for page in pages
        for name in re.findall(r"\btools/[\w/.-]*\w", page.read_text())
        if not (ROOT / name).exists()
    }
    assert not missing
