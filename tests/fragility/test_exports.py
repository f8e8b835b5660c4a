"""Files for OpenQuake and pelicun, against facts of their schemas."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy.stats import lognorm

from shaketable import Body, Fragility, InputError, Motion, fragility, suite
from shaketable.fragility import Uncertain, UncertainBody, uncertain_fragility
from shaketable.fragility.nrml import NAMESPACE, moments
from shaketable.origin import Origin

STATES = ("rocks 0.5 α", "overturns")
BODIES = [
    Body.rectangle(0.32, 1.8, name="bookcase 1.80 m"),
    Body.rectangle(0.4, 1.2, name="cabinet"),
    Body.rectangle(2.0, 1.0, name="crate"),  # nothing moves it
]


@pytest.fixture(scope="module")
def far_field() -> list[Motion]:
    return suite("fema-p695-far-field")


@pytest.fixture(scope="module")
def found(far_field: list[Motion]) -> Fragility:
    return fragility(BODIES, far_field, limit_states=STATES, draws=0, tilt=0.01)


def tag(name: str) -> str:
    return f"{{{NAMESPACE}}}{name}"


def test_nrml(found: Fragility, tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    path = tmp_path / "fragility.xml"
    found.to_nrml(path)
    assert "1 of 3 bodies are not exported, as a state of theirs has no fit: crate" in caplog.text
    model = ET.parse(path).getroot().find(tag("fragilityModel"))
    assert model is not None
    assert model.get("lossCategory") == "contents"
    states = model.findtext(tag("limitStates"), "").split()
    assert states == ["rocks_0_5_alpha", "overturns"]
    # OpenQuake takes letters, digits and underscores here
    assert all(re.fullmatch(r"[A-Za-z_]\w*", state) for state in states)
    functions = model.findall(tag("fragilityFunction"))
    assert [one.get("id") for one in functions] == ["bookcase_1.80_m", "cabinet"]
    for k, one in enumerate(functions):
        assert (one.get("format"), one.get("shape")) == ("continuous", "logncdf")
        imls = one.find(tag("imls"))
        assert imls is not None
        assert imls.get("imt") == "PGV"
        least, most = (float(imls.get(name, "")) for name in ("minIML", "maxIML"))
        assert imls.get("noDamageLimit") is None  # it would cut off up to 3 % of a risk
        curves = found.curves[2 * k : 2 * k + 2]
        assert curves[0].probability(least / 100.0) == pytest.approx(1e-6, rel=1e-4)
        assert curves[1].probability(most / 100.0) == pytest.approx(1.0 - 1e-6, rel=1e-9)
        for state, curve, each in zip(states, curves, one.findall(tag("params")), strict=True):
            assert each.get("ls") == state
            mean, deviation = (float(each.get(name, "")) for name in ("mean", "stddev"))
            assert (mean, deviation) == pytest.approx(moments(100 * curve.median, curve.beta))
            known = lognorm(curve.beta, scale=100 * curve.median)  # cm/s
            assert (mean, deviation) == pytest.approx((known.mean(), known.std()), rel=1e-6)


def test_discrete_nrml(found: Fragility, tmp_path: Path) -> None:
    found.to_nrml(tmp_path / "f.xml", form="discrete")
    function = next(ET.parse(tmp_path / "f.xml").getroot().iter(tag("fragilityFunction")))
    assert function.get("format") == "discrete"
    imls = function.find(tag("imls"))
    assert imls is not None
    levels = np.array((imls.text or "").split(), float)
    assert (np.diff(levels) > 0.0).all()
    for curve, poes in zip(found.curves, function.findall(tag("poes")), strict=False):
        chance = np.array((poes.text or "").split(), float)
        assert chance == pytest.approx(curve.probability(levels / 100.0), rel=1e-6)


def test_accelerations_are_in_g(far_field: list[Motion], tmp_path: Path) -> None:
    some = fragility(BODIES[0], far_field, measure="SA(1.0)", draws=0)
    some.to_nrml(tmp_path / "f.xml")
    text = (tmp_path / "f.xml").read_text()
    assert 'imt="SA(1.0)"' in text
    mean = float(re.search(r'mean="([0-9.]+)"', text)[1])
    assert mean == pytest.approx(moments(some.median / 9.80665, some.beta)[0], rel=1e-6)
    some.to_pelicun(tmp_path / "p")
    row = pd.read_csv(tmp_path / "p" / "fragility.csv").iloc[0]
    assert row["Demand-Type"] == "Spectral Acceleration|1.0"
    assert row["Demand-Unit"] == "g"
    assert row["LS1-Theta_0"] == pytest.approx(some.median / 9.80665, rel=1e-5)


def test_pelicun(found: Fragility, tmp_path: Path) -> None:
    found.to_pelicun(tmp_path / "p", demand="ground")
    table = pd.read_csv(tmp_path / "p" / "fragility.csv").set_index("ID")
    assert table.index.tolist() == ["bookcase_1.80_m", "cabinet"]
    row = table.loc["cabinet"]
    assert (row["Demand-Type"], row["Demand-Unit"]) == ("Peak Ground Velocity", "mps")
    assert (row["Demand-Offset"], row["Demand-Directional"], row["Incomplete"]) == (0, 1, 0)
    curve = found.curves[3]
    assert row["LS2-Theta_0"] == pytest.approx(curve.median, rel=1e-5)
    assert row["LS2-Theta_1"] == pytest.approx(curve.beta, rel=1e-5)
    down, up = (float(share) for share in row["LS2-DamageStateWeights"].split("|"))
    assert down + up == pytest.approx(1.0, abs=1e-12)
    assert down == pytest.approx(curve.downhill, abs=1e-6)
    assert np.isnan(row["LS1-DamageStateWeights"])
    told = json.loads((tmp_path / "p" / "fragility.json").read_text())
    states = told["cabinet"]["LimitStates"]
    assert {name: list(each) for name, each in states.items()} == {
        "LS1": ["DS1"], "LS2": ["DS2", "DS3"],
    }  # fmt: skip
    frame = pd.read_csv(tmp_path / "p" / "consequence_repair.csv")
    assert frame["ID"].tolist()[:2] == ["bookcase_1.80_m-Cost", "bookcase_1.80_m-Time"]
    assert {"DS3-Theta_0", "Quantity-Unit", "DV-Unit"} <= set(frame.columns)
    found.to_pelicun(tmp_path / "floor")
    table = pd.read_csv(tmp_path / "floor" / "fragility.csv")
    assert set(table["Demand-Type"]) == {"Peak Floor Velocity"}


def test_functions_that_cross_are_told(
    found: Fragility, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    flat = found.curves[1].fits._replace(beta=3.0 * found.curves[1].fits.beta)
    curves = (found.curves[0], replace(found.curves[1], fits=flat), *found.curves[2:])
    replace(found, curves=curves).to_nrml(tmp_path / "f.xml")
    assert "rocks 0.5 α and overturns cross, as they were fitted each by itself" in caplog.text


def test_bad_input(found: Fragility, far_field: list[Motion], tmp_path: Path) -> None:
    arias = fragility(BODIES[0], far_field, measure="Tm", scales=(1.0, 2.0), draws=0)
    for write in (arias.to_nrml, arias.to_pelicun):
        with pytest.raises(InputError, match="knows no measure Tm; it takes PGA, SA"):
            write(tmp_path / "x")
    with pytest.raises(InputError, match="form= must be one of continuous, discrete"):
        found.to_nrml(tmp_path / "f.xml", form="table")
    with pytest.raises(InputError, match="demand= must be one of ground, floor"):
        found.to_pelicun(tmp_path / "p", demand="roof")
    with pytest.raises(InputError, match="nothing can be exported: no simulation reaches"):
        fragility(BODIES[2], far_field[:4], draws=0).to_nrml(tmp_path / "f.xml")
    found.to_pelicun(tmp_path / "p")
    with pytest.raises(InputError, match="overwrite"):
        found.to_pelicun(tmp_path / "p")
    found.to_pelicun(tmp_path / "p", overwrite=True)


def test_tilt_and_components_are_told(far_field: list[Motion], tmp_path: Path) -> None:
    """A reader must not take a function of a tilted support for that of a level one."""
    given = fragility(
        BODIES[0], far_field, tilt=0.0873, components="geometric mean", draws=0
    ).with_more_beta(0.25)
    given.to_nrml(tmp_path / "one.xml")
    said = (tmp_path / "one.xml").read_text()
    assert "of both horizontal directions, by their geometric mean of the ground, on a" in said
    assert "tilted by 5°" in said
    assert "β with 0.25 for what is not known" in said
    given.to_pelicun(tmp_path / "library")
    told = json.loads((tmp_path / "library" / "fragility.json").read_text())
    assert "geometric mean" in told["bookcase_1.80_m"]["Comments"]
    row = pd.read_csv(tmp_path / "library" / "fragility.csv").iloc[0]
    bare = fragility(BODIES[0], far_field, tilt=0.0873, components="geometric mean", draws=0)
    assert row["LS1-Theta_1"] == pytest.approx(np.hypot(bare.beta, 0.25), rel=1e-5)
    assert row["LS1-Theta_0"] == pytest.approx(bare.median, rel=1e-5)


def test_an_uncertain_object_is_exported(far_field: list[Motion], tmp_path: Path) -> None:
    shelf = UncertainBody(base=Uncertain.normal(0.32, 0.02), height=1.8, name="shelf")
    found = uncertain_fragility(shelf, far_field[:20], members=8, draws=0)
    found.fragility.to_pelicun(tmp_path / "library")
    row = pd.read_csv(tmp_path / "library" / "fragility.csv").iloc[0]
    assert row["ID"] == "shelf"
    assert row["LS1-Theta_1"] == pytest.approx(found.curve.beta, rel=1e-5)


def test_the_demand_follows_from_what_the_functions_are_of(
    far_field: list[Motion], tmp_path: Path
) -> None:
    """With the building in the functions a floor's demand would count it twice: 93 % for 49 %."""
    ground, body = far_field[:20], BODIES[:1]
    floors = [replace(motion.scaled(2.5), name=motion.name) for motion in ground]
    of_ground = fragility(body, floors, ground=ground, draws=0)
    assert of_ground.through_building
    of_ground.to_pelicun(tmp_path / "a")
    (row,) = pd.read_csv(tmp_path / "a" / "fragility.csv").to_dict("records")
    assert row["Demand-Type"] == "Peak Ground Velocity"
    assert row["LS1-Theta_0"] == pytest.approx(of_ground.median, rel=1e-5)
    told = json.loads((tmp_path / "a" / "fragility.json").read_text(encoding="utf-8"))
    assert "with the body on a floor of a building above it" in told["bookcase_1.80_m"]["Comments"]
    with pytest.raises(InputError, match="would count it twice"):
        of_ground.to_pelicun(tmp_path / "b", demand="floor")
    own = fragility(body, ground, draws=0)
    own.to_pelicun(tmp_path / "c")
    (row,) = pd.read_csv(tmp_path / "c" / "fragility.csv").to_dict("records")
    assert row["Demand-Type"] == "Peak Floor Velocity"
    roof = [
        replace(motion, origin=replace(motion.origin or Origin(), location="Roof"))
        for motion in ground
    ]
    upstairs = fragility(body, roof, draws=0)
    with pytest.raises(InputError, match="demand='ground'"):
        upstairs.to_pelicun(tmp_path / "d", demand="ground")
    with pytest.raises(InputError, match="OpenQuake's intensity is"):
        upstairs.to_nrml(tmp_path / "f.xml")


def test_few_recordings_tell_no_function_and_few_earthquakes_no_interval(
    far_field: list[Motion], tmp_path: Path
) -> None:
    def of(motions: list[Motion]) -> Fragility:
        return fragility(BODIES[:1], motions, draws=100)

    two = of(far_field[:4])  # both components of two recordings
    assert two.curve.problem == "2 recordings tell no median: give 3 or more"
    assert np.isnan([two.median, *two.median_interval]).all()
    three = of(far_field[:6])
    assert three.curve.events == 2  # of Northridge two
    assert np.isfinite(three.median)
    assert np.isnan([*three.median_interval, *three.beta_interval]).all()
    assert "no interval can be told" in three.curve.caution
    low, high = three.curve.band([0.5])
    assert np.isnan([low, high]).all()
    three.to_nrml(tmp_path / "f.xml")
    assert "no interval can be told" in (tmp_path / "f.xml").read_text(encoding="utf-8")
    assert "no interval can be told" in three.table()["caution"][0]
    nine = of(far_field[:16])
    assert 4 <= nine.curve.events < 10
    assert np.isfinite(nine.median_interval).all()
    assert "too narrow more often than they should be" in nine.curve.caution
    assert of(far_field).curve.caution == ""
