"""Fields of a case at the nodes that are sampled along paths."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from foamprb.dictionary.dimensions import unit_text
from foamprb.errors import InputError, suggestion
from foamprb.flow.base import Floats
from foamprb.flow.fields import FieldColumns, field_of
from foamprb.flow.read.boundary import CaseMesh
from foamprb.flow.read.field import FoamField, Kind
from foamprb.flow.read.turbulence import given_values
from foamprb.flow.reconstruct import Reconstruction

_KINDS = {
    name: Kind(name, inner, (), "a field that is sampled")
    for name, inner in (
        ("volScalarField", "scalar"),
        ("volVectorField", "vector"),
        ("volSymmTensorField", "symmTensor"),
        ("volTensorField", "tensor"),
    )
}
_WHOLE = np.array([0, 1, 2, 1, 3, 4, 2, 4, 5])
"""Component of OpenFOAM's symmetric tensors, xx xy xz yy yz zz, for each of the nine of a tensor."""
_SIX = np.array([0, 4, 8, 1, 5, 2])
"""Components xx yy zz xy yz xz of a tensor."""


def kinds_of(
    names: Sequence[str], classes: Callable[[str], Mapping[str, str]], times: Sequence[str]
) -> list[Kind]:
    """Return the kinds of fields by their names.

    Parameters
    ----------
    names
        The fields.
    classes
        Returns the classes of the fields at a time, by name.
    times
        The times at which they are read.

    Raises
    ------
    InputError
        A field is missing at a time, or has no value for each cell.
    """
    kinds: list[Kind] = []
    for time in times if names else ():
        at_time = classes(time)
        for name in map(field_of, names):
            kind = _KINDS.get(at_time.get(name, ""))
            if kind is None:
                others = [other for other, word in at_time.items() if word in _KINDS]
                what = f"no field {name}" if name not in at_time else f"{name} is a {at_time[name]}, which"
                where = f"at time {time}" if name not in at_time else f"is not sampled (time {time})"
                raise InputError(
                    f"fieldSampling and forces read fields, but there is {what} {where}. "
                    f"{suggestion(name, others)}"
                )
            kinds.append(kind)
    for name, kind in zip(names, kinds, strict=False):
        if name != field_of(name) and kind.inner not in ("scalar", "vector"):
            raise InputError(f"{name} is needed by a force, but {field_of(name)} is no scalar and no vector.")
    return kinds[: len(names)]


def read_sampled(
    read: Callable[[str, Kind], FoamField],
    names: Sequence[str],
    kinds: Sequence[Kind],
    whole: CaseMesh,
    reconstruct: Reconstruction,
) -> tuple[Floats, tuple[FieldColumns, ...]]:
    """Return fields at the nodes, (n_nodes, columns of all), and their columns.

    Parameters
    ----------
    read
        Reads the field of a name and a kind.
    names, kinds
        The fields, or ``grad(E)`` for the gradient of E, and the results of :func:`kinds_of`.
    whole, reconstruct
        Mesh of the case, and its reconstruction.
    """
    tables, columns = [], []
    for name, kind in zip(names, kinds, strict=True):
        field = read(field_of(name), kind)
        cells, boundary = (_tensors(values, kind) for values in given_values(field, whole))
        dimensions = np.array(field.dimensions)
        if name != field_of(name):
            at_nodes = reconstruct.gradient(cells, boundary).reshape(-1, 3 * cells[0].size)
            dimensions[1] -= 1
        else:
            at_nodes = reconstruct.linear(cells, boundary).reshape(-1, cells[0].size)
        if cells.ndim == 1 and name == field_of(name):
            # Beside a front the extrapolation to a wall would go below zero, or above a fraction of one.
            given = np.concatenate([cells, boundary])
            at_nodes = at_nodes.clip(given.min(), given.max())
        table = at_nodes[:, _SIX] if kind.inner == "symmTensor" else at_nodes
        tables.append(table)
        columns.append(FieldColumns(name, table.shape[1], unit_text(tuple(dimensions))))
    return np.concatenate(tables, axis=1), tuple(columns)


def _tensors(values: Floats, kind: Kind) -> Floats:
    """Return values (n, components) as scalars (n,), vectors (n, 3) or tensors (n, 3, 3)."""
    if kind.inner == "symmTensor":
        values = values[:, _WHOLE]
    return values.reshape(len(values), *{1: (), 3: (3,), 9: (3, 3)}[values.shape[1]])
