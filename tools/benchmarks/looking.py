"""Memory and time of view and report, for results of a chosen size.

A run of particles in a pipe writes the results into a temporary folder, 1e5 particles at 51 times 2.2 GB.

    python tools/benchmarks/looking.py -n 100000 -times 51
"""

from __future__ import annotations

import argparse
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import foamprb

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from benchmarks import pipe

DT, BETWEEN = 2e-4, 5
"""Tracking step, s, and steps between two written times."""
IMPORTS = ("pass", "import numpy", "import vtkmodules.vtkIOXML", "import numba", "import foamprb.view.show")
COMMANDS = {
    "view": ("view", "-noBrowser"),
    "view -bodies 5000": ("view", "-noBrowser", "-bodies", "5000"),
    "report": ("report", "-noBrowser"),
    "view -png": ("view", "-png", "picture.png"),
}
_PEAK = """
import pathlib, re
status = pathlib.Path("/proc/self/status").read_text()
pathlib.Path("peak").write_text(re.search(r"VmHWM:\\s+(\\d+)", status)[1])
"""
"""The peak of a process alone: that of its resource usage includes the process which started it."""


def write_run(folder: Path, n: int, times: int) -> Path:
    """Write a case and the results of n particles at some times; return the case."""
    case = pipe.write_case(folder / "case", pipe.GRIDS["5k"])
    pipe.write_positions(case / "constant" / "softCloudPositions", pipe.positions(n))
    pipe.write_default_cloud(case, "softCloud", 0.5, DT, BETWEEN * (times - 1))
    foamprb.execute(foamprb.prepare(case, overrides={"solution/writeInterval": BETWEEN * DT}))
    return case


def cost(code: str, folder: Path) -> tuple[float, float]:
    """Return CPU time, s, and peak memory, MB, of a Python program."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, "-c", code + _PEAK], stdout=subprocess.DEVNULL, cwd=folder, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, int((folder / "peak").read_text()) * 1024e-6


def main() -> None:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("-n", type=int, default=20_000, help="particles [20000]")
    parser.add_argument("-times", type=int, default=21, help="written times [21]")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        case = write_run(folder, options.n, options.times)
        results = case / "postProcessing/softCloud"
        size = sum(path.stat().st_size for path in results.rglob("*") if path.is_file())
        print(f"\n{options.n} particles at {options.times} times, {size / 1e6:.0f} MB\n")
        print("| command | CPU time, s | peak memory, MB |\n|---|---:|---:|")
        rows = {f"python -c '{line}'": line for line in IMPORTS}
        for name, words in COMMANDS.items():
            arguments = [*words, "-case", str(case)]
            rows[name] = f"from foamprb.cli import main\nassert main({arguments}) == 0\n"
        for name, code in rows.items():
            seconds, peak = cost(code, folder)
            print(f"| {name} | {seconds:.1f} | {peak:.0f} |", flush=True)


if __name__ == "__main__":
    main()
