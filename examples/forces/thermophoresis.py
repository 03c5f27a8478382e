"""Thermophoresis: a sphere in a gas moves to where it is colder."""

import math

import foamprb


def thermophoresis(inputs, T, grad_T, mu, k):
    """Return −9π μ² a ∇T/(ρ_f T (2 + k)) over the mass (Epstein 1929); k: ratio of the conductivities."""
    mass = 4.0 / 3.0 * math.pi * inputs.R * inputs.R * inputs.R * inputs.rho
    c = -9.0 * math.pi * mu * mu * inputs.R / (inputs.medium.rho * T * (2.0 + k)) / mass
    return (c * grad_T[0], c * grad_T[1], c * grad_T[2]), 0.0


foamprb.add_force("thermophoresis", thermophoresis, needs=("T", "grad(T)", "mu"))
