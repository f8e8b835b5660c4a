"""Jobs for loss tools: what the files hold. `make interop` runs them."""

from __future__ import annotations

import configparser
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from shaketable import Body, InputError, Motion
from shaketable.fragility.nrml import NAMESPACE
from shaketable.hazard import Hazard, read_hazard
from shaketable.hazard.jobs import JOBS, exposure_of, write_jobs
from shaketable.hazard.objects import ObjectRates, object_rates
from shaketable.inventory import Item
from shaketable.signal.intensity import measure_named

SHELF = Body.rectangle(0.3, 1.8, name="shelf")
CHEST = Body.rectangle(3.0, 0.5, name="chest")
LEVELS = np.geomspace(0.02, 3.0, 30)
CURVE = Hazard(
    measure=measure_named("PGV"), levels=LEVELS, rates=1e-3 * LEVELS**-2.0, site=(8.5, 47.4)
)


@pytest.fixture(scope="module")
def rates(p695: list[Motion]) -> ObjectRates:
    items = [
        Item(body=SHELF, height=1.8, quantity=4, cost=100.0, building="Main house", floor="2"),
        Item(body=SHELF, height=1.8, quantity=2, cost=400.0),
        Item(body=Body.rectangle(0.35, 2.0, name="tall (A/B)"), height=2.0, quantity=3),
        Item(body=CHEST, height=0.5, cost=9.0),
    ]
    return object_rates(items, p695[:24], CURVE, draws=0)


@pytest.fixture(scope="module")
def folder(rates: ObjectRates, tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("jobs")
    write_jobs(rates, place, JOBS)
    return place


def test_every_file_of_a_job_is_there(folder: Path) -> None:
    for name in ("damage", "risk"):
        job = configparser.ConfigParser()
        job.read(folder / f"openquake_{name}.ini")
        files = [
            value for section in job.sections() for key, value in job[section].items()
            if key.endswith(("_file", "_csv"))
        ]  # fmt: skip
        assert len(files) == 4
        assert all((folder / value).exists() for value in files)
        assert job["general"]["calculation_mode"].startswith("classical_")


def test_the_exposure_is_the_list(folder: Path, rates: ObjectRates) -> None:
    assets = pd.read_csv(folder / "openquake_assets.csv")
    assert assets["number"].tolist() == [4, 2, 3]  # of the chest there is no function
    assert assets["contents"].tolist() == [400.0, 800.0, 3.0]
    assert assets["building"].tolist() == ["Main_house", "none", "none"]
    assert set(zip(assets["lon"], assets["lat"], strict=True)) == {(8.5, 47.4)}
    mapping = pd.read_csv(folder / "openquake_taxonomy_mapping.csv").set_index("taxonomy")
    assert (mapping["weight"] == 1).all()
    functions = mapping.loc[assets["taxonomy"], "risk_id"].tolist()
    assert functions[0] == functions[1] != functions[2]
    root = ET.parse(folder / "openquake_fragility.xml").getroot()
    there = {each.get("id") for each in root.iter(f"{{{NAMESPACE}}}fragilityFunction")}
    assert there == set(functions) == set(exposure_of(rates).functions)


def test_a_vulnerability_function_is_the_probability_of_a_fall(
    folder: Path, rates: ObjectRates
) -> None:
    root = ET.parse(folder / "openquake_vulnerability.xml").getroot()
    function = root.find(f".//{{{NAMESPACE}}}vulnerabilityFunction")
    assert function is not None
    levels, losses = (
        np.array((function.findtext(f"{{{NAMESPACE}}}{name}") or "").split(), float)
        for name in ("imls", "meanLRs")
    )
    assert losses == pytest.approx(rates.rates[0].curve.probability(levels / 100.0), abs=1e-6)
    assert losses[0] < 1e-4 and losses[-1] > 0.999  # noqa: PT018


def test_the_hazard_is_read_again_as_it_was(folder: Path) -> None:
    again = read_hazard(folder / "openquake_hazard_curves.csv")
    assert again.site == (8.5, 47.4)
    at = np.array([0.05, 0.3, 1.0])
    assert again.rate(at) == pytest.approx(CURVE.rate(at), rel=1e-4)


def test_pelicun_has_quantities_and_costs(folder: Path, rates: ObjectRates) -> None:
    quantities = pd.read_csv(folder / "CMP_QNT.csv", index_col=0)
    shelf, tall = dict.fromkeys(exposure_of(rates).functions)
    assert quantities["Theta_0"].to_dict() == {shelf: 6, tall: 3}
    library = pd.read_csv(folder / "fragility.csv", index_col=0)
    assert set(library["Demand-Type"]) == {"Peak Ground Velocity"}
    costs = pd.read_csv(folder / "consequence_repair.csv", index_col=0)
    # of 4 shelves of 100 and 2 of 400 a piece costs 200 on average
    assert costs.loc[f"{shelf}-Cost", "DS1-Theta_0"] == pytest.approx(200.0)
    assert costs.loc[f"{shelf}-Cost", "Incomplete"] == 0
    assert costs.loc[f"{tall}-Cost", "Incomplete"] == 1
    assert np.isnan(costs.loc[f"{tall}-Cost", "DS1-Theta_0"])


def test_nothing_is_written_without_functions(p695: list[Motion], tmp_path: Path) -> None:
    rates = object_rates([Item(body=CHEST, height=0.5)], p695[:24], CURVE, draws=0)
    with pytest.raises(InputError, match="nothing can be exported"):
        write_jobs(rates, tmp_path, JOBS)
