"""Results of a run as an ``xarray.Dataset``."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from foamprb import optional
from foamprb.results.vtk import PointCloud

if TYPE_CHECKING:
    import xarray

_POINTS = {"x": 0, "y": 1, "z": 2}
_ID = "origId"


def dataset_of(times: NDArray[np.float64], read: Callable[[int], PointCloud], source: str) -> xarray.Dataset:
    """Return arrays over ``time`` and ``particle``.

    Parameters
    ----------
    times
        Times, s; each has at most the particles of the last one.
    read
        Returns the cloud at the time of an index.
    source
        What wrote them.
    """
    xr, last = optional.load("xarray", "xarray", "to_xarray needs"), read(-1)
    n = int(last.arrays[_ID].max(initial=-1)) + 1
    variables = {}
    for name, sample in _samples(last).items():
        fill = np.nan if sample.dtype.kind == "f" else -1
        values = np.full((len(times), n, *sample.shape[1:]), fill, sample.dtype)
        dims = ("time", "particle", *(f"{name}_component" for _ in sample.shape[1:]))
        variables[name] = (dims, values, _attributes(last.units, last.names, name))
    for index in range(len(times)):
        cloud = read(index)
        for name, samples in _samples(cloud).items():
            variables[name][1][index, cloud.arrays[_ID]] = samples
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
    coordinates = {name: cloud.points[:, k] for name, k in _POINTS.items()}
    return coordinates | {name: array for name, array in cloud.arrays.items() if name != _ID}


def _attributes(units: Mapping[str, str], names: Mapping[str, Sequence[str]], name: str) -> dict[str, Any]:
    """Return the attributes of a variable, as the CF conventions name them."""
    if name in _POINTS:
        return {"units": "m", "long_name": f"{name} of the centre", "axis": name.upper()}
    attributes: dict[str, Any] = {"units": units.get(name) or "1", "coordinates": "x y z"}
    if name in names:
        # Blanks separate the meanings.
        meanings = ["_".join(meaning.split()) or "none" for meaning in names[name]]
        attributes |= {"flag_values": np.arange(len(meanings)), "flag_meanings": " ".join(meanings)}
    return attributes
