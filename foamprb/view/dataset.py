"""Results of a run as an ``xarray.Dataset`` whose values are read when they are used."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from foamprb import optional
from foamprb.results.vtk import PointCloud

if TYPE_CHECKING:
    import xarray

__all__ = ["lazy_dataset"]

_POINTS = {"x": 0, "y": 1, "z": 2}
_ID = "origId"


def lazy_dataset(
    times: NDArray[np.float64], read: Callable[[int, Sequence[str] | None], PointCloud], source: str
) -> xarray.Dataset:
    """Return arrays over ``time`` and ``particle``, whose values are read when they are used.

    Parameters
    ----------
    times
        Times, s; particles of the last one include those of all others.
    read
        Returns the cloud at the time of an index with some of its arrays, None for all.
    source
        What wrote them.

    Raises
    ------
    InputError
        If xarray is not installed.
    """
    xr, backends, indexing = (
        optional.load(name, "xarray", "to_xarray needs")
        for name in ("xarray", "xarray.backends", "xarray.core.indexing")
    )
    last = read(-1, None)
    n = int(last.arrays[_ID].max(initial=-1)) + 1

    class Values(backends.BackendArray):  # type: ignore[misc, name-defined]
        """Values of one array, (times, particles) or (times, particles, components)."""

        def __init__(self, name: str, sample: NDArray[Any]) -> None:
            self.name, self.fill = name, np.nan if sample.dtype.kind == "f" else -1
            self.shape, self.dtype = (len(times), n, *sample.shape[1:]), sample.dtype

        def __getitem__(self, key: Any) -> Any:
            support = indexing.IndexingSupport.OUTER
            return indexing.explicit_indexing_adapter(key, self.shape, support, self.part)

        def part(self, key: tuple[Any, ...]) -> NDArray[Any]:
            chosen = np.arange(len(times))[key[0]]
            if np.size(chosen) == 0:
                return np.empty((0, *self.shape[1:]), self.dtype)[:, key[1]][(..., *key[2:])]
            # No time is kept whole: of many times few particles may be wanted.
            rows = [self.at(int(index))[key[1]][(..., *key[2:])] for index in np.atleast_1d(chosen)]
            return np.stack(rows) if np.ndim(chosen) else np.asarray(rows[0])

        def at(self, index: int) -> NDArray[Any]:
            cloud = read(index, (_ID,) if self.name in _POINTS else (_ID, self.name))
            values = np.full(self.shape[1:], self.fill, self.dtype)
            values[cloud.arrays[_ID]] = _samples(cloud)[self.name]
            return values

    variables = {}
    for name, sample in _samples(last).items():
        dims = ("time", "particle", *(f"{name}_component" for _ in sample.shape[1:]))
        values = indexing.LazilyIndexedArray(Values(name, sample))
        variables[name] = xr.Variable(dims, values, _attributes(last.units, last.names, name))
    number = {"cf_role": "trajectory_id", "long_name": "number of the particle"}
    coordinates = {
        "time": ("time", times, {"units": "s", "long_name": "time", "axis": "T"}),
        "particle": ("particle", np.arange(n), number),
    }
    return xr.Dataset(
        variables, coordinates, {"Conventions": "CF-1.11", "featureType": "trajectory", "source": source}
    )


def _samples(cloud: PointCloud) -> dict[str, NDArray[Any]]:
    """Return the coordinates and the arrays of a cloud by name, without the numbers of the particles."""
    found = {name: cloud.points[:, k] for name, k in _POINTS.items()}
    return found | {name: array for name, array in cloud.arrays.items() if name != _ID}


def _attributes(units: Mapping[str, str], names: Mapping[str, Sequence[str]], name: str) -> dict[str, Any]:
    """Return the attributes of a variable, as the CF conventions name them."""
    if name in _POINTS:
        return {"units": "m", "long_name": f"{name} of the centre", "axis": name.upper()}
    found: dict[str, Any] = {"units": units.get(name) or "1", "coordinates": "x y z"}
    if name in names:
        # Blanks separate the meanings.
        meanings = ["_".join(meaning.split()) or "none" for meaning in names[name]]
        found |= {"flag_values": np.arange(len(meanings)), "flag_meanings": " ".join(meanings)}
    return found
