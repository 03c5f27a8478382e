"""Image flow of a plane no-slip wall near a particle, and the hindrance of its motion.

A wall reflects the disturbance flow of a particle as the flow of an image behind it (Blake 1971). At the
particle's centre, at the distance h, the image of its stresslet S gives a velocity, the lift, and a velocity
gradient that deforms and rotates the particle:

    v = −3/(64π μ h²) [2 S·n + S_nn n],                        n the unit normal into the fluid, S_nn = n·S·n,
    l = 3/(128π μ h³) [2 S + 6 n S·n + 2 S·n n + S_nn (n n − 3 I)].

Both are added to those of the undisturbed flow. The images of several walls are summed.

S is Batchelor's (1970) stresslet, without trace, S₁₂ > 0 in shear. The size of the body enters at the next
order in 1/h: the stresslet is distributed over the body, S_jk (1 + ⅒ C:∇∇) ∂_k G_ij, and the body moves with
(1 + ⅙ C:∇∇) u (Kim & Karrila 1991).

The images belong to a flow that is linear over the body. Over a no-slip wall a flow u_n turns away, or
along, as the square of the distance; :func:`stagnation_factor` and :func:`curvature_factor` are the share of
this part in the velocity of a sphere. They and :func:`strain_factor` are fits of our own exact solutions in
bispherical coordinates (``tools/validation/references/near_wall.py``), with e = R/h. Common arguments:

S
    Stresslet, N m, symmetric.
C
    Shape tensor Σ a_i² e_i e_i = R² F Fᵀ of the semi-axes a_i, m²; 0 leaves the point stresslet.
n, h
    Unit normal of the wall into the fluid, and the distance of the centre from the wall, m.
mu
    Viscosity of the fluid, Pa s.
k
    Principal resistances of the body without walls (:mod:`foamprb.body.drag`), m; 6πR for a sphere.
"""

from __future__ import annotations

from math import pi

import numpy as np

from foamprb.body.tensor import Scalar, Tensor, Vector, ddot, dot_vector, inner, trace

_IN_CONTACT = 1.0 - 1e-12


def stresslet_velocity(S: Tensor, C: Tensor, n: Vector, h: Scalar, mu: Scalar) -> Vector:
    """Return the velocity of the image of the stresslet at the particle's centre, m/s.

    With a² = ⅓ tr C, v = v₁/(h² + a²) + v₂/(h² + a²)² has the expansion v₁/h² + (v₂ − a² v₁)/h⁴ of Blake's
    image in 1/h, and stays bounded near the wall:

        π μ v₁ = −3/64 [2 S·n + S_nn n],
        640 π μ (v₂ − a² v₁) = P·[24 C·S·n − 6 S·C·n + (20 tr C − 30 C_nn) S·n − 15 S_nn C·n]
                               + [(50 tr C − 60 C_nn) S_nn − 20 C:S] n,       P = I − n n.

    The part along the wall is multiplied by :func:`slip_factor` of the body's reach over h, the part across
    it by :func:`strain_factor`. For bodies in shear the lift is within 1 % of the Stokes flow around the body
    for h ≥ 3R and within 10 % at 1.3R, if S is that of the flow including the wall's gradient.
    """
    s, c = dot_vector(S, n), dot_vector(C, n)
    S_nn, C_nn, tr = inner(s, n), inner(c, n), trace(C)
    Cs, Sc = dot_vector(C, s), dot_vector(S, c)
    p, q = 20.0 * tr - 30.0 * C_nn, -15.0 * S_nn
    along = (
        24.0 * Cs[0] - 6.0 * Sc[0] + p * s[0] + q * c[0],
        24.0 * Cs[1] - 6.0 * Sc[1] + p * s[1] + q * c[1],
        24.0 * Cs[2] - 6.0 * Sc[2] + p * s[2] + q * c[2],
    )
    a2 = tr * (1.0 / 3.0)
    d = 1.0 / (h * h + a2)
    k = d * d / (640.0 * pi * mu)
    # −3/64 [2 s + S_nn n] (h² + a²), and the same times a² from v₂, over (h² + a²)².
    x = -60.0 * (h * h + 2.0 * a2)
    e = np.sqrt(C_nn) / h
    across = strain_factor(e) * k * ((50.0 * tr - 60.0 * C_nn + 1.5 * x) * S_nn - 20.0 * ddot(C, S))
    f = k * slip_factor(e)
    y = across - f * (inner(along, n) + x * S_nn)
    return (
        f * (along[0] + x * s[0]) + y * n[0],
        f * (along[1] + x * s[1]) + y * n[1],
        f * (along[2] + x * s[2]) + y * n[2],
    )


def slip_factor(e: Scalar) -> Scalar:
    """Return the factor of the slip along a wall by its image of the stresslet: 1 for e → 0.

    A rigid sphere free of force and torque in shear over a wall moves with

        U/(γ̇ h) = 1/[1 + k (−ln(1 − e) − Σ₁⁶ eⁿ/n) + 5e³/16 − e⁵/4 + 25e⁶/64 − 0.0386e⁷ − 0.2555e⁹ + 0.2896e¹¹
                   − 0.1291e¹³],            e = R/h, k = 0.2691,

    exact far from the wall and in contact, where U vanishes, and within 0.1 % of the exact solution
    (Goldman, Cox & Brenner 1967) elsewhere. The factor is the slip 1 − U/(γ̇ h) over that
    of :func:`stresslet_velocity` without the factor, with two reflections of the stresslet.
    """
    # Below 0.05 the differences are inaccurate, and the factor is 1 − O(e⁴) within 10⁻⁵.
    far = np.minimum(20.0 * e, 1.0)
    e = np.minimum(np.maximum(e, 0.05), _IN_CONTACT)
    x, lag = e * e, _lag(e)
    d = 1.0 / (1.0 + x)
    q = reflected_share(e)
    image = e * x * d * (0.3125 + 0.0625 * x * d) * (1.0 + q * (0.75 + 0.5625 * q))
    return 1.0 + far * far * far * far * (lag / ((1.0 + lag) * image) - 1.0)


def _lag(e: Scalar) -> Scalar:
    """Return γ̇ h/U − 1 of :func:`slip_factor`."""
    x, cube = e * e, e * e * e
    series = e * (1.0 + e * (1.0 / 2.0 + e * (1.0 / 3.0 + e * (1.0 / 4.0 + e * (1.0 / 5.0 + e / 6.0)))))
    odd = 0.0386 + x * (0.2555 - x * (0.2896 - 0.1291 * x))
    tail = 0.3125 + x * (e * (0.390625 - e * odd) - 0.25)
    return cube * tail - 0.2691 * (np.log(1.0 - e) + series)


def reflected_share(e: Scalar) -> Scalar:
    """Return the share of the strain along n of a sphere's stresslet that its image sends back."""
    y = 1.0 + e * e * (2.0 / 3.0)
    return 1.25 * e * e * e / (y * np.sqrt(y))


def strain_factor(e: Scalar) -> Scalar:
    """Return the factor of the velocity across a wall by the image of the stresslet: 1 for e → 0.

    The exact velocity of a sphere whose surface strains over that of :func:`stresslet_velocity` without the
    factor, with two reflections of the stresslet; within 0.1 %.
    """
    e = np.minimum(e, _IN_CONTACT)
    x = e * e
    return 1.0 - x * x * (0.377 + e * (0.016 - e * (2.173 - 1.6706 * e)) + 0.7753 * _log_of_gap(e))


def stagnation_factor(e: Scalar, gain: Scalar) -> Scalar:
    """Return Q for u_n, the velocity of the flow across a wall at the body's centre.

    A rigid sphere free of force moves with u_n (1 − 2 e g + Q), g R E_nn being its velocity by the image of
    its stresslet, which is ``gain`` times that without walls (:func:`strain_factor`). Q is e²/3 (Faxén) for
    e → 0 and 1 in contact, where it stops. Its velocity (Goren & O'Neill 1971) is m_⊥ u_n times a series in
    e, within 0.4 %.
    """
    e = np.minimum(e, _IN_CONTACT)
    near = e * (2.66 - e * (2.7135 - e * (1.3581 - 0.2754 * e)))
    speed = normal_mobility(e) * (1.0 + e * (1.125 + e * (1.597 - e * (0.5372 + e * (0.9846 - near)))))
    g = 0.9375 * e * e / (1.0 + e * e) * gain * strain_factor(e)
    return speed - 1.0 + 2.0 * e * g


def curvature_factor(e: Scalar) -> Scalar:
    """Return Q for ½ h² n·∇∇u·n, the flow along a wall that is quadratic in the distance.

    A rigid sphere free of force and torque moves with ½ h² n·∇∇u·n (1 − 2 s + Q), s = 1 − U/(γ̇ h) being its
    slip in shear (:func:`slip_factor`). Q is e²/3 (Faxén) for e → 0 and 1 in contact; within 0.1 %.
    """
    e = np.minimum(e, _IN_CONTACT)
    x = e * e
    tail = 0.0275 - e * (0.7001 - 0.5014 * e) + 0.1954 * _log_of_gap(e)
    return 1.0 - (1.0 - x / 3.0 + x * e * (0.3125 + e * tail)) / (1.0 + _lag(e))


def _log_of_gap(e: Scalar) -> Scalar:
    return (1.0 - e) * -np.log(1.0 - e)


def stresslet_gradient(S: Tensor, C: Tensor, n: Vector, h: Scalar, mu: Scalar) -> Tensor:
    """Return the velocity gradient ∂u_i/∂x_j of the image of the stresslet at the particle's centre, 1/s.

    That of the point stresslet, with (h² + ⅔ a²)^{3/2} instead of h³, a² = ⅓ tr C: for a sphere the next
    order in 1/h is −(0.8 … 1.2) a²/h² of the first, by component.
    """
    s = dot_vector(S, n)
    S_nn = inner(s, n)
    d = 1.0 / (h * h + trace(C) * (2.0 / 9.0))
    k = d * np.sqrt(d) * (3.0 / (128.0 * pi * mu))
    x = (6.0 * n[0], 6.0 * n[1], 6.0 * n[2])
    y = (2.0 * s[0] + S_nn * n[0], 2.0 * s[1] + S_nn * n[1], 2.0 * s[2] + S_nn * n[2])
    sphere = -3.0 * S_nn
    return (
        k * (2.0 * S[0] + x[0] * s[0] + y[0] * n[0] + sphere),
        k * (2.0 * S[1] + x[0] * s[1] + y[0] * n[1]),
        k * (2.0 * S[2] + x[0] * s[2] + y[0] * n[2]),
        k * (2.0 * S[3] + x[1] * s[0] + y[1] * n[0]),
        k * (2.0 * S[4] + x[1] * s[1] + y[1] * n[1] + sphere),
        k * (2.0 * S[5] + x[1] * s[2] + y[1] * n[2]),
        k * (2.0 * S[6] + x[2] * s[0] + y[2] * n[0]),
        k * (2.0 * S[7] + x[2] * s[1] + y[2] * n[1]),
        k * (2.0 * S[8] + x[2] * s[2] + y[2] * n[2] + sphere),
    )


def force_gradient(f: Vector, C: Tensor, n: Vector, h: Scalar, mu: Scalar) -> Tensor:
    """Return the velocity gradient ∂u_i/∂x_j of the image of a force f at the particle's centre, 1/s.

    3/(64π μ h²) [f n + n f + f_n (n n − I)], without spin: the adjoint of the far :func:`stresslet_velocity`.
    The body's size enters by h² + a² instead of h²: for a sphere the next order in 1/h is −0.8 a²/h² of the
    first along the wall, and −a²/h² across. The image's velocity is in :func:`hindrance`. The particle exerts
    f on the fluid, N: the sum of the forces on it less its inertia.
    """
    k = 3.0 / (64.0 * pi * mu * (h * h + trace(C) * (1.0 / 3.0)))
    f_n = inner(f, n)
    p, q, r = k * n[0], k * n[1], k * n[2]
    g = (f[0] + 0.5 * f_n * n[0], f[1] + 0.5 * f_n * n[1], f[2] + 0.5 * f_n * n[2])
    xy, xz, yz = p * g[1] + q * g[0], p * g[2] + r * g[0], q * g[2] + r * g[1]
    sphere = k * f_n
    return (
        2.0 * p * g[0] - sphere, xy, xz,
        xy, 2.0 * q * g[1] - sphere, yz,
        xz, yz, 2.0 * r * g[2] - sphere,
    )  # fmt: skip


def parallel_mobility(e: Scalar) -> Scalar:
    """Return the relative mobility of a sphere along a wall, free to roll, for e = R/h.

    1/(1 − ½ ln(1 − e) + e/16 + 17e²/256 − 0.1137e³ + 0.0559e⁴), h the distance of the centre: Faxén's (1923)
    series to the order e³, and the exact solution (Goldman, Cox & Brenner 1967) within 0.4 % for any e < 1.
    In contact, where the sphere rolls with a fourth of its speed, it vanishes as 2/ln(h/(h − R)).
    """
    near = e * (0.0625 + e * (0.06640625 - e * (0.1137 - 0.0559 * e)))
    return 1.0 / (1.0 - 0.5 * np.log(1.0 - e) + near)


def normal_mobility(e: Scalar) -> Scalar:
    """Return the relative mobility of a sphere across a wall, for e = R/h.

    1 − 9e/8 + e³/2 − 57e⁴/100 + e⁵/5 + 7e¹¹/200 − e¹²/25 (Schäffer, Nørrelykke & Howard 2007), within 0.4 %
    of Brenner's (1961) series. Far from the wall it is Lorentz's, in contact the gap over R.
    """
    cube = e * e * e
    tail = cube * cube * cube * e * e * (0.035 - 0.04 * e)
    return 1.0 - 1.125 * e + cube * (0.5 - e * (0.57 - 0.2 * e)) + tail


def hindrance(k: Vector, n: Vector, h: Scalar, gap: Scalar) -> Tensor:
    """Return the resistance added by a wall over that without walls, (1/m_∥ − 1)(I − n n) + (1/m_⊥ − 1) n n.

    The mobilities m_∥, m_⊥ are those of spheres at the gap g h/(g + R_K). Their radii R_K correspond to the
    body's mean resistances along and across the wall. For a sphere this gap is g. Close to the wall, an
    ellipsoid with a flat side towards it is hindered more, one with a pointed end less. The tensors of
    several walls are summed (Oseen), for :func:`hindered_resistance`.

    For ellipsoids with axes in the ratios 1.3 : 1 : 0.77, 2 : 1 : 1 and 1.7 : 1.7 : 1, in any orientation, it
    is within 2 % of the Stokes flow around the body at gaps of 2R, 5 % at R and 25 % at 0.3R.

    ``n`` is in the frame of the body. ``gap`` is the clearance g between body and wall, m, above 0: at g = 0
    the motion across the wall vanishes and a particle would never touch it. The caller sets a minimum.
    """
    across = k[0] * n[0] * n[0] + k[1] * n[1] * n[1] + k[2] * n[2] * n[2]
    along = 0.5 * (k[0] + k[1] + k[2] - across)
    p = 1.0 / parallel_mobility(_nearness(along, h, gap)) - 1.0
    q = 1.0 / normal_mobility(_nearness(across, h, gap)) - 1.0 - p
    xy, xz, yz = q * n[0] * n[1], q * n[0] * n[2], q * n[1] * n[2]
    return (p + q * n[0] * n[0], xy, xz, xy, p + q * n[1] * n[1], yz, xz, yz, p + q * n[2] * n[2])


def _nearness(k: Scalar, h: Scalar, gap: Scalar) -> Scalar:
    """Return R_K/(R_K + g h/(g + R_K)) for R_K = k/6π."""
    R = k * (1.0 / (6.0 * pi))
    x = R * (gap + R)
    return x / (x + gap * h)


def hindered_resistance(k: Vector, W: Tensor) -> Tensor:
    """Return the resistance K_ab = √k_a (δ_ab + W_ab) √k_b of a body near walls, m, in its frame.

    W is the sum of :func:`hindrance` over the walls; f_D = μ_f K·(u − v). The result is exact to the order
    1/h for a sphere, and positive definite for any body and any walls.
    """
    p, q, r = np.sqrt(k[0]), np.sqrt(k[1]), np.sqrt(k[2])
    xy, xz, yz = p * q * W[1], p * r * W[2], q * r * W[5]
    return (k[0] * (1.0 + W[0]), xy, xz, xy, k[1] * (1.0 + W[4]), yz, xz, yz, k[2] * (1.0 + W[8]))
