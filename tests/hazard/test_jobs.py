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
from shaketable.hazard.exported import exported_objects
from shaketable.hazard.jobs import JOBS, require_measure, write_jobs
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
    """Of the chest there is no function, and of the tall thing no cost: neither is in it."""
    assets = pd.read_csv(folder / "openquake_assets.csv")
    assert assets["number"].tolist() == [4, 2]
    assert assets["contents"].tolist() == [400.0, 800.0]
    assert assets["building"].tolist() == ["Main_house", "none"]
    assert set(zip(assets["lon"], assets["lat"], strict=True)) == {(8.5, 47.4)}
    mapping = pd.read_csv(folder / "openquake_taxonomy_mapping.csv").set_index("taxonomy")
    assert (mapping["weight"] == 1).all()
    functions = mapping.loc[assets["taxonomy"], "risk_id"].tolist()
    root = ET.parse(folder / "openquake_fragility.xml").getroot()
    there = {each.get("id") for each in root.iter(f"{{{NAMESPACE}}}fragilityFunction")}
    assert there == set(functions) == set(exported_objects(rates).functions)
    assert "currency of the list" in (folder / "openquake_exposure.xml").read_text()


def test_what_is_left_out_is_told(folder: Path) -> None:
    told = pd.read_csv(folder / "left_out.csv").set_index("object")["why"]
    assert "no simulation reaches overturns" in told["4: chest"]
    assert told["3: tall (A/B)"] == "it has no replacement cost, and others have"


def test_without_costs_pieces_are_counted(p695: list[Motion], tmp_path: Path) -> None:
    items = [Item(body=SHELF, height=1.8, quantity=4), Item(body=SHELF, height=1.8)]
    write_jobs(object_rates(items, p695[:24], CURVE, draws=0), tmp_path, JOBS)
    assert pd.read_csv(tmp_path / "openquake_assets.csv")["contents"].tolist() == [4.0, 1.0]
    assert 'unit="pieces"' in (tmp_path / "openquake_exposure.xml").read_text()
    costs = pd.read_csv(tmp_path / "consequence_repair.csv")
    assert (costs["Incomplete"] == 1).all()


def test_a_curve_that_ends_at_zero_ends_there_for_openquake(
    p695: list[Motion], tmp_path: Path
) -> None:
    """Its classical calculation takes the rates between the first level and the last: see there."""
    ends = Hazard(
        measure=CURVE.measure, levels=np.append(LEVELS, 4.0), rates=np.append(CURVE.rates, 0.0)
    )
    write_jobs(object_rates([Item(body=SHELF, height=1.8)], p695[:24], ends, draws=0), tmp_path,
               JOBS)  # fmt: skip
    head, row = (tmp_path / "openquake_hazard_curves.csv").read_text().splitlines()[1:]
    values = dict(zip(head.split(","), row.split(","), strict=True))
    last = [float(value) for name, value in values.items() if name.startswith("poe-")][-2:]
    assert last == [0.0, 0.0]


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
    first, second = exported_objects(rates).functions
    assert quantities["Theta_0"].to_dict() == {first: 4, second: 2}
    assert set(quantities["Blocks"]) == {1}
    library = pd.read_csv(folder / "fragility.csv", index_col=0)
    assert set(library["Demand-Type"]) == {"Peak Ground Velocity"}
    costs = pd.read_csv(folder / "consequence_repair.csv", index_col=0)
    assert costs.loc[f"{first}-Cost", "DS1-Theta_0"] == 100.0
    assert costs.loc[f"{second}-Cost", "DS1-Theta_0"] == 400.0
    assert costs.loc[f"{first}-Cost", "Incomplete"] == 0


def test_a_measure_that_a_tool_does_not_know_is_refused_at_once() -> None:
    require_measure(measure_named("PGD"), ["openquake"])
    with pytest.raises(InputError, match="pelicun knows no measure PGD"):
        require_measure(measure_named("PGD"), JOBS)


def test_nothing_is_written_without_functions(p695: list[Motion], tmp_path: Path) -> None:
    rates = object_rates([Item(body=CHEST, height=0.5)], p695[:24], CURVE, draws=0)
    with pytest.raises(InputError, match="its losses cannot be computed"):
        write_jobs(rates, tmp_path, JOBS)
