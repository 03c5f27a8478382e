"""A scene as one HTML file that needs nothing else: no network, no other file, no installation."""

from __future__ import annotations

import base64
import hashlib
import html
import json
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.view.bodies import Bodies, Codes, Field
from foamprb.view.colours import DARK, LIGHT, MAPS, colour_map
from foamprb.view.encode import (
    Column,
    Grid,
    Packed,
    grid_of,
    pack,
    pack_bits,
    pack_field,
    pack_points,
    pack_shapes,
    pack_values,
)
from foamprb.view.geometry import Surface
from foamprb.view.scene import (
    INSETS,
    MARGIN,
    MOST_DEPOSITS,
    TALL,
    VIEW_ANGLE,
    Camera,
    Scene,
    anchor,
    box,
    extremes_of,
    limits_of,
    round_limits,
)

_FOLDER = Path(__file__).parent / "page"
_NOTES, _DESCRIPTION = 400, 2000
"""Bytes that a page may say of arrays that are left out, and of one that is not."""


class Page:
    """The parts of a page, packed; the text of the file is :meth:`write`.

    ``needed`` is its size without what can be left out, bytes, and ``left_out`` names what is.

    Parameters
    ----------
    scene
        What is shown, with all its arrays.
    most_bytes
        Size that the file is to stay below. Arrays that do not fit are left out; that by which the bodies are
        coloured stays.
    order
        Names of the arrays, those that matter most first.
    version
        Of foamprb.
    """

    def __init__(self, scene: Scene, most_bytes: int, order: Sequence[str], version: str) -> None:
        self.left_out: list[str] = []
        self._sections: list[str] = []
        self._version = version
        self._scene = scene
        bodies, geometry = scene.bodies, scene.geometry
        points = geometry.points if geometry is not None else np.zeros((0, 3))
        extra = [part.points for part in (scene.slice, scene.paths) if part is not None]
        grid = grid_of(points, bodies.x[bodies.present], *extra)
        self._frame = _Frame(*_corners(points, bodies, extra))
        self._header = self._described() | self._bodies(grid) | self._surroundings(grid)
        fields = self._header["fields"] = {}
        name = scene.colour[0]
        if name in bodies.fields:
            fields[name] = self._field(bodies.fields[name], pack_field(bodies.fields[name]))
        self.needed = len(self.write().encode("utf-8"))
        room = most_bytes - self.needed - _NOTES
        for name in sorted(
            bodies.fields, key=lambda name: order.index(name) if name in order else len(order)
        ):
            if name in fields:
                continue
            packed = pack_field(bodies.fields[name])
            size = len(packed.column.data) + _DESCRIPTION
            if size > room:
                self.left_out.append(name)
            else:
                room -= size
                fields[name] = self._field(bodies.fields[name], packed)

    def write(self) -> str:
        """The text of the file."""
        notes = []
        if self.left_out:
            notes.append(f"Left out, to keep the file small: {', '.join(self.left_out)}.")
        header = json.dumps(self._header | {"notes": notes}, ensure_ascii=False, separators=(",", ":"))
        script, style = _script(), _text("page.css")
        policy = (
            f"default-src 'none'; script-src '{_hash(script)}'; style-src '{_hash(style)}'; "
            "img-src data: blob:; connect-src 'none'; base-uri 'none'; form-action 'none'"
        )
        parts = {
            "policy": policy,
            "version": self._version,
            "title": html.escape(f"{self._scene.title} – {self._scene.subtitle}"),
            "style": style,
            "licence": html.escape(_text("LICENSE.three"), quote=False),
            # Inside a script element only this could end it.
            "scene": header.replace("<", "\\u003c"),
            "sections": "\n".join(
                f'<script type="text/plain" id="section-{k}">{data}</script>'
                for k, data in enumerate(self._sections)
            ),
            "script": script,
        }
        text = _text("page.html")
        pieces = []
        for index, piece in enumerate(text.split("{{")):
            name, _, rest = piece.partition("}}")
            pieces.append(piece if index == 0 else parts[name] + rest)
        return "".join(pieces)

    def _described(self) -> dict[str, Any]:
        scene = self._scene
        return {
            "title": scene.title,
            "subtitle": scene.subtitle,
            "made": f"Made by foamprb {self._version}: {scene.subtitle} of the case {scene.title}.",
            "frame": self._frame.described(),
            "times": _rounded(scene.bodies.times),
            "home": self._camera(scene.camera),
            "enlargement": scene.enlargement,
            "mostDeposits": MOST_DEPOSITS,
            "colour": list(scene.colour),
            "range": None if scene.range is None else list(scene.range),
            "first": scene.first,
            "maps": {name: colour_map(name).tobytes().hex() for name in MAPS},
            "planeMaps": {"light": LIGHT.plane.tobytes().hex(), "dark": DARK.plane.tobytes().hex()},
        }

    def _camera(self, camera: Camera) -> dict[str, Any]:
        size = self._frame.size
        return {
            "focus": _rounded(self._frame.inside(camera.focus)),
            "towards": _rounded(camera.towards),
            "up": _rounded(camera.up),
            "corners": [_rounded(corner / size) for corner in camera.corners],
            # JSON has no infinity.
            "leastWidth": min(camera.least_width / size, 1e9),
            "angle": VIEW_ANGLE,
            "margin": MARGIN,
            "tall": TALL,
            "insets": INSETS,
        }

    def _bodies(self, grid: Grid) -> dict[str, Any]:
        bodies = self._scene.bodies
        wanted = self._scene.colour[0]
        told = {name: own for name, own in bodies.codes.items() if _tells(own) or name == wanted}
        codes = {"status": bodies.status} | told | {"fate": self._scene.fate}
        return {
            "bodies": {
                "ids": self._column(pack(bodies.ids)),
                "places": self._packed(pack_points(bodies.x, grid)),
                "shapes": self._packed(pack_shapes(bodies)),
                "present": self._column(pack_bits(bodies.present)),
                "radius": self._packed(pack_values(bodies.radius)),
            },
            "codes": {name: self._codes(one) for name, one in codes.items()},
        }

    def _surroundings(self, grid: Grid) -> dict[str, Any]:
        scene = self._scene
        surfaces = scene.geometry.surfaces if scene.geometry is not None else ()
        edges = scene.geometry.edges.reshape(-1, 3) if scene.geometry is not None else np.zeros((0, 3))
        return {
            "surfaces": [self._surface(surface, grid) for surface in surfaces],
            "edges": self._packed(pack_points(edges, grid)),
            "slice": self._slice(grid),
            "paths": self._paths(grid),
        }

    def _surface(self, surface: Surface, grid: Grid) -> dict[str, Any]:
        return {
            "name": surface.name,
            "type": surface.type,
            "anchor": _rounded(self._frame.inside(anchor(surface, self._scene.camera))),
            "points": self._packed(pack_points(surface.points, grid)),
            "triangles": self._column(pack(surface.triangles)),
        }

    def _slice(self, grid: Grid) -> dict[str, Any] | None:
        plane = self._scene.slice
        if plane is None:
            return None
        values = []
        for name, (label, unit, value) in plane.values.items():
            limits = round_limits(float(value.min()), float(value.max()))
            values.append(
                {"name": name, "label": label, "unit": unit, "range": limits}
                | self._packed(pack_values(value))
            )
        return {
            "points": self._packed(pack_points(plane.points, grid)),
            "triangles": self._column(pack(plane.triangles)),
            "values": values,
        }

    def _paths(self, grid: Grid) -> dict[str, Any] | None:
        paths, ids = self._scene.paths, self._scene.bodies.ids
        if paths is None or len(ids) == 0:
            return None
        place = np.minimum(np.searchsorted(ids, paths.tracks["origId"]), len(ids) - 1)
        # Of bodies that are not shown there are paths as well.
        place = np.where(ids[place] == paths.tracks["origId"], place, -1)
        return {
            "bodies": self._column(pack(place)),
            "start": self._column(pack(paths.start)),
            "points": self._packed(pack_points(paths.points, grid)),
            "times": self._packed(pack_values(paths.values["time"])),
        }

    def _field(self, field: Field, packed: Packed) -> dict[str, Any]:
        return {
            "name": field.name,
            "label": field.label,
            "unit": field.unit,
            "parts": field.parts,
            "ranges": {part: self._ranges(field.name, part) for part in field.parts},
        } | self._packed(packed)

    def _ranges(self, name: str, part: str) -> dict[str, list[float]]:
        """Limits of the colours at first, those of all values, and the least and the largest value."""
        bodies = self._scene.bodies
        usual = limits_of(bodies, name, part, self._scene.percentiles)
        whole = limits_of(bodies, name, part)
        found = {"usual": usual, "whole": whole, "extremes": extremes_of(bodies, name, part) or whole}
        return {key: _rounded(np.array(values)) for key, values in found.items()}

    def _codes(self, codes: Codes) -> dict[str, Any]:
        described = {"name": codes.name, "label": codes.label, "meanings": codes.meanings}
        return described | self._column(pack(codes.codes))

    def _column(self, column: Column) -> dict[str, Any]:
        self._sections.append(column.data)
        return {
            "shape": column.shape,
            "order": column.order,
            "bytes": column.bytes,
            "section": len(self._sections) - 1,
        }

    def _packed(self, packed: Packed) -> dict[str, Any]:
        return self._column(packed.column) | {"low": packed.low, "step": packed.step}


class _Frame:
    """The page's own coordinates: the origin is the middle of the box of all, the unit its longest side."""

    def __init__(self, low: NDArray[np.float64], high: NDArray[np.float64]) -> None:
        self.middle = 0.5 * (low + high)
        self.size = float((high - low).max()) or 1.0
        self.halves = 0.5 * (high - low) / self.size

    def inside(self, point: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray((point - self.middle) / self.size)

    def described(self) -> dict[str, Any]:
        return {"middle": self.middle.tolist(), "size": self.size, "halves": _rounded(self.halves)}


def _corners(
    points: NDArray[np.float64], bodies: Bodies, extra: Sequence[NDArray[np.float64]]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    seen = [p.reshape(-1, 3) for p in (points, bodies.x[bodies.present], *extra) if p.size]
    if not seen:
        return box(None, bodies)
    low, high = np.min([p.min(axis=0) for p in seen], axis=0), np.max([p.max(axis=0) for p in seen], axis=0)
    return low, high


def _tells(codes: Codes) -> bool:
    """Whether any body has a name, as the reason of a failure has where none failed."""
    return any(codes.meanings[k] for k in np.unique(codes.codes).tolist() if k < len(codes.meanings))


@cache
def _text(name: str) -> str:
    return (_FOLDER / name).read_text(encoding="utf-8")


def _script() -> str:
    return _text("bundle.js")


def _hash(text: str) -> str:
    return f"sha256-{base64.b64encode(hashlib.sha256(text.encode('utf-8')).digest()).decode('ascii')}"


def _rounded(values: NDArray[np.float64]) -> list[float]:
    return [float(f"{value:.12g}") for value in values.tolist()]
