"""Flows: analytic ones, and those on meshes."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(__name__, submodules=["analytic"])
