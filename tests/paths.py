"""Where the tests find what belongs to the checkout."""

from pathlib import Path

ROOT = Path(__file__).parents[1]
PIPE = ROOT / "cases/pipe"
