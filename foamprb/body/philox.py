"""Counter-based random numbers: Philox4x32-10 (Salmon, Moraes, Dror & Shaw 2011).

The random numbers of a particle at a step depend on its index, the step's index and a seed only. They are the
same for any order of the particles, any number of threads and processes, and after a restart. There is no
state to save.

Words are unsigned integers of 64 bits with a value below 2³², or arrays of them.
"""

from __future__ import annotations

from math import factorial, pi
from typing import Any, TypeAlias

import numpy as np

from foamprb.body.tensor import Scalar, log_ratio

Word: TypeAlias = Any
"""A number below 2³² as an unsigned integer of 64 bits, or an array of them."""
Words: TypeAlias = tuple[Word, Word, Word, Word]

_ROUNDS = 10
_LOW, _HALF = np.uint64(0xFFFFFFFF), np.uint64(32)
_M0, _M1 = np.uint64(0xD2511F53), np.uint64(0xCD9E8D57)
_W0, _W1 = np.uint64(0x9E3779B9), np.uint64(0xBB67AE85)
_PER_WORD = 2.0**-32


def philox(counter: Words, key: tuple[Word, Word]) -> Words:
    """Return four random words for a counter and a key: ten rounds of products with exchanged halves."""
    c0, c1, c2, c3 = counter
    k0, k1 = key
    for _ in range(_ROUNDS):
        p, q = _M0 * c0, _M1 * c2
        c0, c1, c2, c3 = (q >> _HALF) ^ c1 ^ k0, q & _LOW, (p >> _HALF) ^ c3 ^ k1, p & _LOW
        k0, k1 = (k0 + _W0) & _LOW, (k1 + _W1) & _LOW
    return c0, c1, c2, c3


def uniform(word: Word) -> Scalar:
    """Return a number of (0, 1): one of 2³² evenly spaced ones with the mean ½."""
    return _PER_WORD * word + 0.5 * _PER_WORD


def _log(u: Scalar) -> Scalar:
    """Return ln u for u between 2⁻³³ and 1, from the sixteenth root, to 1e-14."""
    root = np.sqrt(np.sqrt(np.sqrt(np.sqrt(u))))
    return 16.0 * log_ratio(root)


_S3, _S5, _S7, _S9, _S11, _S13, _S15 = [(-1.0) ** (n // 2) / factorial(n) for n in range(3, 16, 2)]
_C2, _C4, _C6, _C8, _C10, _C12, _C14 = [(-1.0) ** (n // 2) / factorial(n) for n in range(2, 15, 2)]


def _direction(u: Scalar) -> tuple[Scalar, Scalar]:
    """Return cosine and sine of π(2u − 1), to 1e-14, from the Taylor series at a quarter of the angle."""
    x = (0.5 * pi) * u - 0.25 * pi
    y = x * x
    s = y * (_S7 + y * (_S9 + y * (_S11 + y * (_S13 + y * _S15))))
    s = x * (1.0 + y * (_S3 + y * (_S5 + s)))
    c = y * (_C6 + y * (_C8 + y * (_C10 + y * (_C12 + y * _C14))))
    c = 1.0 + y * (_C2 + y * (_C4 + c))
    s, c = 2.0 * s * c, c * c - s * s
    return c * c - s * s, 2.0 * s * c


def normals(words: Words) -> tuple[Scalar, Scalar, Scalar, Scalar]:
    """Return four independent standard normal deviates (Box & Muller 1958), at most 6.8 in magnitude."""
    p, q = np.sqrt(-2.0 * _log(uniform(words[0]))), np.sqrt(-2.0 * _log(uniform(words[2])))
    (a, b), (c, d) = _direction(uniform(words[1])), _direction(uniform(words[3]))
    return p * a, p * b, q * c, q * d
