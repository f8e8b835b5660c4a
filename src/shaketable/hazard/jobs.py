"""Whole jobs for loss tools: what stands where, its functions, what its loss costs, the hazard.

OpenQuake (3.26) runs `openquake_damage.ini` and `openquake_risk.ini` as they are. The hazard curve
is that of the site, and each object is an asset of as many pieces; of an object the direction
counts in which it falls more often, as in `rates.csv`. pelicun (3) takes the library with its
quantities and costs; the demand at which it is asked comes from whoever asks.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from shaketable.atomic_files import write_csv
from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.fragility import Curve
from shaketable.fragility.exported import Export, Function, identifier_of, ordered, unit_of, word_of
from shaketable.fragility.lognormal import probability
from shaketable.fragility.nrml import NAMESPACE, write_nrml
from shaketable.fragility.pelicun import FILES, write_into
from shaketable.fragility.shown import SHOWN
from shaketable.hazard.curve import Hazard
from shaketable.hazard.objects import ObjectRate, ObjectRates
from shaketable.hazard.totals import BEYOND

OPENQUAKE, PELICUN = "openquake", "pelicun"
JOBS = (OPENQUAKE, PELICUN)
YEARS = 1.0  # of the probabilities of the hazard curve
STEPS = 200  # levels of the hazard curve and of vulnerability functions
LOWEST = 0.1  # of the first level of the curve: what is shaken by less loses nothing
QUANTITIES, COSTS = "CMP_QNT.csv", FILES[2]
DAMAGE = """\
[general]
description = {description}
calculation_mode = classical_damage

[exposure]
exposure_file = openquake_exposure.xml
taxonomy_mapping_csv = openquake_taxonomy_mapping.csv

[hazard]
hazard_curves_csv = openquake_hazard_curves.csv
asset_hazard_distance = 20000

[fragility]
contents_fragility_file = openquake_fragility.xml

[calculation]
investigation_time = {years:g}
risk_investigation_time = 1
"""
RISK = """\
[general]
description = {description}
calculation_mode = classical_risk

[exposure]
exposure_file = openquake_exposure.xml
taxonomy_mapping_csv = openquake_taxonomy_mapping.csv

[hazard]
hazard_curves_csv = openquake_hazard_curves.csv
asset_hazard_distance = 20000

[vulnerability]
contents_vulnerability_file = openquake_vulnerability.xml

[calculation]
investigation_time = {years:g}
risk_investigation_time = 1
lrem_steps_per_interval = 1
"""


@dataclass(frozen=True, eq=False)
class Exposure:
    """Objects with a function, and what is exported of these.

    Attributes:
        export: the functions, each once.
        objects: those that stand free and have one.
        functions: the identifier of each object's function, (object,).
    """

    export: Export
    objects: tuple[ObjectRate, ...]
    functions: tuple[str, ...]


def exposure_of(rates: ObjectRates) -> Exposure:
    """What is exported of the objects of a site.

    Raises:
        InputError: none of them has a function.
    """
    objects = [one for one in rates.of_objects().values() if not one.curve.problem]
    if not objects:
        raise InputError("no object has a fragility function: nothing can be exported")
    named: dict[Curve, str] = {}
    for one in objects:
        if one.curve not in named:
            where = f" floor {one.floor}" if one.floor else ""
            name = base = f"{one.item.name}{where} {one.direction}"
            count = 1
            while name in named.values():
                count += 1
                name = f"{base} {count}"
            named[one.curve] = name
    functions = {
        name: [Function(curve.state, curve.median, curve.beta, curve.caution)]
        for curve, name in named.items()
    }
    about = {name: _about(curve, rates) for curve, name in named.items()}
    written = tuple(ordered(functions, about))
    identifiers = {each.name: each.identifier for each in written}
    curve = objects[0].curve
    export = Export(
        functions=written,
        measure=rates.hazard.measure,
        place=curve.place,
        through_building=any(one.floor for one in objects),
        description=(
            f"Unanchored rigid bodies under {rates.motions} motions of {curve.recordings} "
            f"recordings of {curve.events} earthquakes; {rates.hazard.measure.name} of the ground "
            f"in {{unit}}, {_components(rates)}"
        ),
    )
    return Exposure(export, tuple(objects), tuple(identifiers[named[one.curve]] for one in objects))


def _components(rates: ObjectRates) -> str:
    return "any one component" if rates.components == "own" else f"the {rates.components} of both"


def _about(curve: Curve, rates: ObjectRates) -> str:
    body = curve.body
    assert isinstance(body, Body)
    return (
        f"Base {body.width:.4g} m in the plane of the shaking, centre of gravity at "
        f"{body.cg_height:.4g} m. The demand is {rates.hazard.measure.name} of the ground, "
        f"{_components(rates)}."
    )


def write_jobs(rates: ObjectRates, folder: Path, jobs: Sequence[str]) -> None:
    """Write jobs into a folder.

    Args:
        rates: what `object_rates` gives.
        folder: that is there.
        jobs: of JOBS.

    Raises:
        InputError: a measure that the tool does not know, or nothing to write.
    """
    exposure = exposure_of(rates)
    if OPENQUAKE in jobs:
        _write_openquake(exposure, rates.hazard, folder)
    if PELICUN in jobs:
        _write_pelicun(exposure, folder)


def _write_openquake(exposure: Exposure, hazard: Hazard, folder: Path) -> None:
    unit = unit_of(hazard.measure, SHOWN, "OpenQuake")
    place = folder / "openquake_"
    write_nrml(exposure.export, Path(f"{place}fragility.xml"))
    _write_xml(_vulnerability(exposure.export, hazard, unit.factor), f"{place}vulnerability.xml")
    _write_xml(_exposure_model(), f"{place}exposure.xml")
    write_csv(_assets(exposure, hazard), Path(f"{place}assets.csv"))
    mapping = {
        _taxonomy(one): function
        for one, function in zip(exposure.objects, exposure.functions, strict=True)
    }
    write_csv(
        pd.DataFrame({"taxonomy": list(mapping), "risk_id": list(mapping.values()), "weight": 1}),
        Path(f"{place}taxonomy_mapping.csv"),
    )
    _write_curve(exposure, hazard, unit.factor, Path(f"{place}hazard_curves.csv"))
    told = {"description": "falls of unanchored objects", "years": YEARS}
    Path(f"{place}damage.ini").write_text(DAMAGE.format(**told), encoding="utf-8")
    Path(f"{place}risk.ini").write_text(RISK.format(**told), encoding="utf-8")


def _taxonomy(one: ObjectRate) -> str:
    """What an object is called in an exposure: objects of one name may have several functions."""
    return f"{identifier_of(one.item.name)}_{one.number}"


def _write_xml(root: ET.Element, path: str) -> None:
    ET.indent(root)
    Path(path).write_bytes(ET.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n")


def _exposure_model() -> ET.Element:
    root = ET.Element("nrml", xmlns=NAMESPACE)
    model = ET.SubElement(
        root, "exposureModel", id="objects", category="contents", taxonomySource="shaketable"
    )
    ET.SubElement(
        model, "description"
    ).text = "Unanchored objects; the value of an asset is that of all its pieces"
    costs = ET.SubElement(ET.SubElement(model, "conversions"), "costTypes")
    ET.SubElement(costs, "costType", name="contents", type="aggregated", unit="USD")
    ET.SubElement(model, "occupancyPeriods")
    ET.SubElement(model, "tagNames").text = "building floor"
    ET.SubElement(model, "assets").text = "openquake_assets.csv"
    return root


def _assets(exposure: Exposure, hazard: Hazard) -> pd.DataFrame:
    """A row for each object; one without a cost has a value of 1 each."""
    rows = []
    for one in exposure.objects:
        lon, lat = _place(one, hazard)
        cost = 1.0 if one.item.cost is None else one.item.cost
        rows.append({
            "id": f"object_{one.number}", "lon": lon, "lat": lat, "taxonomy": _taxonomy(one),
            "number": one.item.quantity, "contents": one.item.quantity * cost,
            "building": word_of(one.item.building or "none"), "floor": word_of(one.floor or "0"),
        })  # fmt: skip
    return pd.DataFrame(rows)


def _place(one: ObjectRate, hazard: Hazard) -> tuple[float, float]:
    """Longitude and latitude at which an object stands [degrees]; 0, 0 where nothing says it."""
    return one.item.site or hazard.site or (0.0, 0.0)


def _vulnerability(export: Export, hazard: Hazard, factor: float) -> ET.Element:
    """What is lost on average: all of a piece that falls, nothing of one that stands.

    OpenQuake's classical calculation takes no probabilities of single losses, so that their spread
    is left out; losses of all pieces together are in `totals.csv`.
    """
    root = ET.Element("nrml", xmlns=NAMESPACE)
    model = ET.SubElement(
        root, "vulnerabilityModel", id="shaketable", assetCategory="contents",
        lossCategory="contents",
    )  # fmt: skip
    ET.SubElement(model, "description").text = export.description.replace("{unit}", "its unit")
    levels = _levels(hazard)
    for one in export.functions:
        curve = one.curves[-1]
        falls = probability(levels, np.array(curve.median), np.array(curve.beta))
        function = ET.SubElement(model, "vulnerabilityFunction", id=one.identifier, dist="LN")
        imls = ET.SubElement(function, "imls", imt=export.measure.name)
        imls.text = " ".join(f"{level:.8g}" for level in factor * levels)
        ET.SubElement(function, "meanLRs").text = " ".join(f"{each:.10g}" for each in falls)
        ET.SubElement(function, "covLRs").text = " ".join(["0"] * levels.size)
    return root


def _levels(hazard: Hazard) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Levels of the hazard curve, straight on beyond its ends as in `annual_rate` [SI]."""
    known = hazard.levels[: hazard.positive]
    return np.geomspace(LOWEST * known[0], known[-1] * (1.0 if hazard.ends else BEYOND), STEPS + 1)


def _write_curve(exposure: Exposure, hazard: Hazard, factor: float, path: Path) -> None:
    """The curve of the site, at the place of the first object where its file tells no other."""
    levels = _levels(hazard)
    chance = -np.expm1(-hazard.rate(levels) * YEARS)
    lon, lat = hazard.site or _place(exposure.objects[0], hazard)
    names = ",".join(f"poe-{level:.8g}" for level in factor * levels)
    values = ",".join(f"{each:.8g}" for each in chance)
    path.write_text(
        f"#,,\"generated_by='shaketable', investigation_time={YEARS}, "
        f"imt='{hazard.measure.name}'\"\nlon,lat,depth,{names}\n{lon},{lat},0.0,{values}\n",
        encoding="utf-8",
    )


def _write_pelicun(exposure: Exposure, folder: Path) -> None:
    write_into(folder, exposure.export, "ground", costs=_costs(exposure))
    quantity: dict[str, int] = {}
    for one, function in zip(exposure.objects, exposure.functions, strict=True):
        quantity[function] = quantity.get(function, 0) + one.item.quantity
    rows = [
        {"ID": name, "Units": "ea", "Location": 1, "Direction": 1, "Theta_0": count,
         "Blocks": count, "Family": "", "Theta_1": "", "Comment": "all of this kind"}
        for name, count in quantity.items()
    ]  # fmt: skip
    write_csv(pd.DataFrame(rows), folder / QUANTITIES)


def _costs(exposure: Exposure) -> Mapping[str, float]:
    """What a piece with each function costs, where its list says it: on average over the pieces."""
    pieces: dict[str, list[tuple[int, float | None]]] = {}
    for one, function in zip(exposure.objects, exposure.functions, strict=True):
        pieces.setdefault(function, []).append((one.item.quantity, one.item.cost))
    found = {}
    for function, each in pieces.items():
        known = [(count, cost) for count, cost in each if cost is not None]
        if len(known) == len(each):
            found[function] = sum(n * cost for n, cost in known) / sum(n for n, _ in known)
    return found
