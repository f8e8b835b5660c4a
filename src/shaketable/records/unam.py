"""UNAM (Mexico) ASA 2.0: a header of "KEY : value" lines in Spanish, and a column for each channel.

Channels have their values between slashes: "INTERVALO DE MUESTREO, C1-C6 (s) : /0.01/0.01".
"""

from __future__ import annotations

import re

from shaketable.errors import quoted
from shaketable.language import tell
from shaketable.records.component import Component
from shaketable.records.header import Header, keyed
from shaketable.records.numbers import free, table
from shaketable.records.stated import OFFSET_SHARE, require_count, require_peak
from shaketable.records.text import RecordText

_TITLE = re.compile(r"^\s*ARCHIVO EST[AÁ]NDAR DE ACELERACI[OÓ]N", re.IGNORECASE)
_DATA = re.compile(r"^\s*DATOS DE ACELERACI[OÓ]N", re.IGNORECASE)
_RULE = re.compile(r"^\s*-+\+[-+]*\s*$")
_HEADER_LINES = 200
#: Keys of the header, by what they are of each channel.
DIRECTION = "ORIENTACION C1-C6 (rumbo;orientacion)"
STEP = "INTERVALO DE MUESTREO, C1-C6 (s)"
COUNT = "NUM. TOTAL DE MUESTRAS, C1-C6"
PEAK = "ACEL. MAX.(Gal), C1-C6"
UNIT = "UNIDADES DE LOS DATOS"


def recognise(text: RecordText) -> bool:
    """Whether one of the first lines is the format's title."""
    return text.search(_TITLE, 0, 5) is not None


def read(text: RecordText) -> list[Component]:
    """A component for each channel."""
    data = text.search(_DATA, 0, _HEADER_LINES)
    if data is None:
        raise text.fault(tell("no line {line}", line=quoted("DATOS DE ACELERACION:")))
    head = Header(text, keyed(text.rows(0, data.line - 1)))
    codes = [_code(each) for each in _of_channels(head, DIRECTION)]
    rules = [n for n, line in text.rows(data.line, data.line + 10) if _RULE.match(line)]
    start = rules[-1] if rules else data.line
    values, lines = table(text, free(text, text.rows(start)), len(codes))
    unit = head.get(UNIT).partition("(")[0].strip() or None
    factor = text.factor(unit, tell("the header"))
    line = head.required(STEP)[1]
    steps = [text.step(text.number(each, line), line) for each in _of_channels(head, STEP)]
    counts = [text.whole(each, head.required(COUNT)[1]) for each in _of_channels(head, COUNT)]
    peaks = _of_channels(head, PEAK) if head.get(PEAK) else []
    for name, found in ((STEP, steps), (COUNT, counts), (PEAK, peaks)):
        if found and len(found) != len(codes):
            raise text.fault(
                tell(
                    "{name}: expected {count} values, one a channel, found {found}",
                    name=name,
                    count=len(codes),
                    found=len(found),
                ),
                head.required(name)[1],
            )
    for count in counts:
        require_count(text, count, len(values), "rows")
    for code, peak, series in zip(codes, peaks, values.T, strict=False):
        require_peak(
            text, peak, head.required(PEAK)[1], series, share=OFFSET_SHARE, what=f"channel {code}"
        )
    return [
        Component(
            acceleration=series * factor,
            time_step=step,
            code=code,
            uncorrected=True,
            station=" ".join(
                filter(None, [head.get("CLAVE DE LA ESTACION"), head.get("NOMBRE DE LA ESTACION")])
            ),
            event=head.starting("FECHA DEL SISMO"),
            lines=lines,
        )
        for code, step, series in zip(codes, steps, values.T, strict=True)
    ]


def _of_channels(head: Header, key: str) -> list[str]:
    """The values of a key, one a channel."""
    return [each.strip() for each in head.required(key)[0].split("/") if each.strip()]


def _code(stated: str) -> str:
    """The direction of a channel: "N00E" and "V"; a vertical one with a minus points down."""
    words = stated.replace(";", " ").replace("+", " ").split()
    code = next((each for each in words if each.strip("-")), stated)
    vertical = code.strip("-").upper() in ("V", "Z")
    return "DOWN" if vertical and "-" in stated else code.strip("-")
