"""Vectors and 3×3 tensors as tuples of scalars, and the principal frame of a deformation.

A vector is ``(x, y, z)``. A tensor is its nine components row by row, ``(T11, T12, T13, T21, …, T33)``. A
component is a float, or an array of any shape; every function then works elementwise. No function branches on
a value, so the same text serves one particle, a lane of a block and a reference in numpy.
"""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np

Scalar: TypeAlias = Any
"""A float, or an array of floats treated elementwise."""
Vector: TypeAlias = tuple[Scalar, Scalar, Scalar]
Tensor: TypeAlias = tuple[Scalar, Scalar, Scalar, Scalar, Scalar, Scalar, Scalar, Scalar, Scalar]

_TINY = 1e-300
_LEAST = 1e-60
_SMALL = 1e-150

ZERO: Tensor = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def select(condition: Scalar, a: Scalar, b: Scalar) -> Scalar:
    """Return ``a`` where ``condition`` holds, else ``b``; both are evaluated.

    Examples
    --------
    >>> float(select(2.0 > 1.0, 3.0, 4.0))
    3.0
    """
    return np.where(condition, a, b)


def add(S: Tensor, T: Tensor) -> Tensor:
    """Return S + T."""
    return (
        S[0] + T[0], S[1] + T[1], S[2] + T[2],
        S[3] + T[3], S[4] + T[4], S[5] + T[5],
        S[6] + T[6], S[7] + T[7], S[8] + T[8],
    )  # fmt: skip


def subtract(S: Tensor, T: Tensor) -> Tensor:
    """Return S − T."""
    return (
        S[0] - T[0], S[1] - T[1], S[2] - T[2],
        S[3] - T[3], S[4] - T[4], S[5] - T[5],
        S[6] - T[6], S[7] - T[7], S[8] - T[8],
    )  # fmt: skip


def scale(s: Scalar, T: Tensor) -> Tensor:
    """Return s T."""
    return (s * T[0], s * T[1], s * T[2], s * T[3], s * T[4], s * T[5], s * T[6], s * T[7], s * T[8])


def scale_columns(T: Tensor, v: Vector) -> Tensor:
    """Return T diag(v)."""
    x, y, z = v
    return (T[0] * x, T[1] * y, T[2] * z, T[3] * x, T[4] * y, T[5] * z, T[6] * x, T[7] * y, T[8] * z)


def add_scaled(S: Tensor, s: Scalar, T: Tensor) -> Tensor:
    """Return S + s T."""
    return add(S, scale(s, T))


def scale_vector(s: Scalar, v: Vector) -> Vector:
    """Return s v."""
    return s * v[0], s * v[1], s * v[2]


def combine_vectors(s: Scalar, u: Vector, t: Scalar, v: Vector) -> Vector:
    """Return s u + t v."""
    return s * u[0] + t * v[0], s * u[1] + t * v[1], s * u[2] + t * v[2]


def plus(v: Vector, w: Vector) -> Vector:
    """Return v + w."""
    return v[0] + w[0], v[1] + w[1], v[2] + w[2]


def plus_scaled(v: Vector, s: Scalar, w: Vector) -> Vector:
    """Return v + s w."""
    return v[0] + s * w[0], v[1] + s * w[1], v[2] + s * w[2]


def minus(v: Vector, w: Vector) -> Vector:
    """Return v − w."""
    return v[0] - w[0], v[1] - w[1], v[2] - w[2]


def between(v: Vector, w: Vector, s: Scalar) -> Vector:
    """Return v + s (w − v)."""
    return v[0] + s * (w[0] - v[0]), v[1] + s * (w[1] - v[1]), v[2] + s * (w[2] - v[2])


def inner(v: Vector, w: Vector) -> Scalar:
    """Return v·w."""
    return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]


def norm(v: Vector) -> Scalar:
    """Return |v|."""
    return np.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])


def vector_product(v: Vector, w: Vector) -> Vector:
    """Return v × w."""
    return v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]


def rows(T: Tensor) -> tuple[Vector, Vector, Vector]:
    """Return the three rows of T."""
    return (T[0], T[1], T[2]), (T[3], T[4], T[5]), (T[6], T[7], T[8])


def from_rows(p: Vector, q: Vector, r: Vector) -> Tensor:
    """Return the tensor with the rows p, q, r."""
    return (p[0], p[1], p[2], q[0], q[1], q[2], r[0], r[1], r[2])


def add_identity(T: Tensor, s: Scalar) -> Tensor:
    """Return T + s I."""
    return (T[0] + s, T[1], T[2], T[3], T[4] + s, T[5], T[6], T[7], T[8] + s)


def transpose(T: Tensor) -> Tensor:
    """Return Tᵀ."""
    return (T[0], T[3], T[6], T[1], T[4], T[7], T[2], T[5], T[8])


def trace(T: Tensor) -> Scalar:
    """Return the trace T_ii."""
    return T[0] + T[4] + T[8]


def diagonal(T: Tensor) -> Vector:
    """Return the diagonal components."""
    return T[0], T[4], T[8]


def sym(T: Tensor) -> Tensor:
    """Return the symmetric part ½(T + Tᵀ)."""
    p, q, r = 0.5 * (T[1] + T[3]), 0.5 * (T[2] + T[6]), 0.5 * (T[5] + T[7])
    return (T[0], p, q, p, T[4], r, q, r, T[8])


def skew(T: Tensor) -> Tensor:
    """Return the skew part ½(T − Tᵀ)."""
    p, q, r = 0.5 * (T[1] - T[3]), 0.5 * (T[2] - T[6]), 0.5 * (T[5] - T[7])
    return (0.0, p, q, -p, 0.0, r, -q, -r, 0.0)


def dev(T: Tensor) -> Tensor:
    """Return the deviatoric part T − ⅓ tr(T) I."""
    return add_identity(T, trace(T) * (-1.0 / 3.0))


def dot(S: Tensor, T: Tensor) -> Tensor:
    """Return the product S·T."""
    return (
        S[0] * T[0] + S[1] * T[3] + S[2] * T[6],
        S[0] * T[1] + S[1] * T[4] + S[2] * T[7],
        S[0] * T[2] + S[1] * T[5] + S[2] * T[8],
        S[3] * T[0] + S[4] * T[3] + S[5] * T[6],
        S[3] * T[1] + S[4] * T[4] + S[5] * T[7],
        S[3] * T[2] + S[4] * T[5] + S[5] * T[8],
        S[6] * T[0] + S[7] * T[3] + S[8] * T[6],
        S[6] * T[1] + S[7] * T[4] + S[8] * T[7],
        S[6] * T[2] + S[7] * T[5] + S[8] * T[8],
    )


def dot_vector(T: Tensor, v: Vector) -> Vector:
    """Return the vector T·v."""
    return (
        T[0] * v[0] + T[1] * v[1] + T[2] * v[2],
        T[3] * v[0] + T[4] * v[1] + T[5] * v[2],
        T[6] * v[0] + T[7] * v[1] + T[8] * v[2],
    )


def vector_dot(v: Vector, T: Tensor) -> Vector:
    """Return the vector Tᵀ·v."""
    return dot_vector(transpose(T), v)


def ddot(S: Tensor, T: Tensor) -> Scalar:
    """Return the double contraction S:T = S_ij T_ij."""
    return (
        S[0] * T[0] + S[1] * T[1] + S[2] * T[2]
        + S[3] * T[3] + S[4] * T[4] + S[5] * T[5]
        + S[6] * T[6] + S[7] * T[7] + S[8] * T[8]
    )  # fmt: skip


def cofactor(T: Tensor) -> Tensor:
    """Return the cofactor tensor det(T) T⁻ᵀ."""
    return (
        T[4] * T[8] - T[5] * T[7], T[5] * T[6] - T[3] * T[8], T[3] * T[7] - T[4] * T[6],
        T[2] * T[7] - T[1] * T[8], T[0] * T[8] - T[2] * T[6], T[1] * T[6] - T[0] * T[7],
        T[1] * T[5] - T[2] * T[4], T[2] * T[3] - T[0] * T[5], T[0] * T[4] - T[1] * T[3],
    )  # fmt: skip


def det(T: Tensor) -> Scalar:
    """Return the determinant of T."""
    return (
        T[0] * (T[4] * T[8] - T[5] * T[7])
        + T[1] * (T[5] * T[6] - T[3] * T[8])
        + T[2] * (T[3] * T[7] - T[4] * T[6])
    )


def inverse(T: Tensor) -> Tensor:
    """Return T⁻¹; det T ≠ 0 is the caller's responsibility."""
    C = cofactor(T)
    return scale(1.0 / (T[0] * C[0] + T[1] * C[1] + T[2] * C[2]), transpose(C))


def reciprocals(v: Vector) -> Vector:
    """Return (1/x, 1/y, 1/z) by one division; x y z must neither overflow nor underflow."""
    x, y, z = v
    d = 1.0 / (x * y * z)
    return d * (y * z), d * (x * z), d * (x * y)


def axial(W: Tensor) -> Vector:
    """Return the axial vector ω of a skew W, W·r = ω × r (A.3)."""
    return (W[7], W[2], W[3])


def turn_about(r: Vector, a: Scalar, b: Scalar, d: Scalar) -> Tensor:
    """Return d I + b r rᵀ + a r×, by Rodrigues the rotation by φ about r.

    The numbers are a = sin φ/|r|, b = (1 − cos φ)/|r|² and d = cos φ.
    """
    x, y, z = r
    return (
        d + b * x * x, b * x * y - a * z, b * x * z + a * y,
        b * x * y + a * z, d + b * y * y, b * y * z - a * x,
        b * x * z - a * y, b * y * z + a * x, d + b * z * z,
    )  # fmt: skip


def to_frame(Q: Tensor, T: Tensor) -> Tensor:
    """Return the components T' = Q T Qᵀ in the frame whose axes are the rows of Q (2)."""
    return dot(dot(Q, T), transpose(Q))


def from_frame(Q: Tensor, T: Tensor) -> Tensor:
    """Return the components T = Qᵀ T' Q in the inertial frame, from T' in the frame Q (2)."""
    return dot(dot(transpose(Q), T), Q)


def log_ratio(J: Scalar) -> Scalar:
    """Return ln J for J in [1/8, 8], to 4 units in the last place of 1, without a branch or library call.

    ln J = 8 artanh z with z = (r − 1)/(r + 1), r = J^¼. The odd series in z, with z² ≤ 0.065, ends where
    its next term is below 1e-17.
    """
    r = np.sqrt(np.sqrt(J))
    z = (r - 1.0) / (r + 1.0)
    y = z * z
    s = 1.0 / 25.0 + y * (1.0 / 27.0)
    s = 1.0 / 23.0 + y * s
    s = 1.0 / 21.0 + y * s
    s = 1.0 / 19.0 + y * s
    s = 1.0 / 17.0 + y * s
    s = 1.0 / 15.0 + y * s
    s = 1.0 / 13.0 + y * s
    s = 1.0 / 11.0 + y * s
    s = 1.0 / 9.0 + y * s
    s = 1.0 / 7.0 + y * s
    s = 1.0 / 5.0 + y * s
    s = 1.0 / 3.0 + y * s
    return 8.0 * z * (1.0 + y * s)


def _rotation(p: Vector, q: Vector) -> tuple[Scalar, Scalar]:
    """Return cosine and sine of the smaller rotation that makes rows p and q orthogonal."""
    gamma = inner(p, q)
    delta = inner(q, q) - inner(p, p)
    size = abs(delta)
    t = 2.0 * gamma / (size + np.sqrt(size * size + 4.0 * gamma * gamma) + _TINY)
    t = select(delta < 0.0, -t, t)
    c = 1.0 / np.sqrt(1.0 + t * t)
    return c, t * c


def _rotate(c: Scalar, s: Scalar, p: Vector, q: Vector) -> tuple[Vector, Vector]:
    """Return the rows (c p − s q, s p + c q)."""
    return (
        (c * p[0] - s * q[0], c * p[1] - s * q[1], c * p[2] - s * q[2]),
        (s * p[0] + c * q[0], s * p[1] + c * q[1], s * p[2] + c * q[2]),
    )


def _sweep(F: Tensor, Q: Tensor) -> tuple[Tensor, Tensor]:
    """Rotate each pair of rows of F once, and the rows of Q by the same rotations."""
    f1, f2, f3 = rows(F)
    q1, q2, q3 = rows(Q)
    c, s = _rotation(f1, f2)
    f1, f2 = _rotate(c, s, f1, f2)
    q1, q2 = _rotate(c, s, q1, q2)
    c, s = _rotation(f1, f3)
    f1, f3 = _rotate(c, s, f1, f3)
    q1, q3 = _rotate(c, s, q1, q3)
    c, s = _rotation(f2, f3)
    f2, f3 = _rotate(c, s, f2, f3)
    q2, q3 = _rotate(c, s, q2, q3)
    return from_rows(f1, f2, f3), from_rows(q1, q2, q3)


def _turn(c: Scalar, s: Scalar, p: Scalar, q: Scalar) -> tuple[Scalar, Scalar]:
    return c * p - s * q, s * p + c * q


def _diagonalise(b: Vector, off: Vector, R: Tensor) -> tuple[Vector, Vector, Tensor]:
    """Apply one Jacobi rotation to each pair of a symmetric tensor, and to the rows of R.

    ``b`` are the tensor's components 11, 22, 33, ``off`` those of 12, 13, 23.
    """
    b1, b2, b3 = b
    b12, b13, b23 = off
    r1, r2, r3 = rows(R)
    t, c, s = _angle(b1, b2, b12)
    b1, b2 = b1 - t * b12, b2 + t * b12
    b12 = 0.0 * t
    b13, b23 = _turn(c, s, b13, b23)
    r1, r2 = _rotate(c, s, r1, r2)
    t, c, s = _angle(b1, b3, b13)
    b1, b3 = b1 - t * b13, b3 + t * b13
    b13 = 0.0 * t
    b12, b23 = _turn(c, s, b12, b23)
    r1, r3 = _rotate(c, s, r1, r3)
    t, c, s = _angle(b2, b3, b23)
    b2, b3 = b2 - t * b23, b3 + t * b23
    b23 = 0.0 * t
    b12, b13 = _turn(c, s, b12, b13)
    r2, r3 = _rotate(c, s, r2, r3)
    return (b1, b2, b3), (b12, b13, b23), from_rows(r1, r2, r3)


def _angle(bp: Scalar, bq: Scalar, bpq: Scalar) -> tuple[Scalar, Scalar, Scalar]:
    """Return tangent, cosine and sine of the smaller rotation that makes b_pq zero."""
    delta = bq - bp
    size = abs(delta)
    twice = 2.0 * bpq
    square = twice * twice
    # tan = twice/h, cos = h/w, sin = twice/w with both reciprocals by one division.
    h = size + np.sqrt(size * size + square) + _SMALL
    w = np.sqrt(h * h + square)
    both = 1.0 / (h * w)
    twice = select(delta < 0.0, -twice, twice)
    return twice * (w * both), h * (h * both), twice * (h * both)


def _turn_all(b: Vector, off: Vector, R: Tensor) -> Tensor:
    """Rotate all pairs of rows of R at once, for a tensor with component 23 zero and 12, 13 small.

    The angles b_pq/(b_q − b_p) form a skew W. The angle of the pair 23 follows from b₂₃ as the other two
    rotations change it in second order. R becomes (1 − W/2)⁻¹·(1 + W/2)·R, a rotation. Nearly equal pairs
    turn by less.
    """
    b1, b2, b3 = b
    b12, b13, _ = off
    # p f is 1/p where p² is large against b₁₂² + b₁₃², and 0 where p is 0.
    least = b12 * b12 + b13 * b13 + _LEAST
    p, q, r = b2 - b1, b3 - b1, b3 - b2
    f, g, h = reciprocals((p * p + least, q * q + least, r * r + least))
    z, y = b12 * (p * f), b13 * (q * g)
    x = 0.5 * (z * b13 + y * b12) * (r * h)
    k = 1.0 / (1.0 + 0.25 * (x * x + y * y + z * z))
    A = _skew_times(x, y, z, R)
    B = _skew_times(x, y, z, A)
    return add_scaled(R, k, add_scaled(A, 0.5, B))


def _skew_times(x: Scalar, y: Scalar, z: Scalar, R: Tensor) -> Tensor:
    """Return W·R for a skew W with W₃₂ = x, W₃₁ = y and W₂₁ = z."""
    return (
        -(z * R[3] + y * R[6]), -(z * R[4] + y * R[7]), -(z * R[5] + y * R[8]),
        z * R[0] - x * R[6], z * R[1] - x * R[7], z * R[2] - x * R[8],
        y * R[0] + x * R[3], y * R[1] + x * R[4], y * R[2] + x * R[5],
    )  # fmt: skip


def _orthonormal(Q: Tensor) -> Tensor:
    """Return the rotation nearest to Q; Q is one to round-off."""
    a1, a2, a3 = Q[0], Q[1], Q[2]
    n = 1.5 - 0.5 * (a1 * a1 + a2 * a2 + a3 * a3)
    a1, a2, a3 = n * a1, n * a2, n * a3
    d = a1 * Q[3] + a2 * Q[4] + a3 * Q[5]
    b1, b2, b3 = Q[3] - d * a1, Q[4] - d * a2, Q[5] - d * a3
    n = 1.5 - 0.5 * (b1 * b1 + b2 * b2 + b3 * b3)
    b1, b2, b3 = n * b1, n * b2, n * b3
    a, b = (a1, a2, a3), (b1, b2, b3)
    return from_rows(a, b, vector_product(a, b))


def stretches_in_frame(F: Tensor, Q: Tensor) -> tuple[Vector, Scalar]:
    """Return stretches along the rows of Q, and the distance of the rows from principal directions of F.

    Returns
    -------
    stretches, skewness
        λ_a = |Fᵀ·n_a|, to round-off times the ratio of the largest to the smallest; and the largest of
        |b_ac|/(λ_a λ_c) in the frame, squared.
    """
    G = dot(Q, F)
    x, xy, xz, _, y, yz, _, _, z = dot(G, transpose(G))
    largest = np.maximum(xy * xy * z, np.maximum(xz * xz * y, yz * yz * x))
    return (np.sqrt(x), np.sqrt(y), np.sqrt(z)), largest / (x * y * z)


def longest_stretch(F: Tensor) -> Scalar:
    """Return an upper bound of the stretches of F, exact for a sphere and a prolate spheroid.

    No eigenvalue of b = F Fᵀ exceeds m + √2 s, with their mean m and standard deviation s
    (Wolkowicz and Styan, Linear Algebra and its Applications 29, 1980).
    """
    x, xy, xz, _, y, yz, _, _, z = dot(F, transpose(F))
    m = (x + y + z) * (1.0 / 3.0)
    x, y, z = x - m, y - m, z - m
    variance = (x * x + y * y + z * z + 2.0 * (xy * xy + xz * xz + yz * yz)) * (1.0 / 3.0)
    return np.sqrt(m + np.sqrt(2.0 * variance))


def refined_frame(F: Tensor, Q: Tensor) -> Tensor:
    """Return the principal frame of F from a frame Q that is nearly principal.

    A sweep of Jacobi's method on b = F Fᵀ in the frame Q, then a rotation of all pairs at once. Both converge
    at least quadratically: to round-off in one call if Q is within 0.003 rad of the principal frame, and in
    two calls within 0.1 rad. :func:`stretches_in_frame` measures the distance; the caller repeats if needed.
    """
    G = dot(Q, F)
    x, xy, xz, _, y, yz, _, _, z = dot(G, transpose(G))
    b, off = (x, y, z), (xy, xz, yz)
    return _orthonormal(_turn_all(*_diagonalise(b, off, Q)))


def principal_frame(F: Tensor) -> tuple[Tensor, Vector]:
    """Return Eulerian principal directions and principal stretches of F (7), (8).

    One-sided cyclic Jacobi: rotations of the rows of F until they are orthogonal. The stretches keep their
    relative accuracy at any ratio; forming F Fᵀ would lose it.

    Returns
    -------
    Q, stretches
        Q is a proper rotation with the directions n_a as rows, close to the identity where F Fᵀ is nearly
        diagonal. The stretches λ_a > 0 are in the order of the rows, not sorted.
    """
    one = 0.0 * F[0] + 1.0
    zero = 0.0 * F[0]
    Q: Tensor = (one, zero, zero, zero, one, zero, zero, zero, one)
    # Five sweeps, written out: a loop here would prevent vectorisation of the loop over lanes.
    G, Q = _sweep(F, Q)
    G, Q = _sweep(G, Q)
    G, Q = _sweep(G, Q)
    G, Q = _sweep(G, Q)
    G, Q = _sweep(G, Q)
    p, q, r = rows(G)
    return Q, (norm(p), norm(q), norm(r))
