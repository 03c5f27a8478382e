"""Acoustic radiation: sound moves a small sphere to the nodes of its pressure, or away from them."""

import foamprb


def acoustics(inputs, grad_p2, grad_v2, kappa, f1, f2):
    """Return −∇(½ κ f₁ ⟨p²⟩ − ¾ ρ_f f₂ ⟨v²⟩) over the density (Gor'kov 1962), with the means of the sound.

    κ is the compressibility of the fluid, 1/Pa; f₁ and f₂ follow from those and the densities of both.
    """
    a, b = -0.5 * kappa * f1 / inputs.rho, 0.75 * inputs.medium.rho * f2 / inputs.rho
    (px, py, pz), (vx, vy, vz) = grad_p2, grad_v2
    return (a * px + b * vx, a * py + b * vy, a * pz + b * vz), 0.0


foamprb.add_force("acoustics", acoustics, needs=("grad(p2)", "grad(v2)"))
