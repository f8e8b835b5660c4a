"""What a worker does with the hazard curve of a visitor's site: levels by how seldom they come."""

from __future__ import annotations

import tempfile
from pathlib import Path

from shaketable.errors import InputError
from shaketable.hazard import read_hazard
from shaketable.language import Language, speaking
from shaketable.units import STANDARD_GRAVITY
from shaketable.web.answers import LevelOfSite, SiteLevels
from shaketable.web.uploads import Upload

#: How values in SI are told, by their units.
SHOWN = {"m/s2": (STANDARD_GRAVITY, "g"), "m/s": (0.01, "cm/s"), "m": (0.01, "cm")}
#: Usual return periods, 50, 10 and 2 % in 50 years among them.
YEARS = (72.0, 475.0, 2475.0)


def levels_of_site(name: str, data: bytes, language: Language = "en") -> SiteLevels:
    """The levels of a hazard curve at usual return periods.

    Raises:
        InputError: it cannot be read, or reaches none of them.
    """
    with speaking(language), tempfile.TemporaryDirectory(prefix="shaketable-") as folder:
        upload = Upload.written(Path(folder), name, data)
        try:
            hazard = read_hazard(upload.path)
        except InputError as error:
            raise upload.refusal(error) from None
    measure, levels = hazard.measure, []
    for years in YEARS:
        try:
            value = hazard.level(1.0 / years)
        except InputError:
            continue
        told, unit = SHOWN.get(measure.unit, (1.0, measure.unit))
        words = f"{measure.name} {value / told:.2g} {unit}"
        levels.append(LevelOfSite(years=years, measure=measure.name, value=value, in_words=words))
    if not levels:
        raise InputError(f"{name}: the curve reaches none of once in 72, 475 and 2,475 years")
    return SiteLevels(levels=levels)
