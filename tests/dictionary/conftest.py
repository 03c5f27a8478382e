from __future__ import annotations

from cloud_dictionary import case, notes, read

__all__ = ["case", "notes", "read"]
