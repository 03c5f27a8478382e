"""References of the validation: closed forms and solutions by scipy, independent of foamprb's own code.

Nothing here uses the code that it checks: the integrals are Gauss–Legendre sums, the differential equations
are solved by :func:`scipy.integrate.solve_ivp`, the steady states by root finding.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
