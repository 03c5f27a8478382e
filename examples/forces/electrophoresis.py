"""Electrophoresis: a field carries charged particles through the fluid."""

import foamprb


def electrophoresis(vx=0.0, vy=0.0, vz=0.0):
    """Return the velocity of a particle relative to the fluid, m/s."""
    return vx, vy, vz


foamprb.add_surrounding("electrophoresis", electrophoresis)
