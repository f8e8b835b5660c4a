"""Fragility functions as OpenQuake reads them: NRML 0.5, `fragilityModel`.

PGA and SA are in g there, PGV in cm/s and PGD in cm. `mean` and `stddev` of a lognormal function
are those of the intensity itself: mean = θ e^{β²/2}, stddev = mean √(e^{β²} - 1).
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

from shaketable.atomic_files import appearing_file
from shaketable.errors import InputError
from shaketable.fragility.exported import (
    Exported,
    Functions,
    demand_of,
    functions_of,
    unit_of,
    word_of,
)
from shaketable.fragility.shown import SHOWN, MeasureUnit

NAMESPACE = "http://openquake.org/xmlns/nrml/0.5"
#: Where a function begins and ends: the mildest state's probability, and what the worst one's lacks
#: of 1. OpenQuake takes less as none.
TAIL = 1e-6
LEVELS = 50  # of a discrete function
FORMS = ("continuous", "discrete")


def write_nrml(fragility: Exported, path: str | Path, *, form: str = FORMS[0]) -> None:
    """Write functions for OpenQuake; a body is a taxonomy of assets.

    Args:
        fragility: its measure must be PGA, PGV, PGD, SA(T) or AvgSA(T).
        path: of the file, which is replaced.
        form: "continuous", lognormal; or "discrete", probabilities at levels.

    Raises:
        InputError: a measure that OpenQuake does not know, functions of the measure on a floor
            (OpenQuake's is that of the ground), or nothing to write.
    """
    if form not in FORMS:
        raise InputError(f"form= must be one of {', '.join(FORMS)}, got {form!r}")
    unit = unit_of(fragility.measure, SHOWN, "OpenQuake")
    fragility.curves[0].require_ground("OpenQuake's intensity is")
    functions = functions_of(fragility)
    order = [curve.state.name for curve in functions[0].curves]
    root = ET.Element("nrml", xmlns=NAMESPACE)
    model = ET.SubElement(
        root, "fragilityModel", id="shaketable", assetCategory="contents", lossCategory="contents"
    )
    ET.SubElement(model, "description").text = description_of(fragility, unit)
    ET.SubElement(model, "limitStates").text = " ".join(word_of(name) for name in order)
    for one in functions:
        if [curve.state.name for curve in one.curves] != order:
            raise InputError(
                f"{one.body}: its states are in another order of severity than those of "
                f"{functions[0].body}; export them apart"
            )
        _write_function(model, fragility, one, unit, form)
    ET.indent(root)
    content = ET.tostring(root, encoding="utf-8", xml_declaration=True)
    with appearing_file(Path(path)) as file:
        file.write_bytes(content + b"\n")


def description_of(fragility: Exported, unit: MeasureUnit) -> str:
    """What a reader should know of the functions."""
    curve = fragility.curves[0]
    cautions = "".join(
        f"; {each}" for each in dict.fromkeys(c.caution for c in fragility.curves if c.caution)
    )
    more = f"; β with {curve.more_beta:g} for what is not known" if curve.more_beta else ""
    return (
        f"Unanchored rigid bodies under {fragility.motions} motions of {curve.recordings} "
        f"recordings of {curve.events} earthquakes, by {fragility.method}; {fragility.model!r}; "
        f"{fragility.measure.name} in {unit.name}, {demand_of(fragility)}{more}{cautions}"
    )


def _write_function(
    model: ET.Element, fragility: Exported, one: Functions, unit: MeasureUnit, form: str
) -> None:
    from scipy.special import ndtri

    mildest, worst = one.curves[0], one.curves[-1]
    tail = float(ndtri(TAIL))
    least = unit.factor * mildest.median * math.exp(tail * mildest.beta)
    most = unit.factor * worst.median * math.exp(-tail * worst.beta)
    function = ET.SubElement(model, "fragilityFunction", id=one.identifier, format=form)
    if form == FORMS[0]:
        function.set("shape", "logncdf")
    imls = ET.SubElement(function, "imls", imt=fragility.measure.name)
    if form == FORMS[0]:
        imls.set("minIML", _told(least))
        imls.set("maxIML", _told(most))
        for curve in one.curves:
            mean, deviation = moments(unit.factor * curve.median, curve.beta)
            ET.SubElement(
                function, "params", ls=word_of(curve.state.name), mean=_told(mean),
                stddev=_told(deviation),
            )  # fmt: skip
        return
    levels = np.geomspace(least, most, LEVELS)
    imls.text = " ".join(_told(level) for level in levels)
    for curve in one.curves:
        chance = curve.probability(levels / unit.factor)
        poes = ET.SubElement(function, "poes", ls=word_of(curve.state.name))
        poes.text = " ".join(_told(float(each)) for each in chance)


def moments(median: float, beta: float) -> tuple[float, float]:
    """Mean and standard deviation of a lognormal intensity."""
    mean = median * math.exp(0.5 * beta * beta)
    return mean, mean * math.sqrt(math.expm1(beta * beta))


def _told(value: float) -> str:
    return f"{value:.8g}"
