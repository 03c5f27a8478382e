"""Viscosity of the fluid at the nodes, from a field of a case."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.read.boundary import CaseMesh
from foamprb.flow.read.field import FoamField, Kind
from foamprb.flow.read.fluid import FRACTION_FIELD, ViscosityField
from foamprb.flow.read.turbulence import given_values, values_of
from foamprb.flow.reconstruct import Reconstruction


def read_viscosity_field(
    read: Callable[[str, Kind], FoamField],
    source: ViscosityField,
    whole: CaseMesh,
    reconstruct: Reconstruction,
) -> Floats:
    """Read a field of the viscosity, or one that gives it, and reconstruct it.

    Parameters
    ----------
    read
        Reads the field of a name and a kind.
    source
        The field.
    whole, reconstruct
        Mesh of the case, and its reconstruction.

    Returns
    -------
    (n_nodes, 4): the viscosity, m²/s if the field is kinematic, else Pa s, and its gradient. Of a volume
    fraction, itself.
    """
    field = read(source.name, source.kind)
    if source.kind == FRACTION_FIELD:
        # Solvers leave the range by round-off and more.
        return reconstruct.scalar(*(values[:, 0].clip(0.0, 1.0) for values in given_values(field, whole)))
    cells, boundary = values_of(field, whole)
    if source.law is not None:
        cells, boundary = source.law(cells), source.law(boundary)
    if not cells.min() > 0.0:
        cell = int(cells.argmin())
        raise InputError(
            f"{field.path}: the viscosity at cell {cell} is {cells[cell]:g}. Allowed: numbers > 0."
        )
    # A value of 0 on a patch is a placeholder.
    boundary = np.where(boundary > 0.0, boundary, cells[whole.mesh.owner[whole.mesh.n_internal :]])
    return reconstruct.scalar(cells, boundary)
