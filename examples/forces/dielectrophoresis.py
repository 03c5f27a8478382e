"""Dielectrophoresis: a sphere that an electric field polarises moves with the gradient of its square."""

import foamprb


def dielectrophoresis(inputs, E, grad_E, epsilon, K):
    """Return 2π a³ ε Re(K) ∇|E|² over the mass; E is a root mean square, K Clausius and Mossotti's factor."""
    x, y, z = E
    g = grad_E
    c = 3.0 * epsilon * K / inputs.rho
    return (
        c * (x * g[0] + y * g[3] + z * g[6]),
        c * (x * g[1] + y * g[4] + z * g[7]),
        c * (x * g[2] + y * g[5] + z * g[8]),
    ), 0.0


foamprb.add_force("dielectrophoresis", dielectrophoresis, needs=("E", "grad(E)"))
