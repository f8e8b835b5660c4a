"""Jobs that OpenQuake (3.26) runs as they are, for the objects of one site.

Each object is an asset of as many pieces, and counts in the direction in which it falls more often,
as in `rates.csv`. The hazard curve is that of the site.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.atomic_files import write_csv
from shaketable.fragility.exported import Export, identifier_of, unit_of, word_of
from shaketable.fragility.lognormal import probability
from shaketable.fragility.nrml import NAMESPACE, write_nrml
from shaketable.fragility.shown import SHOWN, MeasureUnit
from shaketable.hazard.curve import Hazard
from shaketable.hazard.exceedance import BEYOND
from shaketable.hazard.exported import ExportedObjects
from shaketable.hazard.exposure import Exposure
from shaketable.hazard.objects import ObjectRate

#: The units in which it takes measures, and its name.
READER = SHOWN, "OpenQuake"
YEARS = 1.0  # of the probabilities of the hazard curve
STEPS = 200  # levels of the hazard curve and of vulnerability functions
LOWEST = 0.1  # of the first level of the curve: what is shaken by less loses nothing
JOB = """\
[general]
description = falls of unanchored objects
calculation_mode = {mode}

[exposure]
exposure_file = openquake_exposure.xml
taxonomy_mapping_csv = openquake_taxonomy_mapping.csv

[hazard]
hazard_curves_csv = openquake_hazard_curves.csv
asset_hazard_distance = 50

[{functions}]
contents_{functions}_file = openquake_{functions}.xml

[calculation]
investigation_time = {years:g}
risk_investigation_time = 1
"""
#: By the ending of a job's name: its mode, the functions that it takes, and what else it needs.
MODES = {
    "damage": ("classical_damage", "fragility", ""),
    "risk": ("classical_risk", "vulnerability", "lrem_steps_per_interval = 1\n"),
}


def write_openquake(exported: ExportedObjects, hazard: Hazard, folder: Path) -> None:
    """Write a classical damage and a classical risk job into a folder.

    Raises:
        InputError: a measure that OpenQuake does not know.
    """
    exposure, export = exported.exposure, exported.export
    unit = unit_of(hazard.measure, *READER)
    place = folder / "openquake_"
    write_nrml(export, Path(f"{place}fragility.xml"))
    _write_xml(_vulnerability(export, hazard, unit), f"{place}vulnerability.xml")
    _write_xml(_exposure_model(exposure), f"{place}exposure.xml")
    write_csv(_assets(exposure, hazard), Path(f"{place}assets.csv"))
    taxonomies = [_taxonomy(one) for one in exposure.objects]
    write_csv(
        pd.DataFrame({"taxonomy": taxonomies, "risk_id": exported.functions, "weight": 1}),
        Path(f"{place}taxonomy_mapping.csv"),
    )
    _write_curve(exposure, hazard, unit.factor, Path(f"{place}hazard_curves.csv"))
    for name, (mode, functions, more) in MODES.items():
        job = JOB.format(mode=mode, functions=functions, years=YEARS) + more
        Path(f"{place}{name}.ini").write_text(job, encoding="utf-8")


def _taxonomy(one: ObjectRate) -> str:
    """What an object is called in an exposure."""
    return f"{identifier_of(one.item.name)}_{one.number}"


def _write_xml(root: ET.Element, path: str) -> None:
    ET.indent(root)
    Path(path).write_bytes(ET.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n")


def _exposure_model(exposure: Exposure) -> ET.Element:
    root = ET.Element("nrml", xmlns=NAMESPACE)
    model = ET.SubElement(
        root, "exposureModel", id="objects", category="contents", taxonomySource="shaketable"
    )
    unit = "currency of the list" if exposure.in_cost else "pieces"
    told = f"Unanchored objects; the value of an asset is that of all its pieces, in {unit}"
    ET.SubElement(model, "description").text = told
    costs = ET.SubElement(ET.SubElement(model, "conversions"), "costTypes")
    ET.SubElement(costs, "costType", name="contents", type="aggregated", unit=unit)
    ET.SubElement(model, "occupancyPeriods")
    ET.SubElement(model, "tagNames").text = "building floor"
    ET.SubElement(model, "assets").text = "openquake_assets.csv"
    return root


def _assets(exposure: Exposure, hazard: Hazard) -> pd.DataFrame:
    """A row for each object, whose value is that of all its pieces."""
    rows = []
    for one in exposure.objects:
        lon, lat = _place(one, hazard)
        rows.append({
            "id": f"object_{one.number}", "lon": lon, "lat": lat, "taxonomy": _taxonomy(one),
            "number": one.item.quantity, "contents": one.item.quantity * exposure.value(one),
            "building": word_of(one.item.building or "none"), "floor": word_of(one.floor or "0"),
        })  # fmt: skip
    return pd.DataFrame(rows)


def _place(one: ObjectRate, hazard: Hazard) -> tuple[float, float]:
    """Longitude and latitude at which an object stands [degrees]; 0, 0 where nothing says it."""
    return one.item.site or hazard.site or (0.0, 0.0)


def _vulnerability(export: Export, hazard: Hazard, shown: MeasureUnit) -> ET.Element:
    """What is lost on average: all of a piece that falls, nothing of one that stands.

    OpenQuake's classical calculation takes no probabilities of single losses, so that their spread
    is left out; losses of all pieces together are in `totals.csv`.
    """
    root = ET.Element("nrml", xmlns=NAMESPACE)
    model = ET.SubElement(
        root, "vulnerabilityModel", id="shaketable", assetCategory="contents",
        lossCategory="contents",
    )  # fmt: skip
    ET.SubElement(model, "description").text = export.description.replace("{unit}", shown.name)
    levels = _levels(hazard)
    for one in export.functions:
        curve = one.curves[-1]
        falls = probability(levels, np.array(curve.median), np.array(curve.beta))
        function = ET.SubElement(model, "vulnerabilityFunction", id=one.identifier, dist="LN")
        imls = ET.SubElement(function, "imls", imt=export.measure.name)
        imls.text = " ".join(f"{level:.8g}" for level in shown.factor * levels)
        ET.SubElement(function, "meanLRs").text = " ".join(f"{each:.10g}" for each in falls)
        ET.SubElement(function, "covLRs").text = " ".join(["0"] * levels.size)
    return root


def _levels(hazard: Hazard) -> NDArray[np.float64]:
    """Levels of the hazard curve, straight on beyond its ends as in `annual_rate` [SI].

    Where the curve ends at zero two levels stand right above its last one: OpenQuake's classical
    calculation takes the rates between the first and the last level, and no others.
    """
    known = hazard.levels[: hazard.positive]
    end = known[-1] * (1.0 if hazard.ends else BEYOND)
    levels = np.geomspace(LOWEST * known[0], end, STEPS + 1)
    return np.append(levels, end * np.array([1.001, 1.002])) if hazard.ends else levels


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
