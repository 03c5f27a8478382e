"""Tables of measured bodies: units, files of devices, and one message for each mistake."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from pipe_cells import write_rtdc

from foamprb.errors import InputError
from foamprb.run.measured import read_all, read_measured
from foamprb.run.rtdc import pixel_noise


def table(folder, text, name="cells.csv"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_units_and_errors_are_read(tmp_path):
    path = table(
        tmp_path, "id,x [mm],d [µm],area [um²],angle [deg],angleError [°],strain,note\na7,2,10,80,45,2,,x\n"
    )
    measured = read_measured(path)
    assert measured.ids.tolist() == ["a7"]
    expected = {"x": 2e-3, "d": 1e-5, "area": 8e-11, "angle": np.pi / 4, "angleError": np.pi / 90}
    assert {name: measured.of(name)[0] for name in expected} == pytest.approx(expected)
    assert np.isnan(measured.of("strain")[0])
    assert measured.size == "d"
    assert measured.shapes == ("strain", "angle")


@pytest.mark.parametrize("text", ["d [µm];strain\n10,5;0,1\n9;2e-1\n", "d (um)\tstrain\n10,5\t0.1\n9\t.2\n"])
def test_semicolons_tabs_and_decimal_commas_are_read(tmp_path, text):
    measured = read_measured(table(tmp_path, text))
    np.testing.assert_allclose(measured.of("d"), [10.5e-6, 9e-6])
    np.testing.assert_allclose(measured.of("strain"), [0.1, 0.2])


def test_columns_that_are_not_used_are_named(tmp_path, caplog):
    with caplog.at_level("INFO", "foamprb"):
        read_measured(table(tmp_path, "d [um],strain,angles [deg],note\n10,0.1,3,a\n"))
    said = [record.getMessage().partition(": ")[2] for record in caplog.records]
    assert said == ["the column 'angles [deg]' is not used. Is it 'angle'?", "the column 'note' is not used."]


def test_angles_of_lines_have_no_sign(tmp_path):
    measured = read_measured(table(tmp_path, "d [um],angle [deg]\n9,-30\n9,150\n9,330\n9,90\n"))
    np.testing.assert_allclose(np.degrees(measured.of("angle")), [30.0, 30.0, 30.0, 90.0])
    with pytest.raises(InputError, match=r"an angle of 30 rad. Allowed: up to 2π; or degrees"):
        read_measured(table(tmp_path, "d [um],angle [rad]\n9,30\n"))


def test_semi_axes_give_size_and_strain(tmp_path):
    measured = read_measured(table(tmp_path, "a [um],b [um]\n8,2\n"))
    assert measured.of("area")[0] == pytest.approx(16e-12 * np.pi)
    assert measured.of("strain")[0] == pytest.approx(1.5)
    assert measured.size == "area"


@pytest.mark.parametrize(("unit", "d"), [("m", 1e-5), ("mm", 1e-2), ("um", 10.0), ("nm", 1e4)])
def test_a_diameter_is_the_same_in_any_unit(unit, d, tmp_path):
    measured = read_measured(table(tmp_path, f"d [{unit}],strain\n{d:g},0.1\n"))
    assert measured.of("d")[0] == pytest.approx(1e-5, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no rows. Needed: a line of heads"),
        ("d,strain\n1e-5,0.1\n", r"the column d has no unit. Allowed: \[m\], \[mm\], \[um\], \[nm\]"),
        ("d [inch],strain\n1,0.1\n", r"the column d has the unit \[inch\]"),
        ("d [um],strain\n10,soft\n", "line 2: strain is 'soft'. Needed: a number"),
        ("d [um],strain\n10,0.1\n10\n", "line 3 has 1 cells, the heads are 2"),
        ("d [um],strain\n-10,0.1\n", "d of body 0 is -1e-05. Needed: a number > 0"),
        ("d [um],strain,strainError\n10,0.1,0\n", "strainError of body 0 is 0"),
        ("d [um],strain\n10,inf\n", "strain of body 0 is inf"),
        (
            "d [um],x [m]\n10,0.1\n",
            "no measured shape. Needed: a column strain, deformation, angle, treading",
        ),
        ("strain\n0.1\n", "no size of the bodies"),
        ("d [um],d [m],strain\n1,1,1\n", "two columns d"),
        ("d [um],Strain\n10,0.1\n", "a column Strain. Did you mean 'strain'?"),
    ],
)
def test_each_mistake_of_a_table_is_one_message(tmp_path, text, message):
    with pytest.raises(InputError, match=message):
        read_measured(table(tmp_path, text))


def test_frames_of_a_cell_in_an_evaluation_are_averaged(tmp_path):
    heads = "frame,timestamp,x,y,radial_position,long_axis,short_axis,angle,solidity,cell_id"
    units = "frame,ms,cam_pixel,cam_pixel,,µm,µm,deg,dimensionless,dimensionless"
    rows = "0,0,10,20,50,20,10,-30,0.98,3\n1,2,30,20,52,20,10,-34,0.98,3\n1,2,40,9,-70,16,12,20,0.98,5\n"
    measured = read_measured(table(tmp_path, f"{heads}\n{units}\n{rows}", "a_evaluated.csv"))
    assert measured.ids.tolist() == [3, 5]
    np.testing.assert_allclose(measured.of("y"), [51e-6, -70e-6])
    np.testing.assert_allclose(measured.of("angle"), np.radians([32.0, 20.0]))
    np.testing.assert_allclose(measured.of("strain"), [10.0 / np.sqrt(200.0), 4.0 / np.sqrt(192.0)])
    np.testing.assert_allclose(measured.of("area"), np.pi * 1e-12 * np.array([50.0, 48.0]))


def test_an_exported_table_of_dclab_is_read(tmp_path):
    heads = "\ufeff# dclab version: 1\n#\n# area_um\tdeform\n# Area [µm²]\tDeformation\n"
    text = f"{heads}5.0e1\t2.0e-2\n6.0e1\t3.0e-2\n"
    measured = read_measured(table(tmp_path, text, "cells.tsv"))
    np.testing.assert_allclose(measured.of("area"), [5e-11, 6e-11])
    np.testing.assert_allclose(measured.of("deformation"), [0.02, 0.03])
    lacking = table(tmp_path, "# area_um\tarea_cvx\n# Area\tA\n1\t2\n", "b.tsv")
    with pytest.raises(InputError, match="no feature deform"):
        read_measured(lacking)


def test_a_measurement_of_dclab_is_read(tmp_path, caplog):
    path = write_rtdc(tmp_path / "cells.rtdc", [50.0, 60.0, 0.0], [0.02, 0.03, 0.1])
    measured = read_measured(path)
    assert "no size of pixels" in caplog.text
    np.testing.assert_allclose(measured.of("area")[:2], [5e-11, 6e-11])
    np.testing.assert_allclose(measured.of("deformation")[:2], [0.02, 0.03])
    assert np.isnan(measured.of("area")[2])
    pytest.importorskip("dclab")
    with pytest.raises(InputError, match="not a file of dclab"):
        read_measured(table(tmp_path, "", "empty.rtdc"))


def test_pixels_and_medium_of_a_measurement_count(tmp_path):
    """CellCarrier: 2.3e-6 exp(3379.7/T) γ̇^(n − 1), n = 0.00223 T − 0.0056 (Buyukurganci et al. 2022)."""
    setup = {"channel width": 20.0, "flow rate": 0.04, "medium": "CellCarrier", "chip region": "channel"}
    setup["temperature"] = 23.0
    more = {"setup": setup, "imaging": {"pixel size": 0.34}}
    path = write_rtdc(tmp_path / "cells.rtdc", [50.0, 50.0], [0.02, 0.0084], **more)
    measured = read_measured(path, by="sample")
    # 0.0012 + 0.02 exp(−50/7.1) + 0.01 exp(−50/38.6) + 0.005 exp(−50/296)
    delta = 0.0012 + 1.75e-5 + 2.738e-3 + 4.223e-3
    np.testing.assert_allclose(measured.of("deformation"), [0.02 - delta, 0.0084 - delta], rtol=2e-3)
    assert measured.faults.tolist() == ["", "its deformation is below 0.0005"]
    assert measured.conditions[:3] == pytest.approx((20e-6, 0.04e-9, 5.38e-3), rel=1e-3)
    assert measured.conditions.origin == "CellCarrier at 23 °C by buyukurganci-2022"
    assert measured.groups.tolist() == ["beads", "beads"]
    assert np.isnan(read_measured(path, error=0.002).of("areaError")[0])
    assert read_measured(path, error=0.002).of("deformationError")[0] == 0.002
    both = read_all([path, path], by="file")
    assert both.n == 4
    assert both.ids.tolist()[:1] == ["cells/0"]
    setup["chip region"] = "reservoir"
    with pytest.raises(InputError, match="its events were seen in the reservoir"):
        read_measured(write_rtdc(tmp_path / "b.rtdc", [50.0], [0.02], **more))


def test_pixels_make_the_noise_that_is_assumed():
    """Hulls of the pixels inside circles and ellipses, at places at random."""
    from scipy.spatial import ConvexHull
    from scipy.special import ellipe

    random, r, spreads, means = np.random.default_rng(0), 16.0, [], []
    grid = np.stack(np.meshgrid(*2 * [np.arange(-20.0, 21.0)]), axis=-1)
    for ratio in (1.0, 1.15):
        a, b = r * ratio, r / ratio
        hulls = [
            ConvexHull(grid[(((grid - random.uniform(-0.5, 0.5, 2)) / (a, b)) ** 2).sum(axis=-1) <= 1.0])
            for _ in range(200)
        ]
        seen = np.array([1.0 - 2.0 * np.sqrt(np.pi * hull.volume) / hull.area for hull in hulls])
        spreads.append(seen.std())
        means.append(seen.mean() - (1.0 - np.pi * r / (2.0 * a * ellipe(1.0 - (b / a) ** 2))))
    noise, _ = pixel_noise(np.array([np.pi * r**2]), 1.0)
    assert spreads[0] < noise[0] < spreads[1] < 2.0 * noise[0]
    # dclab's law for these has .0059.
    np.testing.assert_allclose(means, 0.0059, rtol=0.05)


def test_groups_are_those_of_a_column(tmp_path):
    path = table(tmp_path, "d [um],strain,sample\n10,0.1,a\n11,0.2,b\n")
    assert read_measured(path, by="sample").groups.tolist() == ["a", "b"]
    with pytest.raises(InputError, match="no column day, by which bodies are grouped"):
        read_measured(path, by="day")


def test_a_measurement_names_its_extra(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "dclab", None)
    path = table(tmp_path, "", "cells.rtdc")
    with pytest.raises(InputError, match=r"files of dclab need dclab: pip install 'foamprb\[cytometry\]'"):
        read_measured(path)
