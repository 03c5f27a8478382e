"""ParaView's Python, on a display of its own."""

from __future__ import annotations

import os
import shutil
import subprocess


def pvpython(*arguments: object) -> subprocess.CompletedProcess[str]:
    """Run pvpython, on a virtual display of its own if there is xvfb-run."""
    # Where two displays begin to look for a free number at the same time they take the same, unless they look
    # in different places.
    number = 100 + 37 * os.getpid() % 30000
    display = ["xvfb-run", "-a", "-n", str(number)] if shutil.which("xvfb-run") else []
    command = [*display, "pvpython", *map(str, arguments)]
    for _ in range(5):
        done = subprocess.run(command, capture_output=True, text=True, timeout=240, check=False)
        # Now and then the first window aborts, the virtual display not being ready: no exit code of a script.
        if done.returncode in (0, 1, 2):
            break
    return done
