from __future__ import annotations

from cloud_dictionary import case, read

__all__ = ["case", "read"]
