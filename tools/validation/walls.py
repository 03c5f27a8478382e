"""Soft particles near walls: lift, slip and hindered settling (beyond the paper)."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Rebound
from foamprb.cloud.state import Particles, set_rest_shape, spheres
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Figure, Floats, Outcome, Panel, Row, compared
from validation.references import wall as ref
from validation.references.near_wall import sphere_across_wall, sphere_along_wall

STRESSLET = "stresslet of the solid's side, and its image"
EXACT = "exact solution in bispherical coordinates"
AROUND = "Stokes flow around the body above the wall"
R, RATE, MU_F, RHO = 1e-6, 100.0, 1e-3, 1000.0


def lift(quick: bool) -> Outcome:
    """Wall lift in shear."""
    numbers = np.array([0.01, 0.1, 0.2, 0.4, 1.0])
    far = _carried(np.full(len(numbers), 50.0), numbers, 1200)
    rows = []
    for Ca, k in zip(numbers, _coefficients(far), strict=True):
        title = f"far above the wall, Ca = {Ca:g}: v h²/(γ̇R³)"
        rows.append(Row(title, float(k), ref.lift_coefficient(Ca), STRESSLET, 2.5e-3, relative=True))
    steps = 20000
    height = float(_carried(np.array([20.0]), np.array([0.4]), steps, 0.1 / RATE).x[0, 2] / R)
    expected = ref.lifted_height(20.0, ref.lift_coefficient(0.4), 0.1 * steps)
    rows.append(
        Row("Ca = 0.4: rise from 20R in γ̇t = 2000, over R", height - 20.0, expected - 20.0,
            "h³ = h₀³ + 3 k γ̇R³t", 0.01, relative=True)
    )  # fmt: skip
    stiff = _carried(np.array([20.0]), np.array([1e-3]), 20, 1e-2 / RATE)
    lag = (RATE * stiff.x[0, 2] - stiff.v[0, 0]) / (RATE * R) * 400.0
    rows.append(
        Row("stiff sphere: lag h²/(γ̇R³) at 20R", float(lag), 0.3125, "5/16, its image", 0.01, relative=True)
    )
    near = np.array([3.7622, 2.3524, 1.5431, 1.1276, 1.0453, 1.01])
    beside = _carried(near, np.full(len(near), 1e-4), 2, 1e-3 / RATE)
    for h, v, x in zip(near, beside.v[:, 0], beside.x[:, 2], strict=True):
        exact = sphere_along_wall(float(h)).speed
        rows.append(Row(f"rigid sphere, h = {h:g}R: U/(γ̇h)", float(v / (RATE * x)), exact, EXACT, 1e-2, True))
    curves = []
    starts = ((10.0, 2e-3), (5.0, 4e-3), (3.0, 1e-2), (2.0, 0.04), (1.5, 0.08))
    for colour, Ca in enumerate((0.1,) if quick else (0.05, 0.1, 0.2)):
        p = _carried(np.array([h for h, _ in starts]), np.full(len(starts), Ca), 200)
        heights, ours = p.x[:, 2] / R, _coefficients(p)
        theirs = []
        for F, h in zip(p.F.reshape(-1, 3, 3), heights, strict=True):
            body = ref.Ellipsoid(F, float(h)).free_motion(F @ F.T / Ca, ref.SHEAR_OVER_WALL)
            theirs.append(body.v[2] * h * h)
        if Ca == 0.1:
            for h, k, other, (_, allowed) in zip(heights, ours, theirs, starts, strict=True):
                title = f"Ca = 0.1, h = {h:.2f}R: v h²/(γ̇R³)"
                rows.append(Row(title, float(k), float(other), AROUND, allowed, relative=True))
        labels = f"foamprb, Ca = {Ca:g}", f"Ca = {Ca:g}, around the body"
        curves += compared(heights, ours, np.array(theirs), labels, colour)
    panel = Panel("h/R", "v h²/(γ̇ R³)", curves)
    figure = Figure("wallLift", "Lift on soft spheres in shear over a wall", [panel])
    remark = (
        "The body deforms affinely. Computed capsules lose up to 30 % of the far lift by asymmetry (Nix "
        "et al. 2014), which an ellipsoid cannot have."
    )
    return Outcome(rows, [figure], [remark])


def mobility(quick: bool) -> Outcome:
    """Mobility near walls."""
    rows = []
    speed = 2.0 / 9.0 * R**2 * RHO * 9.81 / MU_F
    for h in (10.0, 1.5) if quick else (10.0, 3.0, 1.5, 1.1):
        v = -_settling(h, (0.0, 0.0, -9.81))[2] / speed
        title = f"across the wall, h = {h:g}R: speed over that without wall"
        rows.append(Row(title, float(v), 1.0 / ref.brenner_drag(h), "Brenner (1961)", 6e-3, relative=True))
    for h, drag in ref.GOLDMAN_COX_BRENNER:
        title = f"drag along the wall without turning, h = {h:g}R, over that without wall"
        source = "Goldman, Cox & Brenner (1967)"
        rows.append(Row(title, sphere_along_wall(h).drag, drag, source, 1e-4, relative=True))
    for h in (3.7622, 1.5431, 1.0453) if quick else (10.0677, 3.7622, 2.3524, 1.5431, 1.1276, 1.0453, 1.02):
        v = _settling(h, (9.81, 0.0, 0.0))[0] / speed
        title = f"along the wall, h = {h:g}R: speed over that without wall"
        rows.append(Row(title, float(v), sphere_along_wall(h).mobility, EXACT, 6e-3, relative=True))
    for place, share, allowed in (("midway", 0.5, 0.02), ("a quarter of the way", 0.25, 0.03)):
        for e in (0.1, 0.3, 0.5):
            v = _settling(1.0 / e, (9.81, 0.0, 0.0), 1.0 / (share * e))[0] / speed
            title = f"along two walls, {place} between them, h = {1.0 / e:.3g}R: speed over that without"
            source = "Faxén (1922), walls not superposed"
            rows.append(Row(title, float(v), ref.slit_mobility(place, e), source, allowed, relative=True))
    for number in (1.0,) if quick else (0.1, 1.0, 10.0):
        ours, theirs = _onto_slope(number)
        title = f"with inertia, v_s τ/R = {number:g}, onto a slope from 4R to 1.1R: "
        source = "its equation of motion, the exact solution and Schäffer et al."
        rows.append(Row(f"{title}way along it, over R", ours[0], theirs[0], source, 2e-3, relative=True))
        rows.append(Row(f"{title}height, over R", ours[1], theirs[1], source, 2e-3, relative=True))
    heights = [3.0, 2.0, 1.5, 1.2, 1.1]
    for text, around in (("", (WallLift(),)), (" and faxenCorrection", (FaxenCorrection(), WallLift()))):
        for h, v in zip(heights, () if quick else _behind_a_post(np.array(heights), around), strict=False):
            title = f"behind a post of 100R, wallLift{text}, h = {h:g}R: velocity over that of the flow"
            exact = sphere_across_wall(h).stagnation
            rows.append(Row(title, float(v), exact, f"{EXACT}, plane wall", 0.05 if text else 0.02, True))
    for text, axes in SHAPES:
        extents = np.array([3.0, 2.0, 1.5, 1.3])
        found = () if quick else _behind_a_post(axes[0] * extents, (WallLift(),), axes)
        for h, v in zip(extents, found, strict=False):
            title = f"ellipsoid {text}, h = {h:g} of its reach: velocity over that of the flow"
            rows.append(Row(title, float(v), ref.velocity_away(axes[0] * h, np.diag(axes[::-1])), AROUND))
    return Outcome(rows, [], [])


SHAPES = tuple(
    (f"{text}, D {D:g}", ratio ** np.array([2.0, -1.0, -1.0]))
    for D in (0.1, 0.3)
    for text, ratio in (
        ("pointed at the wall", ((1.0 + D) / (1.0 - D)) ** (1.0 / 3.0)),
        ("flat at it", ((1.0 - D) / (1.0 + D)) ** (1.0 / 3.0)),
    )
)
"""Semi-axes across and along the wall, over R."""


def _behind_a_post(heights: Floats, around: tuple[Surrounding, ...], axes: Floats | None = None) -> Floats:
    """Return the velocities of rigid bodies on the axis behind a post, over those of the flow."""
    gap, dt = 200.0 * R, 1e-4
    flow = analytic.posts(2.0 * gap, gap, (10.0 * gap, 0.0))
    x = np.zeros((len(heights), 3))
    x[:, 0] = 0.5 * gap + heights * R
    p = spheres(x, d=2.0 * R, rho=RHO, mu=1e4)
    if axes is not None:
        set_rest_shape(p, tuple(axes))
    models = Models(integrator="stokes", surroundings=around)
    cloud = Cloud(p, flow, Medium(MU_F, RHO, (0.0, 0.0, 0.0)), [Rebound()], dt, models, threads=1)
    # Until they have taken on the strain that the flow asks of them.
    cloud.advance(30)
    start = p.x[:, 0].copy()
    u = flow.sample(p.x, flow.locate(p.x), 0.0)[0][:, 0]
    cloud.advance(3)
    return np.asarray((p.x[:, 0] - start) / (3.0 * dt * u))


def _onto_slope(number: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return places (x, z) of a stiff sphere falling from 4R to 1.1R, ours and the reference.

    Lengths are in radii R, times in τ, in which drag stops it far from walls; it falls ``number`` of them.
    """
    inverse = np.linspace(0.2, 0.95, 26)
    along_wall = CubicSpline(inverse, [sphere_along_wall(1.0 / float(e)).mobility for e in inverse])

    def rate(_t: float, y: Floats) -> tuple[float, float, float, float]:
        e = 1.0 / y[1]
        along = float(along_wall(e))
        across = 1 - 9 * e / 8 + e**3 / 2 - 57 * e**4 / 100 + e**5 / 5 + 7 * e**11 / 200 - e**12 / 25
        return y[2], y[3], 0.6 * number - y[2] / along, -0.8 * number - y[3] / across

    def low(_t: float, y: Floats) -> float:
        return float(y[1] - 1.1)

    low.terminal = True  # type: ignore[attr-defined]
    exact = solve_ivp(rate, (0.0, 1e4), (0.0, 4.0, 0.0, 0.0), "LSODA", events=low, rtol=1e-10, atol=1e-12)
    tau = 2.0 / 9.0 * 2.0 * RHO * R**2 / MU_F
    p = spheres([[0.0, 0.0, 4.0 * R]], d=2.0 * R, rho=2.0 * RHO, mu=1e7, poissons_ratio=0.4999)
    p.v[:] = 0.0
    g = number * R / tau**2
    models = Models(integrator="rosenbrock", surroundings=(WallLift(cutOff=1000.0),))
    medium = Medium(MU_F, 1e-6, (0.6 * g, 0.0, -0.8 * g))
    dt = float(exact.t[-1]) * tau / 20
    Cloud(p, analytic.shear_over_wall(0.0), medium, [Rebound()], dt, models, threads=1).advance(20)
    x, z = p.x[0, 0] / R, p.x[0, 2] / R
    return (float(x), float(z)), (float(exact.y[0, -1]), float(exact.y[1, -1]))


def _coefficients(p: Particles) -> Floats:
    coefficients: Floats = p.v[:, 2] * p.x[:, 2] ** 2 / (RATE * R**3)
    return coefficients


def _carried(heights: Floats, Ca: Floats, steps: int, dt: float = 0.02 / RATE) -> Particles:
    """Return spheres after steps in shear over the wall z = 0, from heights in radii."""
    x = np.stack([0.0 * heights, 0.0 * heights, R * heights], axis=1)
    p = spheres(x, d=2.0 * R, rho=RHO, mu=MU_F * RATE / Ca, poissons_ratio=0.4999)
    _advance(p, analytic.shear_over_wall(RATE), (0.0, 0.0, 0.0), dt, steps)
    return p


def _settling(h: float, g: tuple[float, float, float], height: float = np.inf) -> Floats:
    """Return the velocity of a stiff sphere of twice the fluid's density in a fluid at rest, m/s.

    The upper wall is ``height`` radii above the lower one, if there is one.
    """
    p = spheres([[0.0, 0.0, h * R]], d=2.0 * R, rho=2.0 * RHO, mu=1e3, poissons_ratio=0.4999)
    still = analytic.shear_over_wall(0.0) if height == np.inf else analytic.slit(height * R, 0.0)
    # Until it has taken on the strain that the walls ask of it.
    _advance(p, still, g, 1e-6, 80)
    v: Floats = p.v[0]
    return v


def _advance(
    p: Particles, flow: analytic.AnalyticFlow, g: tuple[float, float, float], dt: float, steps: int
) -> None:
    models = Models(integrator="stokes", surroundings=(WallLift(cutOff=1000.0),))
    Cloud(p, flow, Medium(MU_F, RHO, g), [Rebound()] * len(flow.patches), dt, models, threads=1).advance(
        steps
    )
