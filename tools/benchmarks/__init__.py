"""Parts of ``tools/benchmark``: one module each, with a function ``measure``."""
