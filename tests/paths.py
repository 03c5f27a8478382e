"""Where the tests find what belongs to the checkout."""

from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

ROOT = Path(__file__).parents[1]
PIPE = ROOT / "cases/pipe"


def load(file: Path) -> ModuleType:
    """Return a Python file of a case as a module."""
    spec = spec_from_file_location(f"{file.parent.name}_{file.stem}", file)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
