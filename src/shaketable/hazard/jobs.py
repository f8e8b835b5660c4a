"""Whole jobs for loss tools: what stands where, its functions, what its loss costs, the hazard.

OpenQuake (3.26) runs `openquake_damage.ini` and `openquake_risk.ini` as they are. The hazard curve
is that of the site, and each object is an asset of as many pieces; of an object the direction
counts in which it falls more often, as in `rates.csv`. pelicun (3) takes the library with its
quantities and costs, a row for each object; the demand at which it is asked comes from whoever
asks. `left_out.csv` names the objects that are in neither, and why.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.atomic_files import write_csv
from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.fragility.exported import Export, Function, identifier_of, ordered, unit_of, word_of
from shaketable.fragility.intensities import OWN
from shaketable.fragility.lognormal import probability
from shaketable.fragility.nrml import NAMESPACE, write_nrml
from shaketable.fragility.pelicun import UNITS, write_into
from shaketable.fragility.shown import SHOWN, MeasureUnit
from shaketable.hazard.curve import Hazard
from shaketable.hazard.objects import ObjectRate, ObjectRates
from shaketable.hazard.totals import BEYOND
from shaketable.signal import Measure

OPENQUAKE, PELICUN = "openquake", "pelicun"
#: The tools, with the units in which each takes measures, and their names.
READERS = {OPENQUAKE: (SHOWN, "OpenQuake"), PELICUN: (UNITS, "pelicun")}
JOBS = tuple(READERS)
YEARS = 1.0  # of the probabilities of the hazard curve
STEPS = 200  # levels of the hazard curve and of vulnerability functions
LOWEST = 0.1  # of the first level of the curve: what is shaken by less loses nothing
QUANTITIES = "CMP_QNT.csv"
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


@dataclass(frozen=True, eq=False)
class Exposure:
    """Objects with a function, and what is exported of these.

    Attributes:
        export: a function for each object.
        objects: those that stand free and have one, and a cost where any of them has.
        functions: the identifier of each object's function, (object,).
        in_cost: whether their values are costs; otherwise a piece has a value of 1.
        left_out: name of each object that is left out, and why.
    """

    export: Export
    objects: tuple[ObjectRate, ...]
    functions: tuple[str, ...]
    in_cost: bool
    left_out: tuple[tuple[str, str], ...]


def exposure_of(rates: ObjectRates) -> Exposure:
    """What is exported of the objects of a site.

    Raises:
        InputError: none of them has a function.
    """
    every = list(rates.of_objects().values())
    known = [one for one in every if not one.curve.problem]
    if not known:
        raise InputError("no object has a fragility function: nothing can be exported")
    in_cost = any(one.item.cost is not None for one in known)
    objects = [one for one in known if not in_cost or one.item.cost is not None]
    names = {one.number: f"{one.item.name} {one.number}" for one in objects}
    written = tuple(
        ordered(
            {
                names[one.number]: [
                    Function(one.curve.state, one.curve.median, one.curve.beta, one.curve.caution)
                ]
                for one in objects
            },
            {names[one.number]: _about(one, rates) for one in objects},
        )
    )
    identifiers = {each.name: each.identifier for each in written}
    curve = objects[0].curve
    export = Export(
        functions=written,
        measure=rates.hazard.measure,
        place=curve.place,
        through_building=any(one.floor for one in objects),
        description=(
            f"Unanchored rigid bodies, each in a plane, under {rates.motions} motions of "
            f"{curve.recordings} recordings of {curve.events} earthquakes; "
            f"{rates.hazard.measure.name} of the ground in {{unit}}, {_components(rates)}; β is "
            "that of the motions alone"
        ),
    )
    left_out = [(one.item.called(one.number), one.curve.problem) for one in every
                if one.curve.problem]  # fmt: skip
    left_out += [(one.item.called(one.number), "it has no replacement cost, and others have")
                 for one in known if one not in objects]  # fmt: skip
    return Exposure(
        export,
        tuple(objects),
        tuple(identifiers[names[one.number]] for one in objects),
        in_cost,
        tuple(left_out),
    )


def _components(rates: ObjectRates) -> str:
    if rates.components == OWN:
        return "of any one horizontal component"
    return f"{rates.components} of both horizontal components"


def _about(one: ObjectRate, rates: ObjectRates) -> str:
    body = one.curve.body
    assert isinstance(body, Body)
    where = _about_place(one)
    return (
        f"{where + ': ' if where else ''}falls {one.direction}; base {body.width:.4g} m in that "
        f"plane, centre of gravity at {body.cg_height:.4g} m. The demand is "
        f"{rates.hazard.measure.name} of the ground, {_components(rates)}."
    )


def require_measure(measure: Measure, jobs: Sequence[str]) -> None:
    """InputError unless the tools of all jobs know a measure."""
    for job in jobs:
        unit_of(measure, *READERS[job])


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
    write_csv(pd.DataFrame(exposure.left_out, columns=["object", "why"]), folder / "left_out.csv")
    if OPENQUAKE in jobs:
        _write_openquake(exposure, rates.hazard, folder)
    if PELICUN in jobs:
        _write_pelicun(exposure, folder)


def _write_openquake(exposure: Exposure, hazard: Hazard, folder: Path) -> None:
    unit = unit_of(hazard.measure, *READERS[OPENQUAKE])
    place = folder / "openquake_"
    write_nrml(exposure.export, Path(f"{place}fragility.xml"))
    _write_xml(_vulnerability(exposure.export, hazard, unit), f"{place}vulnerability.xml")
    _write_xml(_exposure_model(exposure), f"{place}exposure.xml")
    write_csv(_assets(exposure, hazard), Path(f"{place}assets.csv"))
    taxonomies = [_taxonomy(one) for one in exposure.objects]
    write_csv(
        pd.DataFrame({"taxonomy": taxonomies, "risk_id": exposure.functions, "weight": 1}),
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
        cost = one.item.cost if exposure.in_cost else 1.0
        rows.append({
            "id": f"object_{one.number}", "lon": lon, "lat": lat, "taxonomy": _taxonomy(one),
            "number": one.item.quantity, "contents": one.item.quantity * (cost or 0.0),
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


def _write_pelicun(exposure: Exposure, folder: Path) -> None:
    costs = {
        function: one.item.cost
        for one, function in zip(exposure.objects, exposure.functions, strict=True)
        if one.item.cost is not None
    }
    write_into(folder, exposure.export, "ground", costs=costs)
    # one block: alike pieces fall together, as one motion shakes them all
    rows = [
        {"ID": function, "Units": "ea", "Location": 1, "Direction": 1,
         "Theta_0": one.item.quantity, "Blocks": 1, "Family": "", "Theta_1": "",
         "Comment": _about_place(one)}
        for one, function in zip(exposure.objects, exposure.functions, strict=True)
    ]  # fmt: skip
    write_csv(pd.DataFrame(rows), folder / QUANTITIES)


def _about_place(one: ObjectRate) -> str:
    return ", ".join(each for each in (one.item.building, one.item.location) if each)
