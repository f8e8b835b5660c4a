"""Hazard curves in the files of OpenQuake, the USGS, and in tables."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError
from shaketable.hazard import read_hazard
from shaketable.units import STANDARD_GRAVITY as G

OPENQUAKE = (
    "#,,,\"generated_by='OpenQuake engine 3.26.0', start_date='2026-01-01T00:00:00', "
    "checksum=1, kind='mean', investigation_time=50.0, imt='PGA'\"\n"
    "lon,lat,depth,poe-0.0500000,poe-0.1000000,poe-0.4000000\n"
    "8.50000,47.40000,0.00000,6.3E-01,2.1E-01,1.0E-02\n"
    "9.50000,47.40000,0.00000,5.3E-01,1.1E-01,5.0E-03\n"
)
NSHM = (
    "name,lon,lat,0.0233,0.0523,0.354,1.2\n"
    "Los Angeles,-118.25,34.05,0.41,0.18,6.1E-03,0.0\n"
    "San Diego,-117.15,32.7,0.21,0.08,2.1E-03,0.0\n"
)
ANSWER = {
    "status": "success",
    "response": {
        "hazardCurves": [
            {
                "imt": {"value": name},
                "data": [
                    {"component": "Fault", "values": {"xs": [0.1, 0.2], "ys": [0.01, 0.001]}},
                    {"component": "Total", "values": {"xs": [0.1, 0.2], "ys": [0.02, 0.002]}},
                ],
            }
            for name in ("PGA", "SA1P0")
        ]
    },
}


def test_openquake(tmp_path: Path) -> None:
    """Rates are -ln(1 - poe)/T, levels of PGA in g."""
    path = tmp_path / "hazard_curve-mean-PGA_1.csv"
    path.write_text(OPENQUAKE)
    found = read_hazard(path, site=(9.4, 47.4))
    assert found.measure.name == "PGA"
    assert found.site == (9.5, 47.4)
    assert found.levels == pytest.approx([0.05 * G, 0.1 * G, 0.4 * G])
    assert found.rates == pytest.approx(-np.log1p([-0.53, -0.11, -0.005]) / 50.0)


def test_openquake_with_names_of_sites(tmp_path: Path) -> None:
    """A column of texts beside those that are needed."""
    path = tmp_path / "curve.csv"
    first, head, *rows = OPENQUAKE.splitlines()
    path.write_text("\n".join([f"{first}", f"custom_site_id,{head}", *(f"x,{r}" for r in rows)]))
    assert read_hazard(path, site=(9.4, 47.4)).site == (9.5, 47.4)


def test_openquake_where_it_is_certain(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    path = tmp_path / "curve.csv"
    path.write_text(OPENQUAKE.replace("6.3E-01", "1.0E+00"))
    assert read_hazard(path, site=(9.5, 47.4)).levels.size == 3  # it is certain elsewhere
    assert not caplog.text
    assert read_hazard(path, site=(8.5, 47.4)).levels.size == 2
    assert "1 of 3 levels are left out, as a probability of 1 tells no rate" in caplog.text


def test_usgs_csv(tmp_path: Path) -> None:
    """Annual rates; the folder tells the measure; a rate of 0 ends the curve."""
    folder = tmp_path / "SA1P0"
    folder.mkdir()
    path = folder / "curves.csv"
    path.write_text(NSHM)
    found = read_hazard(path, site=(-117.2, 32.7))
    assert found.measure.name == "SA(1.0)"
    assert found.levels == pytest.approx(np.array([0.0233, 0.0523, 0.354, 1.2]) * G)
    assert found.rates.tolist() == [0.21, 0.08, 2.1e-3, 0.0]
    elsewhere = tmp_path / "curves.csv"
    elsewhere.write_text(NSHM)
    with pytest.raises(InputError, match="does not say of which measure"):
        read_hazard(elsewhere, site=(-117.2, 32.7))
    assert read_hazard(elsewhere, site=(-118.2, 34.0), measure="PGV").levels[0] == pytest.approx(
        0.000233
    )


def test_usgs_json(tmp_path: Path) -> None:
    path = tmp_path / "answer.json"
    path.write_text(json.dumps(ANSWER))
    found = read_hazard(path, measure="SA(1.0)")
    assert found.rates.tolist() == [0.02, 0.002]  # of the total
    assert found.levels == pytest.approx([0.1 * G, 0.2 * G])
    with pytest.raises(InputError, match=r"has curves of PGA, SA\(1.0\); give measure="):
        read_hazard(path)
    with pytest.raises(InputError, match=r"has no curve of PGV; it has PGA, SA\(1.0\)"):
        read_hazard(path, measure="PGV")


@pytest.mark.parametrize(
    ("text", "given", "first"),
    [
        ("PGV [cm/s], annual rate\n5, 0.12\n10, 0.04\n", {}, 0.05),
        ("PGV (m/s); rate\n0,05; 0,12\n0,1; 0,04\n", {}, 0.05),
        ("x,frequency\n5,0.12\n10,0.04\n", {"measure": "PGV", "units": "cm/s"}, 0.05),
        ("SA(1.0) [g],rate\n0.05,0.12\n0.1,0.04\n", {}, 0.05 * G),
        ("PGA [%g],rate\n5,0.12\n10,0.04\n", {}, 0.05 * G),
    ],
)
def test_two_columns(tmp_path: Path, text: str, given: dict[str, str], first: float) -> None:
    path = tmp_path / "hazard.csv"
    path.write_text(text)
    found = read_hazard(path, **given)
    assert found.levels[0] == pytest.approx(first)
    assert found.rates.tolist() == [0.12, 0.04]


@pytest.mark.parametrize(
    ("header", "given", "percent"),
    [
        ("PE50", {}, 1.0),
        ("PoE 50", {}, 1.0),
        ("50-year exceedance", {}, 1.0),
        ("probability in 50 years", {}, 1.0),
        ("PE in 50 yr [%]", {}, 100.0),
        ("PE in 50 years (generated)", {}, 1.0),
        ("chance", {"exposure": 50.0}, 1.0),
        ("PoE", {"exposure": 50.0}, 1.0),
    ],
)
def test_probabilities_in_some_years_become_rates(
    tmp_path: Path, header: str, given: dict[str, float], percent: float
) -> None:
    """As annual rates, 10 % in 50 years would be 40 to 50 times too often: -ln(0.9)/50."""
    path = tmp_path / "hazard.csv"
    path.write_text(f"PGV [cm/s],{header}\n5,{0.1 * percent}\n10,{0.02 * percent}\n")
    found = read_hazard(path, **given)
    assert found.rates == pytest.approx([2.107210e-3, 4.040541e-4], rel=1e-6)


def test_an_annual_probability_is_one_in_a_year(tmp_path: Path) -> None:
    """-ln(1 - 0.5) = 0.693 a year, where 0.5 would be too seldom."""
    path = tmp_path / "hazard.csv"
    path.write_text("PGV [cm/s],annual probability of exceedance\n5,0.5\n10,0.1\n")
    assert read_hazard(path).rates == pytest.approx([0.6931472, 0.1053605], rel=1e-6)


@pytest.mark.parametrize(
    ("text", "given", "message"),
    [
        (OPENQUAKE, {}, "has curves of 2 sites; give site="),
        (OPENQUAKE, {"site": (2.0, 47.4)}, "off the grid: the nearest curve, at 8.5, 47.4"),
        (OPENQUAKE, {"measure": "PGV"}, "has curves of PGA, not of PGV"),
        (OPENQUAKE.replace("6.3E-01", "63.0"), {"site": (8.5, 47.4)}, "are these percents"),
        (OPENQUAKE.replace("2.1E-01", "9.1E-01"), {"site": (8.5, 47.4)}, "rate rises with"),
        (OPENQUAKE.replace("imt='PGA'", "x=1"), {}, "begin with a comment that has"),
        (OPENQUAKE.replace("2.1E-01", "n/a"), {}, "line 3, poe-0.1000000: expected a number"),
        (OPENQUAKE.replace("poe-0.05", "poe-x"), {}, "a column poe-... has no level"),
        ("PGV [cm/s],rate\n5,12\n10,40\n", {}, "the rate rises with the level"),
        ("PGV [cm/s],rate [%]\n5,12\n10,4\n", {}, "whether it is an annual rate"),
        ("PGV [cm/s],rate [%]\n5,12\n10,4\n", {"exposure": 50.0}, "whether it is an annual rate"),
        ("PGV [cm/s],50-year exceedance of 2\n5,1.2\n10,0.4\n", {}, "goes from 0.4 to 1.2"),
        ("PGV [cm/s],annual rate\n5,0.12\n10,0.04\n", {"exposure": 50.0}, "needs no years"),
        ("PGV [cm/s],exceedance\n5,0.12\n10,0.04\n", {}, "whether it is an annual rate"),
        ("PGV [cm/s],PoE\n5,0.12\n10,0.04\n", {}, "in how many years"),
        ("PGV [cm/s],Rate (50 years)\n5,0.12\n10,0.04\n", {}, "whether it is an annual rate"),
        ("PGV [g],rate\n5,0.12\n10,0.4\n", {}, "the unit 'g' is not one of PGV"),
        ("5,0.12\n10,0.04\n", {}, "has no header, which does not say whether"),
        ("level,rate\n5,0.12\n10,0.04\n", {}, "does not say of which measure"),
        ("PGA,rate\n5,0.12\n10,0.04\n", {"measure": "PGA"}, "does not say the unit of its levels"),
        ("a,b,c\n1,2,3\n", {}, "not a hazard curve as OpenQuake or the USGS write it"),
        ("PGV [cm/s],rate\n", {}, "needs two levels|as many levels"),
        ("", {}, "is empty"),
        ("{}", {}, "not hazard curves as the web services"),
        ('{"a":' * 100_000, {}, "not hazard curves as the web services"),
        ('{"response": {"hazardCurves": []}}', {"measure": "PGA"}, "has no curve of PGA"),
    ],
)
def test_bad_files(tmp_path: Path, text: str, given: dict[str, object], message: str) -> None:
    path = tmp_path / "hazard.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=message) as error:
        read_hazard(path, **given)
    assert "hazard.csv" in str(error.value)
