"""Reads the page of ``foamprb view`` as its script does: an independent statement of the encoding."""

from __future__ import annotations

import base64
import json
import re
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.view.encode import Column


def unpack(shape: tuple[int, ...], order: int, n_bytes: int, data: str) -> NDArray[np.int64]:
    """Whole numbers of a column."""
    n = int(np.prod(shape))
    planes = np.frombuffer(zlib.decompress(base64.b64decode(data)), dtype=np.uint8).reshape(n_bytes, n)
    coded = sum(plane.astype(np.int64) << (8 * k) for k, plane in enumerate(planes))
    difference = np.where(coded % 2, -(coded + 1) // 2, coded // 2)
    whole = difference.reshape(-1, shape[0]).T if n else np.zeros((shape[0], 0), dtype=np.int64)
    for _ in range(order):
        whole = np.cumsum(whole, axis=0)
    return whole.reshape(shape)


def unpacked(column: Column) -> NDArray[np.int64]:
    return unpack(column.shape, column.order, column.bytes, column.data)


def values_of(whole: NDArray[np.int64], low: list[float]) -> NDArray[np.float64]:
    """Values of an array: 14 bits of mantissa within 24 octaves above ``low``, and the sign."""
    k = whole - 2 - 24 * 2**14
    exponent, mantissa = np.divmod(np.abs(k) - 1, 2**14)
    sizes = np.array(low) * np.exp2(exponent) * (1 + mantissa / 2**14)
    return np.where(whole == 0, np.nan, np.sign(k) * sizes)


class PageReader:
    """The data of a page."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.scene: dict[str, Any] = json.loads(self._element("scene"))

    def _element(self, name: str) -> str:
        found = re.search(rf'<script type="[^"]*" id="{name}">(.*?)</script>', self.text, re.DOTALL)
        assert found
        return found[1]

    def whole(self, spec: dict[str, Any]) -> NDArray[np.int64]:
        data = self._element(f"section-{spec['section']}")
        return unpack(tuple(spec["shape"]), spec["order"], spec["bytes"], data)

    def field(self, spec: dict[str, Any]) -> NDArray[np.float64]:
        return values_of(self.whole(spec), spec["low"])

    def values(self, spec: dict[str, Any]) -> NDArray[np.float64]:
        return np.array(spec["low"]) + np.array(spec["step"]) * self.whole(spec)

    def present(self) -> NDArray[np.bool_]:
        spec = self.scene["bodies"]["present"]
        n = self.scene["bodies"]["ids"]["shape"][0]
        bits = np.unpackbits(self.whole(spec).astype(np.uint8), axis=1, count=n, bitorder="little")
        return bits.astype(bool)
