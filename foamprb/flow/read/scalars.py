"""Scalar fields of a case at the nodes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from foamprb.errors import InputError, suggestion
from foamprb.flow.base import Floats
from foamprb.flow.read.boundary import CaseMesh
from foamprb.flow.read.field import FoamField, Kind
from foamprb.flow.read.turbulence import values_of
from foamprb.flow.reconstruct import Reconstruction

__all__ = ["read_scalars"]

_SCALAR = Kind("volScalarField", "scalar", (), "a field that is sampled")


def read_scalars(
    classes: Mapping[str, str],
    read: Callable[[str, Kind], FoamField],
    names: Sequence[str],
    whole: CaseMesh,
    reconstruct: Reconstruction,
) -> dict[str, Floats]:
    """Return scalar fields by name, each at the nodes, (n_nodes, 4): its value and gradient.

    Parameters
    ----------
    classes
        Classes of the fields that there are, by name.
    read
        Reads the field of a name and a kind.
    names
        The fields.
    whole, reconstruct
        Mesh of the case, and its reconstruction.

    Raises
    ------
    InputError
        A field is missing, broken or no scalar.
    """
    found = {}
    for name in names:
        if name not in classes:
            scalars = [other for other, kind in classes.items() if kind == _SCALAR.name]
            raise InputError(
                f"fieldSampling: no field {name} at the time of the flow. {suggestion(name, scalars)}"
            )
        cells, boundary = values_of(read(name, _SCALAR), whole, signed=True)
        found[name] = reconstruct.scalar(cells, boundary, linear=True)
    return found
