"""What ``tools/benchmark`` measures: one module a part, each with a function ``measure``."""
