"""The longest stable step of the paper's scheme."""

from __future__ import annotations

from itertools import permutations, product

import numpy as np
import pytest
from strategies import flat

from foamprb.body import rosenbrock
from foamprb.body.ellipsoid import integrals
from foamprb.body.explicit_limit import is_stable, safe_step

C, MU_F = 5.0, 0.7


def longest_step(stretches, mu, eta):
    """By bisection, to round-off."""
    J, lame = np.prod(stretches), 15.0 * mu
    squares = tuple(x * x for x in stretches)
    e = rosenbrock.elasticity(squares, J, mu, lame, 0.0, 0.0)
    tau = rosenbrock.kirchhoff_in_frame(flat(np.diag(squares)), J, mu, lame, 0.0)[::4]
    g, low, high = integrals(stretches), 1e-3 * safe_step(stretches, C, MU_F, eta), 100.0
    for _ in range(60):
        middle = np.sqrt(low * high)
        if is_stable(middle, stretches, g, e, tau, C, MU_F, eta):
            low = middle
        else:
            high = middle
    return low


@pytest.mark.parametrize("stretches", [(1.2, 0.9, 1.05), (0.3, 1.1, 3.4), (0.8, 2.0, 0.5), (3.0, 0.6, 0.6)])
def test_the_longest_stable_step_does_not_depend_on_the_order_of_the_axes(stretches):
    for mu, eta in product((0.02, 2.0, 200.0), (0.0, 2.0)):
        found = [longest_step(axes, mu, eta) for axes in permutations(stretches)]
        assert found == pytest.approx([found[0]] * 6, rel=1e-9)
        assert found[0] > 0.999999 * safe_step(stretches, C, MU_F, eta)
