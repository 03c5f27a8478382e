"""What OpenFOAM writes of its parcels."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

G = "dimensions [0 1 -2 0 0 0 0]; value (0 0 0);"


def numbers(path: Path) -> np.ndarray:
    """Of a list of scalars or vectors that OpenFOAM wrote in ascii."""
    body = path.read_text().split("// * *", 1)[1]
    return np.array(re.sub(r"[()]", " ", body[body.index("(") : body.rindex(")")]).split(), dtype=float)
