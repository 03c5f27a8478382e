"""Pictures of the tutorials with OpenFOAM: executes the commands, edits and scripts of their pages."""

from __future__ import annotations

import argparse
import os
import re
import shlex
import shutil
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = ("openfoam", "blood", "rotor")


def steps(page: Path) -> list[tuple[str, str, str]]:
    """Return the fenced blocks of a page: the comment before each, its language and its text."""
    pattern = r"(?:<!-- ([^\n]*) -->\n)?^```(\w*)\n(.*?)^```"
    return re.findall(pattern, page.read_text(), re.DOTALL | re.MULTILINE)


def edit(file: Path, text: str) -> None:
    """Replace the lines of a dictionary that begin with the same words as the lines of a text."""
    content = file.read_text()
    for line in text.splitlines():
        content, n = re.subn(rf"^ *{re.escape(line.split()[0])} .*$", line, content, flags=re.MULTILINE)
        if n != 1:
            raise SystemExit(f"{file}: {n} lines begin with {line.split()[0]}, not 1")
    file.write_text(content)


def command(line: str) -> None:
    """Execute a line of the shell; foamprb in this process, which has loaded it."""
    words = shlex.split(line, comments=True)
    if words[0] == "cd":
        os.chdir(words[1])
    elif words[0] == "foamprb":
        from foamprb.cli import main as foamprb

        if foamprb(words[1:]) != 0:
            raise SystemExit(f"{line} failed")
    else:
        done = subprocess.run(line, shell=True, capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(done.stdout + done.stderr)


def execute(page: Path, folder: Path, left_out: tuple[str, ...] = ()) -> list[Path]:
    """Execute a page in an empty folder with a link to the clone, less some commands; return the pictures.

    A block of ``sh`` is commands, one of ``python`` a script. The comments ``edit FILE`` and ``add DICTIONARY
    FILE`` before a block say where its lines go.
    """
    os.chdir(folder)
    Path("foamprb").symlink_to(ROOT)
    for mark, language, text in steps(page):
        kind, *where = mark.split() or [""]
        if language == "sh":
            for line in text.splitlines():
                if line not in left_out:
                    command(line)
        elif language == "python":
            exec(compile(text, page, "exec"), {"__name__": "__main__"})
        elif kind == "edit":
            edit(Path(where[0]), text)
        elif kind == "add":
            file = Path(where[1])
            file.write_text(file.read_text().replace(f"{where[0]}\n{{\n", f"{where[0]}\n{{\n{text}", 1))
    return sorted(Path.cwd().glob("*.png"))


def main() -> None:
    """Execute the pages and keep their pictures."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.parse_args()
    os.environ["MPLBACKEND"] = "agg"
    for name in PAGES:
        with tempfile.TemporaryDirectory() as folder:
            for picture in execute(ROOT / "docs/tutorials" / f"{name}.md", Path(folder)):
                shutil.copy(picture, ROOT / "docs/tutorials")
            os.chdir(ROOT)


if __name__ == "__main__":
    main()
