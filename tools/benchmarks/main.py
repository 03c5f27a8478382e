"""The command line of the benchmark."""

from __future__ import annotations

import argparse
import importlib
import os
import shutil
import sys
import tempfile
from pathlib import Path

from benchmarks.records import (
    PARTS,
    TOOLS,
    Options,
    Results,
    Row,
    isolated,
    load,
    machine,
    read_rows,
)

CSV = "performance.csv"


def measure(part: str, quick: bool, large: bool, bodies: int) -> list[Row]:
    """Return the rows of one part."""
    rows: list[Row] = importlib.import_module(f"benchmarks.{part}").measure(Options(quick, large, bodies))
    return rows


def _first_line(part: str) -> str:
    text = (TOOLS / "benchmarks" / f"{part}.py").read_text(encoding="utf-8")
    return text.split("\n", 1)[0].strip().strip('"')


def _arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="benchmark",
        description="Measure foamprb's speed and memory, each part in a process of its own.",
        add_help=False,
    )
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("-list", action="store_true", help="list the parts and stop")
    parser.add_argument(
        "-only", nargs="+", choices=PARTS, default=PARTS, metavar="PART", help="only these [all]"
    )
    parser.add_argument("-quick", action="store_true", help="few steps and repeats: to see that all works")
    parser.add_argument(
        "-large", action="store_true", help="also 1e7 particles and 8e6 cells: 20 GB of memory"
    )
    parser.add_argument(
        "-bodies", type=int, default=0, metavar="N", help="bodies in the runs of part observed [4000]"
    )
    parser.add_argument(
        "-output", type=Path, default=TOOLS.parent / "docs", metavar="DIR",
        help="folder of performance.csv, whose other parts are kept, and performance.md [docs]",
    )  # fmt: skip
    parser.add_argument(
        "-report", action="store_true", help="measure nothing, write the page from performance.csv"
    )
    parser.add_argument("-scratch", type=Path, metavar="DIR", help="keep the cases here and use them again")
    return parser


def main(arguments: list[str] | None = None) -> int:
    """Measure, print and write; the exit status is 1 if a part failed."""
    parsed = _arguments().parse_args(arguments)
    if parsed.list:
        for part in PARTS:
            print(f"{part:12s} {_first_line(part)}")
        return 0
    from benchmarks.report import costs_table, write_report, written_table
    from foamprb.results.tables import write_table

    parsed.output.mkdir(parents=True, exist_ok=True)
    of_parts = {part: [r for r in read_rows(parsed.output / CSV) if r.part == part] for part in PARTS}
    scratch = parsed.scratch or Path(tempfile.mkdtemp(prefix="foamprb-benchmark-"))
    os.environ["FOAMPRB_BENCHMARK_DIR"] = str(scratch.resolve())
    failed = []
    try:
        for part in () if parsed.report else [p for p in PARTS if p in parsed.only]:
            print(f"{part}: {_first_line(part)}", flush=True)
            busy = load()
            try:
                child = isolated(measure, part, parsed.quick, parsed.large, parsed.bodies)
            except RuntimeError as error:
                print(f"    failed: {error}", file=sys.stderr)
                failed.append(part)
                continue
            note = Row(part, "machine", machine() + (", quick" if parsed.quick else ""), 0.0, busy, "load")
            of_parts[part] = [note, *(Row(*values) for values in child.result)]
            for row in of_parts[part]:
                size = f"{row.size:g}" if row.size else ""
                print(f"    {row.quantity:30s} {row.subject:32.60s} {size:8s} {row.value:11.5g} {row.unit}")
            print(f"    {child.wall:.0f} s", flush=True)
            rows = [row for p in PARTS for row in of_parts[p]]
            columns = {name: [getattr(row, name) for row in rows] for name in Row._fields}
            write_table(parsed.output / CSV, columns)
    finally:
        if parsed.scratch is None:
            shutil.rmtree(scratch, ignore_errors=True)
    results = Results(row for part in PARTS for row in of_parts[part])
    print(f"\n{costs_table(results)}\n\n{written_table(results)}")
    write_report(results, parsed.output)
    return 1 if failed else 0
