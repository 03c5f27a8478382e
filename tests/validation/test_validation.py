from __future__ import annotations

import mpmath
import numpy as np
import pytest
from validation import cytometry, device, main, margination, report, tumbling
from validation.case import Case, Curve, Figure, Outcome, Panel, Row, worst
from validation.references import duct, rigid, soft, tube
from validation.references.ellipsoid import (
    integrals,
    prolate_resistances,
    resistances,
    traction_stress,
)
from validation.references.extension import (
    EXTENSIONS,
    settling_in_extension,
    steady_compressible_extension,
    steady_extension,
)
from validation.references.inertia import Surroundings, poiseuille, rigid_sphere
from validation.references.roscoe import roscoe, roscoe_at
from validation.references.shear import (
    SHEAR,
    STEADY_SHAPES,
    TRANSIENT_SHAPES,
    inertialess_history,
    inertialess_rate,
    shear_shape,
    steady_shear,
    tank_treading_rate,
)
from validation.registry import CASES

from foamprb.body.lift import PIPE, PLANE_CHANNEL


@pytest.mark.parametrize("name", CASES)
def test_quick_case_passes(name):
    outcome = CASES[name].run(True)
    assert outcome.rows
    failed = [report.cells(row) for row in outcome.rows if row.verifies and row.passed is False]
    assert not failed, failed
    assert len({figure.name for figure in outcome.figures}) == len(outcome.figures)


class TestReferences:
    """The references against each other and against closed forms."""

    def test_lift_in_a_channel(self):
        """Near a wall that of one wall, (55/576)·6π (Cox & Hsu 1977); the table in between."""
        assert duct.coefficient(0.999) == pytest.approx(-55 * np.pi / 96, rel=5e-3)
        table = dict(PLANE_CHANNEL)
        for s in (0.2, 0.8):
            assert table[s] == pytest.approx(duct.coefficient(s), abs=1e-5)

    def test_hindrance_on_the_axis_of_a_pipe(self):
        """1.8044 of Faxén's series, with a correction by the square of the distance from the axis."""
        near, far = tube.hindrance(0.02), tube.hindrance(0.04)
        assert near - (far - near) / 3.0 == pytest.approx(1.8044, abs=3e-4)

    def test_lift_in_a_pipe(self):
        """With few modes; near the wall it goes to that of one wall, too."""
        assert PIPE[-1] == PLANE_CHANNEL[-1]
        assert dict(PIPE)[0.2] == pytest.approx(tube.coefficient(0.2, 8), abs=2e-3)

    @pytest.mark.parametrize("axes", [(1.0, 1.0, 1.0), (2.5, 0.4, 1.0), (4.9, 0.14, 1.45)])
    def test_integrals_by_another_quadrature(self, axes):
        a, b, c = (mpmath.mpf(r) ** 2 for r in axes)

        def integral(f):
            return float(
                mpmath.quad(
                    lambda x: f(x) / mpmath.sqrt((a + x) * (b + x) * (c + x)),
                    [0, 0.1, 1, 10, 100, mpmath.inf],
                )
            )

        g = integrals(np.array(axes))
        assert g.first[0] == pytest.approx(integral(lambda x: 1 / (a + x)), rel=1e-9)
        assert g.ring[0] == pytest.approx(integral(lambda x: 1 / ((b + x) * (c + x))), rel=1e-9)
        assert g.star[1] == pytest.approx(integral(lambda x: x / ((c + x) * (a + x))), rel=1e-9)
        assert g.chi == pytest.approx(integral(lambda _: 1), rel=1e-6)
        # (B.10) and α₀ + β₀ + γ₀ = 2/(abc).
        assert g.first.sum() == pytest.approx(2 / np.prod(axes), rel=1e-12)

    def test_spheres_have_the_known_traction_and_resistance(self):
        np.testing.assert_allclose(resistances(np.ones(3)), 6 * np.pi, rtol=1e-12)
        np.testing.assert_allclose(
            prolate_resistances(np.array([1.0, 3.0, 1.0])),
            resistances(np.array([1.0, 3.0, 1.0])),
            rtol=1e-9,
        )
        l_f = np.array([[1.0, 2.0, 0.0], [0.5, -3.0, 0.3], [0.0, 1.0, 2.0]])
        d, w = 0.5 * (l_f + l_f.T), 0.5 * (l_f - l_f.T)
        found = traction_stress(np.eye(3), l_f, np.zeros((3, 3)))
        np.testing.assert_allclose(found, 5 * d + 3 * w, atol=1e-12)

    def test_inertialess_rate_balances_traction_and_stress(self, random):
        F = np.eye(3) + 0.4 * random.normal(size=(3, 3))
        F *= np.linalg.det(F) ** (-1 / 3) if np.linalg.det(F) > 0 else np.nan
        l_f = random.normal(size=(3, 3))
        l_f -= np.trace(l_f) / 3 * np.eye(3)
        Ca, ratio = 0.3, 0.7
        l_s = inertialess_rate(F, l_f, Ca, ratio)
        assert np.trace(l_s) == pytest.approx(0.0, abs=1e-12)
        rest = traction_stress(F, l_f, l_s) - F @ F.T / Ca - ratio * (l_s + l_s.T)
        # What is left is a pressure.
        np.testing.assert_allclose(rest, rest[0, 0] * np.eye(3), atol=1e-10)

    @pytest.mark.parametrize("Ca", STEADY_SHAPES)
    def test_roscoes_algebra_agrees_with_the_table(self, Ca):
        np.testing.assert_allclose(roscoe_at(Ca)[:3], STEADY_SHAPES[Ca][:3], atol=6e-6)
        np.testing.assert_allclose(roscoe_at(Ca)[3:], STEADY_SHAPES[Ca][3:], atol=6e-4)

    @pytest.mark.parametrize(
        ("Ca", "ratio"), [(0.1, 0.0), (0.4, 0.0), (1.0, 0.0), (0.4, 0.5), (0.4, 1.0), (1.0, 3.0)]
    )
    def test_roscoes_algebra_is_the_steady_state_of_the_equations(self, Ca, ratio):
        """Elastic and viscoelastic."""
        np.testing.assert_allclose(steady_shear(Ca, ratio), roscoe_at(Ca, ratio), rtol=1e-7)

    def test_a_viscous_solid_stretches_only_so_far(self):
        assert roscoe(3.0, 3.0).Ca == np.inf

    def test_transient_agrees_with_the_table(self):
        times = np.array(list(TRANSIENT_SHAPES))
        for F, expected in zip(
            inertialess_history(SHEAR, 0.4, times), TRANSIENT_SHAPES.values(), strict=True
        ):
            shape = shear_shape(F, np.zeros((3, 3)))
            # Printed to four digits, and at 3/γ̇ in a steep overshoot.
            np.testing.assert_allclose(shape[1:3], expected[:2], atol=1e-4)
            assert shape[3] == pytest.approx(expected[2], abs=5e-3)

    def test_tank_treading_rate_is_roscoes_frequency(self):
        F = inertialess_history(SHEAR, 0.1, np.array([30.0]))[0]
        nu = tank_treading_rate(inertialess_rate(F, SHEAR, 0.1))
        assert nu == pytest.approx(0.49692, abs=1e-5)

    def test_small_extension_is_linear(self):
        """r − 1 = 5/2 Ca d̂."""
        for rates in EXTENSIONS.values():
            axes = steady_extension(rates, 1e-4)
            np.testing.assert_allclose((axes - 1) / 1e-4, 2.5 * rates, atol=5e-3)
            np.testing.assert_allclose(
                steady_compressible_extension(rates, 0.1, 0.4999999),
                steady_extension(rates, 0.1),
                atol=1e-6,
            )

    def test_too_strong_an_extension_has_no_steady_shape(self):
        with pytest.raises(ValueError, match="no steady shape"):
            steady_extension(EXTENSIONS["uniaxial"], 0.5)

    def test_rigid_sphere_lands_where_the_closed_form_says(self):
        radius = 2.1e-3
        air = Surroundings(
            1.491e-5 * 1.208, 1.208, np.array([0.0, -9.81, 0.0]), poiseuille(radius, 923.8 * radius / 4)
        )
        fall = rigid_sphere(
            2.5e-6, 2560.0, air, np.array([0.0, -1.65e-3, 0.0]), np.array([0.0, 0.3]), -radius
        )
        assert fall.t[-1] == pytest.approx(0.2327, abs=5e-5)
        assert fall.x[-1, 0] / 5e-6 == pytest.approx(8989, abs=0.5)

    def test_settling_in_extension_solves_its_equation(self):
        K, rates, a = np.array([5.0, 4.0, 6.0]), np.array([1.0, -1.0, 0.0]), np.array([0.3, 0.2, -0.1])
        t, h = 0.7, 1e-4
        x = [settling_in_extension(K, 2.0, 3.0, rates, a, t + s)[0] for s in (-h, 0.0, h)]
        v = settling_in_extension(K, 2.0, 3.0, rates, a, t)[1]
        np.testing.assert_allclose((x[2] - x[0]) / (2 * h), v, rtol=1e-6)
        k = 3.0 * K / 2.0
        np.testing.assert_allclose((x[2] - 2 * x[1] + x[0]) / h**2, k * (rates * x[1] - v) + a, atol=1e-6)


def random_gradient(random):
    l = random.normal(size=(3, 3))
    return l - np.trace(l) / 3 * np.eye(3)


class TestRigidReferences:
    @pytest.mark.parametrize("ratio", [1.2, 3.0, 10.0])
    def test_stresslet_is_that_of_the_traction(self, ratio, random):
        """Kim & Karrila's closed forms against Jeffery's traction by quadrature, free of torque."""
        l = random_gradient(random)
        Q = np.linalg.qr(random.normal(size=(3, 3)))[0]
        a = np.array([ratio, 1.0, 1.0])
        g, squares = Q.T @ l @ Q, a**2
        slip = (squares[None] - squares[:, None]) / (squares[None] + squares[:, None])
        turn = Q @ (0.5 * (g - g.T) + slip * 0.5 * (g + g.T)) @ Q.T
        s = traction_stress(Q @ np.diag(a), l, turn)
        np.testing.assert_allclose(s, s.T, atol=1e-9)
        expected = rigid.spheroid_stresslet(ratio, Q[:, 0], l)
        np.testing.assert_allclose(s - np.trace(s) / 3 * np.eye(3), expected, atol=1e-9)

    @pytest.mark.parametrize("ratio", [3.0, 0.4])
    def test_orbit_is_that_of_the_rigid_body(self, ratio):
        start = np.array([0.3, 0.5, 0.4]) / np.sqrt(0.5)
        Q = np.linalg.qr(np.column_stack([start, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]))[0].T
        Q[0] *= np.sign(Q[0] @ start)
        times = np.linspace(0.0, 25.0, 6)
        axes = rigid.rigid_axes(np.array([ratio, 1.0, 1.0]), Q, SHEAR, times)
        np.testing.assert_allclose(axes[:, 0], rigid.jeffery_axis(start, ratio, times), atol=1e-10)
        np.testing.assert_allclose(axes @ axes.transpose(0, 2, 1), np.tile(np.eye(3), (6, 1, 1)), atol=1e-10)
        C = rigid.orbit_constant(axes[:, 0], ratio)
        np.testing.assert_allclose(C, C[0], rtol=1e-9)


class TestSoftReferences:
    def test_dense_balance_is_the_decoupled_one(self, random):
        F = np.eye(3) + 0.3 * random.normal(size=(3, 3))
        F /= np.cbrt(np.linalg.det(F))
        l = random_gradient(random)
        found = soft.velocity_gradient(F, l, soft.Body(0.3, viscosity_ratio=0.7))
        np.testing.assert_allclose(found, inertialess_rate(F, l, 0.3, 0.7), atol=1e-12)

    def test_surface_stress_is_the_derivative_of_the_surface(self):
        """Along each axis, in units of γ/R; 2 for a sphere."""
        np.testing.assert_allclose(soft.surface_stress(np.eye(3)), 2.0 * np.eye(3), atol=1e-12)
        axes = np.array([1.6, 0.9, 1 / 1.44])

        def area(a):
            points, weights = soft._POINTS, soft._SOLID_ANGLES
            return np.prod(a) * weights @ np.linalg.norm(points / a, axis=1)

        h = 1e-5
        for k in range(3):
            up, down = axes.copy(), axes.copy()
            up[k] *= np.exp(h)
            down[k] *= np.exp(-h)
            slope = (area(up) - area(down)) / (2 * h) / (4 / 3 * np.pi)
            assert soft.surface_stress(np.diag(axes))[k, k] == pytest.approx(slope, rel=1e-8)

    @pytest.mark.parametrize("ratio", [0.0, 3.0])
    def test_stress_of_the_solid_is_the_far_field_of_the_fluid(self, ratio):
        """And Roscoe's ellipsoid carries it."""
        body = soft.Body(0.4, viscosity_ratio=ratio)
        F = soft.steady(SHEAR, body)
        S = soft.particle_stress(F, SHEAR, body)
        l_s = soft.velocity_gradient(F, SHEAR, body)
        far = traction_stress(F, SHEAR, l_s) - (l_s + l_s.T)
        np.testing.assert_allclose(S, far - np.trace(far) / 3 * np.eye(3), atol=1e-9)
        np.testing.assert_allclose(soft.rheology(S), soft.roscoe_rheology(0.4, ratio), atol=1e-6)

    def test_stiff_spheres_are_einsteins(self):
        found = soft.roscoe_rheology(1e-3)
        np.testing.assert_allclose(found, (2.5, 12.5e-3, found.N2), atol=1e-5)

    def test_signed_distance_tells_the_sense_of_turning(self):
        assert soft.signed_distance((0.0, 2.0), (1.0, 0.0)) == -2.0
        assert soft.signed_distance((0.0, 2.0), (-3.0, 0.0)) == 2.0

    def test_a_transition_outside_its_bracket_is_no_number(self):
        assert np.isnan(soft.transition(lambda p: p.nearest, 2.0, 0.1, 0.15))


def test_motion_changes_from_tumbling_to_swinging():
    """Half turns within 44/γ̇, by the angle of the axis."""
    _, along, across = tumbling._paths(np.full(2, 2.0), np.array([0.2, 0.4]), 44.0)
    turned = tumbling._angles(along, across)
    assert turned[-1, 0] < -3 * 180
    assert -90 < turned[-1, 1] < 90


def test_table_of_the_axis_is_even_and_its_gradient_that_of_its_velocity():
    for mesh in device.MESHES:
        table = device.read_axis(mesh)
        assert table.start == pytest.approx(1e-3)
        assert table.spacing == pytest.approx(2e-6)
        slope = np.gradient(table.u, table.spacing)[5:-5]
        # The velocity gradient is reconstructed on its own, to a few per cent of its largest on these meshes.
        assert abs(slope - table.rate[5:-5]).max() < 0.15 * table.rate.max()


def fake(rows):
    def run(quick: bool) -> Outcome:
        """A made-up case."""
        x = np.array([0.0, 1.0])
        panel = Panel(
            "x", "y", [Curve(x, x, "ours"), Curve(x, x, "theirs", "reference"), Curve(x, x, "", "guide")]
        )
        return Outcome(rows, [Figure("made-up", "A caption with [brackets].", [panel])], ["A `remark`."])

    return {"madeUp": Case("nowhere", run)}


GOOD, BAD = Row("good", 1.0, 1.001, "me", 0.01), Row("bad | bar", 1.0, 2.0, "me", 0.01, relative=True)
INFORMS = Row("informs", 1.0, None, "me")
THEIRS = Row(
    "theirs", 1.0, 1.5, "they", kind="measured", reference_error=0.25, quartiles=(1.0, 2.0), allowed=0.1
)


class TestRows:
    def test_a_row_passes_within_its_allowed_difference(self):
        assert GOOD.passed is True
        assert BAD.passed is False
        assert INFORMS.passed is None
        assert BAD.difference == pytest.approx(0.5)

    @pytest.mark.parametrize("value", [np.nan, np.inf, None])
    def test_what_is_no_number_fails(self, value):
        assert Row("x", value, 1.0, "me", 1e9).passed is False

    def test_worst_finds_the_largest_difference_or_what_is_no_number(self):
        assert worst("x", np.array([1.0, 2.0]), np.array([1.0, 1.5]), "me", 1.0).difference == 0.5
        assert worst("x", np.array([np.nan, 2.0]), np.array([1.0, 1.5]), "me", 1.0).passed is False


def test_medians_of_samples_scatter_by_their_standard_error():
    samples = np.random.default_rng(1).normal(size=(4000, 401))
    low, high = np.quantile(samples[0], (0.25, 0.75))
    scatter = np.median(samples, axis=1).std()
    assert cytometry.standard_error(low, high, 401) == pytest.approx(scatter, rel=0.1)


def test_cells_that_drift_in_proportion_come_to_the_axis_by_e():
    assert margination.contraction(1, -margination.PLACES / margination.LENGTH) == pytest.approx(np.exp(-1.0))


def test_a_constant_viscosity_gives_the_velocity_on_the_axis_of_a_square():
    """0.0736713 W² Δp/(μ L)."""
    axis = margination.velocity_in_channel(1e5, {"mu0": 1.0, "inf": 0.0, "m": 0.0, "n": 0.64}, n=30)[0]
    exact = 0.0736713 * margination.WIDTH**2 * 1e5 / margination.LENGTH
    # m = 0 leaves μ₀.
    assert axis == pytest.approx(exact, rel=1e-3)


class TestCommand:
    def test_a_failing_row_gives_exit_status_1(self, tmp_path, monkeypatch, capsys):
        pytest.importorskip("matplotlib")

        for rows, status in (([GOOD, INFORMS], 0), ([GOOD, BAD], 1)):
            monkeypatch.setattr(main, "CASES", fake(rows))
            assert main.main(["-output", str(tmp_path)]) == status
        printed = capsys.readouterr().out
        assert "failed: madeUp: bad | bar" in printed
        assert "1 of 2 rows pass" in printed
        text = (tmp_path / "report.md").read_text()
        assert "bad \\| bar" in text
        assert "made-up.png" in text
        assert (tmp_path / "made-up.png").exists()

    def test_rows_of_others_have_a_page(self, tmp_path, monkeypatch):
        pytest.importorskip("matplotlib")
        monkeypatch.setattr(main, "CASES", fake([GOOD, THEIRS]))
        assert main.main(["-output", str(tmp_path)]) == 0
        assert "1.5 ± 0.25 [1, 2]" in (tmp_path / "others.md").read_text()
        assert "good" not in (tmp_path / "others.md").read_text()
        text = (tmp_path / "report.md").read_text()
        assert "(1 rows, verification)" in text
        assert text.splitlines()[2].startswith(
            "1 of 2 rows pass: 1 of 1 equations, 0 of 0 others, 0 of 1 measured; 0 more "
        )

    def test_sections_of_other_cases_remain_in_the_order_of_the_registry(self, tmp_path, monkeypatch):
        pytest.importorskip("matplotlib")
        first, other = fake([GOOD])["madeUp"], fake([BAD, THEIRS])["madeUp"]
        monkeypatch.setattr(main, "CASES", {"first": first, "other": other})
        main.main(["-output", str(tmp_path)])
        whole = [(tmp_path / name).read_text() for name in ("report.md", "others.md")]
        main.main(["-case", "first", "-output", str(tmp_path)])
        assert [(tmp_path / name).read_text() for name in ("report.md", "others.md")] == whole

    def test_list_names_every_case(self, capsys):
        assert main.main(["-list"]) == 0
        printed = capsys.readouterr().out
        assert all(name in printed for name in CASES)

    def test_an_unknown_case_is_an_error_that_says_what_was_meant(self, capsys):
        assert main.main(["-case", "rotatoin"]) == 1
        assert "Did you mean 'rotation'" in capsys.readouterr().err
