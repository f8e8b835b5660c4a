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
from shaketable.fragility.exported import Export, Functions, unit_of, word_of
from shaketable.fragility.shown import SHOWN, MeasureUnit

NAMESPACE = "http://openquake.org/xmlns/nrml/0.5"
#: Where a function begins and ends: the mildest state's probability, and what the worst one's lacks
#: of 1. OpenQuake takes less as none.
TAIL = 1e-6
LEVELS = 50  # of a discrete function
FORMS = ("continuous", "discrete")


def write_nrml(export: Export, path: str | Path, *, form: str = FORMS[0]) -> None:
    """Write functions for OpenQuake; a body is a taxonomy of assets.

    Args:
        export: its measure must be PGA, PGV, PGD, SA(T) or AvgSA(T).
        path: of the file, which is replaced.
        form: "continuous", lognormal; or "discrete", probabilities at levels.

    Raises:
        InputError: a measure that OpenQuake does not know, functions of the measure on a floor
            (OpenQuake's is that of the ground), or nothing to write.
    """
    if form not in FORMS:
        raise InputError(f"form= must be one of {', '.join(FORMS)}, got {form!r}")
    unit = unit_of(export.measure, SHOWN, "OpenQuake")
    export.require_ground("OpenQuake's intensity is")
    functions = export.functions
    order = _states(functions[0])
    root = ET.Element("nrml", xmlns=NAMESPACE)
    model = ET.SubElement(
        root, "fragilityModel", id="shaketable", assetCategory="contents", lossCategory="contents"
    )
    ET.SubElement(model, "description").text = export.description.replace("{unit}", unit.name)
    ET.SubElement(model, "limitStates").text = " ".join(order)
    for one in functions:
        if _states(one) != order:
            raise InputError(
                f"{one.name}: its states are in another order of severity than those of "
                f"{functions[0].name}; export them apart"
            )
        _write_function(model, export, one, unit, form)
    ET.indent(root)
    content = ET.tostring(root, encoding="utf-8", xml_declaration=True)
    with appearing_file(Path(path)) as file:
        file.write_bytes(content + b"\n")


def _states(one: Functions) -> list[str]:
    """What the limit states of a function are called, the mildest first."""
    return [word_of(curve.state.name) for curve in one.curves]


def _write_function(
    model: ET.Element, export: Export, one: Functions, unit: MeasureUnit, form: str
) -> None:
    from scipy.special import ndtri

    mildest, worst = one.curves[0], one.curves[-1]
    tail = float(ndtri(TAIL))
    least = unit.factor * mildest.median * math.exp(tail * mildest.beta)
    most = unit.factor * worst.median * math.exp(-tail * worst.beta)
    function = ET.SubElement(model, "fragilityFunction", id=one.identifier, format=form)
    if form == FORMS[0]:
        function.set("shape", "logncdf")
    imls = ET.SubElement(function, "imls", imt=export.measure.name)
    if form == FORMS[0]:
        imls.set("minIML", _told(least))
        imls.set("maxIML", _told(most))
        for name, curve in zip(_states(one), one.curves, strict=True):
            mean, deviation = moments(unit.factor * curve.median, curve.beta)
            ET.SubElement(
                function, "params", ls=name, mean=_told(mean),
                stddev=_told(deviation),
            )  # fmt: skip
        return
    levels = np.geomspace(least, most, LEVELS)
    imls.text = " ".join(_told(level) for level in levels)
    for name, curve in zip(_states(one), one.curves, strict=True):
        chance = curve.probability(levels / unit.factor)
        poes = ET.SubElement(function, "poes", ls=name)
        poes.text = " ".join(_told(float(each)) for each in chance)


def moments(median: float, beta: float) -> tuple[float, float]:
    """Mean and standard deviation of a lognormal intensity."""
    mean = median * math.exp(0.5 * beta * beta)
    return mean, mean * math.sqrt(math.expm1(beta * beta))


def _told(value: float) -> str:
    return f"{value:.8g}"
