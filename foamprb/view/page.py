"""Scene as one HTML file that needs no network, no other file and no installation."""

from __future__ import annotations

import base64
import hashlib
import html
import json
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from foamprb.view import encode
from foamprb.view.bodies import Codes
from foamprb.view.colours import DARK, LIGHT, MAPS, colour_map
from foamprb.view.encode import Column, Grid
from foamprb.view.flowfield import QUANTITIES, STREAM_OPACITY, FlowField
from foamprb.view.geometry import Surface
from foamprb.view.scene import (
    INSETS,
    MARGIN,
    MOST_TRAILS,
    PERCENTILES,
    SCALE_BAR,
    TALL,
    VIEW_ANGLE,
    Camera,
    Scene,
    anchor,
    extremes_of,
    limits_of,
)

_FOLDER = Path(__file__).parent / "page"


class Page:
    """Packed parts of a page; :meth:`parts` yields the text of the file.

    ``size`` is the number of bytes.

    Parameters
    ----------
    scene
        Scene with all its arrays.
    version
        Version of foamprb.
    notes
        Sentences about omissions, which the page shows.
    """

    def __init__(self, scene: Scene, version: str, notes: Sequence[str] = ()) -> None:
        self._notes = list(notes)
        self._sections: list[str] = []
        self._version = version
        self.scene = scene
        bodies, geometry = scene.bodies, scene.geometry
        shown = [geometry.points] if geometry is not None else []
        shown += [bodies.x[bodies.present], scene.edges]
        shown += [scene.paths.points] if scene.paths is not None else []
        low, high = encode.bounds(*shown)
        # The coordinates of the page: the origin is the middle of the box, the unit its longest side.
        self._middle, self._size = 0.5 * (low + high), float((high - low).max()) or 1.0
        grid = encode.grid_of(*shown)
        self._header = self._described(0.5 * (high - low)) | self._bodies(grid)
        self._header |= self._surroundings(grid)
        names = sorted(bodies.fields, key=lambda name: name != scene.colour[0])
        self._header["fields"] = {
            name: self._field(name, encode.pack_field(bodies.fields[name])) for name in names
        }
        self.size = sum(len(part.encode()) for part in self.parts())

    def parts(self) -> Iterator[str]:
        """Yield the text of the file, piece by piece."""
        notes = {"notes": self._notes}
        header = json.dumps(self._header | notes, ensure_ascii=False, separators=(",", ":"))
        script, style = _text("bundle.js"), _text("page.css")
        texts = {
            "policy": _policy([script], [style]),
            "version": self._version,
            "title": html.escape(f"{self.scene.title} – {self.scene.subtitle}"),
            "made": html.escape(str(self._header["made"])),
            "style": style,
            "licence": html.escape("\n".join(map(_text, ("LICENSE.three", "LICENSE.uplot"))), quote=False),
            # Only this character could end a script element.
            "scene": header.replace("<", "\\u003c"),
            "script": script,
        }
        for piece in _filled("page.html", texts | {"sections": None}):
            if piece is not None:
                yield piece
                continue
            for k, data in enumerate(self._sections):
                yield f'<script type="text/plain" id="section-{k}">{data}</script>\n'

    def _described(self, halves: NDArray[np.float64]) -> dict[str, object]:
        scene = self.scene
        return {
            "title": scene.title,
            "subtitle": scene.subtitle,
            "groups": scene.groups,
            "made": f"Made by foamprb {self._version}: {scene.subtitle} of the case {scene.title}.",
            "frame": {
                "middle": self._middle.tolist(),
                "size": self._size,
                "halves": _rounded(halves / self._size),
            },
            "times": _rounded(scene.bodies.times),
            "home": self._camera(scene.camera),
            "enlargement": scene.enlargement,
            "trail": scene.trail,
            "mostTrails": MOST_TRAILS,
            "colour": list(scene.colour),
            "range": None if scene.range is None else list(scene.range),
            "first": scene.first,
            "directions": {name: _rounded(vector) for name, vector in scene.directions.items()},
            "scaleBar": SCALE_BAR,
            "maps": {name: colour_map(name).tobytes().hex() for name in MAPS},
            "planeMaps": {"light": LIGHT.plane.tobytes().hex(), "dark": DARK.plane.tobytes().hex()},
        }

    def _camera(self, camera: Camera) -> dict[str, object]:
        return {
            "focus": self._inside(camera.focus),
            "towards": _rounded(camera.towards),
            "up": _rounded(camera.up),
            "corners": [_rounded(corner / self._size) for corner in camera.corners],
            # JSON has no infinity.
            "leastWidth": min(camera.least_width / self._size, 1e9),
            "angle": VIEW_ANGLE,
            "margin": MARGIN,
            "tall": TALL,
            "insets": INSETS,
        }

    def _bodies(self, grid: Grid) -> dict[str, object]:
        bodies, colour = self.scene.bodies, self.scene.colour[0]
        useful = {name: code for name, code in bodies.codes.items() if _has_names(code) or name == colour}
        codes = {"status": bodies.status} | useful | {"fate": self.scene.fate}
        return {
            "bodies": {
                "ids": self._add(encode.pack(bodies.ids)),
                "places": self._add(encode.pack_points(bodies.x, grid)),
                "shapes": self._add(encode.pack_shapes(bodies)),
                "present": self._add(encode.pack_bits(bodies.present)),
                "radius": self._add(encode.pack_values(bodies.radius)),
                "modes": None if bodies.B is None else self._add(encode.pack_modes(bodies.B)),
            },
            "codes": {
                name: {"name": code.name, "label": code.label, "meanings": code.meanings}
                | self._add(encode.pack(code.codes))
                for name, code in codes.items()
            },
        }

    def _surroundings(self, grid: Grid) -> dict[str, object]:
        scene, geometry = self.scene, self.scene.geometry
        surfaces = geometry.surfaces if geometry is not None else ()
        return {
            "surfaces": [self._surface(surface, grid) for surface in surfaces],
            "deposits": scene.scale_of_deposits,
            "edges": self._add(encode.pack_points(scene.edges.reshape(-1, 3), grid)),
            "flow": None if scene.flowfield is None else self._flow(scene.flowfield, grid),
            "paths": self._paths(grid),
        }

    def _surface(self, surface: Surface, grid: Grid) -> dict[str, object]:
        density = surface.density
        shares = None if density is None else np.clip(density / self.scene.most_dense, 0.0, 1.0)
        return {
            "name": surface.name,
            "type": surface.type,
            "anchor": self._inside(anchor(surface, self.scene.camera)),
            "points": self._add(encode.pack_points(surface.points, grid)),
            "triangles": self._add(encode.pack(surface.triangles)),
            "density": None if shares is None else self._add(encode.pack(np.rint(255.0 * shares))),
        }

    def _flow(self, field: FlowField, grid: Grid) -> dict[str, object]:
        volume, plane = field.grid, field.plane
        values = []
        for name, component in volume.values.items():
            label, unit = QUANTITIES[name]
            low, high = field.scales[name].limits
            described = {
                "label": label,
                "unit": unit,
                "range": [low, high],
                "extremes": field.scales[name].extremes,
            }
            share = np.clip((component - low) / ((high - low) or 1.0), 0.0, 1.0)
            values.append(described | self._add(encode.pack(np.rint(255.0 * share))))
        return {
            "lines": {
                "points": self._add(encode.pack_points(field.lines.points, grid)),
                "start": self._add(encode.pack(field.lines.start)),
                "opacity": STREAM_OPACITY,
            },
            "low": self._inside(volume.low),
            "high": self._inside(volume.high),
            "values": values,
            "plane": None if plane is None else [self._inside(plane[0]), _rounded(plane[1])],
        }

    def _paths(self, grid: Grid) -> dict[str, object] | None:
        paths, ids = self.scene.paths, self.scene.bodies.ids
        if paths is None or len(ids) == 0:
            return None
        numbers = paths.tracks["origId"]
        place = np.minimum(np.searchsorted(ids, numbers), len(ids) - 1)
        # Some paths belong to bodies that are not in the scene.
        place = np.where(ids[place] == numbers, place, -1)
        return {
            "bodies": self._add(encode.pack(place)),
            "start": self._add(encode.pack(paths.start)),
            "points": self._add(encode.pack_points(paths.points, grid)),
            "times": self._add(encode.pack_values(paths.values["time"])),
        }

    def _field(self, name: str, column: Column) -> dict[str, object]:
        bodies = self.scene.bodies
        field = bodies.fields[name]
        ranges = {}
        for part in field.parts:
            largest = limits_of(bodies, name, part)
            limits = {
                "usual": limits_of(bodies, name, part, PERCENTILES),
                "whole": largest,
                "extremes": extremes_of(bodies, name, part) or largest,
            }
            ranges[part] = {key: _rounded(np.array(values)) for key, values in limits.items()}
        described = {"name": name, "label": field.label, "unit": field.unit, "parts": field.parts}
        return described | {"ranges": ranges} | self._add(column)

    def _add(self, column: Column) -> dict[str, object]:
        """Add a section with the data of a column; return its description."""
        self._sections.append(column.data)
        described = {"shape": column.shape, "order": column.order, "bytes": column.bytes}
        scale = {} if column.low is None else {"low": column.low}
        scale |= {} if column.step is None else {"step": column.step}
        return described | {"section": len(self._sections) - 1} | scale

    def _inside(self, point: NDArray[np.float64]) -> list[float]:
        """Return a point, m, in the coordinates of the page."""
        return _rounded((point - self._middle) / self._size)


def _filled(template: str, texts: Mapping[str, str | None]) -> Iterator[str | None]:
    """Yield the pieces of a template, with texts instead of their names in double braces."""
    for number, piece in enumerate(re.split(r"\{\{(\w+)\}\}", _text(template))):
        yield piece if number % 2 == 0 else texts[piece]


def _policy(scripts: Sequence[str], styles: Sequence[str]) -> str:
    """Return a policy that allows these scripts and styles alone."""
    allowed = [" ".join(f"'{_hash(text)}'" for text in texts) for texts in (scripts, styles)]
    return (
        f"default-src 'none'; script-src {allowed[0]}; style-src {allowed[1]}; "
        "img-src data: blob:; connect-src 'none'; base-uri 'none'; form-action 'none'"
    )


def _has_names(codes: Codes) -> bool:
    """Return whether any body has a name; no body has a reason of failure if none failed, for example."""
    return any(codes.meanings[k] for k in np.unique(codes.codes).tolist() if k < len(codes.meanings))


@cache
def _text(name: str) -> str:
    return (_FOLDER / name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    return f"sha256-{base64.b64encode(hashlib.sha256(text.encode('utf-8')).digest()).decode('ascii')}"


def _rounded(values: NDArray[np.float64]) -> list[float]:
    return [float(f"{value:.12g}") for value in values.tolist()]
