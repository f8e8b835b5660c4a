"""One recorded component, as given by its file."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shaketable.origin import Origin

#: Network codes of vertical components that are positive upwards, and positive downwards.
UP_CODES = {
    "UP", "UD", "U", "V", "Z", "VER", "VRT", "VRTC", "VERT", "VERTICAL", "VERTICALE", "UPDO",
    "UPDOWN",
}  # fmt: skip
DOWN_CODES = {"DOWN", "DWN", "DN"}

_COMPASS = {
    "N": 0.0, "E": 90.0, "S": 180.0, "W": 270.0,
    "NORTH": 0.0, "EAST": 90.0, "SOUTH": 180.0, "WEST": 270.0,
}  # fmt: skip
_AXES = {"NS": 0.0, "SN": 0.0, "EW": 90.0, "WE": 90.0}
_QUADRANT = re.compile(r"([NS])\s*(\d+(?:\.\d+)?)\s*([EW])$")
#: Band, instrument and orientation of a SEED channel that records strong motion.
_SEED = re.compile(r"[HEB][NLGH]([ZNE])$")
_BARE = re.compile(r"[-_./\s]")
_WORDS = re.compile(r"H?[12]|L|T|LO|TR", re.IGNORECASE)
#: Between the words of a column's name; words of it that say no direction.
_BETWEEN = re.compile(r"[\s_.\-/]+")
_QUANTITY = re.compile(
    r"a|acc|accel|accelerations?|accelerogram|linear|axis|direction|dir|component|comp|"
    r"beschleunigung|achse|aceleraci[oó]n|accelerazione|eje|asse",
    re.IGNORECASE,
)
#: Both in one word: "az", "accX", "gFz", "linearAccelerationZ" and "ZACC".
_TOGETHER = re.compile(
    r"(?:a|gf|\w*acc(?:el(?:eration|erometer)?)?)(x|y|z|ns|ew|ud|up)|"
    r"(x|y|z|ns|ew|ud|up)acc(?:el(?:eration)?)?",
    re.IGNORECASE,
)


@dataclass(frozen=True, kw_only=True, eq=False)
class Component:
    """A recorded acceleration component, as given by its file.

    Attributes:
        acceleration: [m/s²], shape (n,).
        time_step: [s].
        code: the network's word for the component ("H1", "UP", "NS"), "" if none.
        azimuth: clockwise from north [degrees]; the code's if the file gives no other, None if
            the code gives none either.
        start: time of the first sample [s], 0 if the file does not say.
        uncorrected: whether the record is published uncorrected: its zero is the instrument's, not
            the ground's.
        channel: number among the station's channels, None if the file does not say.
        station, event, location: as in the file, "" if none.
        magnitude: of the event, None if the file does not say.
        processing: what the network says it did, and what was done on reading.
        path: the file; for a member of an archive, the archive's path before its name.
        sha256: of the file's content.
        format: name of the format that it was read as.
        lines: the line of each sample, (n,), while the file is read; None afterwards.
    """

    acceleration: NDArray[np.float64] = field(repr=False)
    time_step: float
    code: str = ""
    azimuth: float | None = None
    start: float = 0.0
    uncorrected: bool = False
    channel: int | None = None
    station: str = ""
    event: str = ""
    magnitude: float | None = None
    location: str = ""
    processing: tuple[str, ...] = ()
    path: Path = Path()
    sha256: str = ""
    format: str = ""
    lines: NDArray[np.int32] | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        if self.azimuth is None:
            found = azimuth_of(self.code)
            named = direction_in(self.code)
            if found is None and not (named.isdigit() or self.is_vertical):
                found = azimuth_of(named)
            object.__setattr__(self, "azimuth", found)

    @property
    def is_vertical(self) -> bool:
        """Whether the file calls it a vertical component."""
        return names_vertical(self.code) or names_vertical(direction_in(self.code))

    @property
    def upward(self) -> float:
        """+1 if the file's vertical component is positive upwards, -1 if positive downwards."""
        names = {_bare(self.code), _bare(direction_in(self.code))}
        return -1.0 if names & DOWN_CODES else 1.0

    @property
    def origin(self) -> Origin:
        """Everything but the samples."""
        return Origin(
            event=self.event,
            station=self.station,
            component=self.code,
            azimuth=self.azimuth,
            magnitude=self.magnitude,
            start=self.start,
            location=self.location,
            file=str(self.path),
            sha256=self.sha256,
            processing=self.processing,
        )


def names_vertical(code: str) -> bool:
    """Whether a code names a vertical component, as "UP", "U-D", "UD2" and "HNZ" do."""
    bare = _bare(code)
    seed = _SEED.match(bare)
    return bare in UP_CODES | DOWN_CODES or bool(seed and seed.group(1) == "Z")


def direction_in(name: str) -> str:
    """The word of a name that tells its direction: "z" in "acc_z", "az" and "Acceleration z".

    It is the last one, words for the quantity aside; "" without such a word.
    """
    words = [each for each in _BETWEEN.split(name.strip()) if not _QUANTITY.fullmatch(each)]
    last = words[-1] if words else ""
    together = _TOGETHER.fullmatch(last)
    return (together[1] or together[2]) if together else last


def same_code(a: str, b: str) -> bool:
    """Whether two codes are equal but for case and separators, as "N-S" and "ns" are."""
    return _BARE.sub("", a).upper() == _BARE.sub("", b).upper()


def names_horizontal(word: str) -> bool:
    """Whether a word may name a horizontal component, as "H1", "EW", "N28W" and "021" do."""
    bare = word.rstrip("12") or word
    return azimuth_of(bare) is not None or bool(_WORDS.fullmatch(word))


def code_in_name(path: Path) -> str:
    """The component's code in a file name: "TLM1_UD.acc", "ew_free_field.txt", "A.NS2"."""
    ending = path.suffix[1:]
    if len(ending) > 1 and (names_vertical(ending) or azimuth_of(_bare(ending)) is not None):
        return "" if ending[:1] in "vV" else ending  # .V2 is a volume
    words = re.split(r"[-_.\s]", path.stem)
    for back, word in enumerate(reversed(words)):
        short = len(word) == 1 and back > 0
        if names_vertical(word) or (names_horizontal(word) and not word.isdigit()):
            return "" if short else word
    return ""


def azimuth_of(code: str) -> float | None:
    """Degrees clockwise from north that a code gives ("360", "S05W", "N-S", "HNE"), or None."""
    word = code.strip().upper()
    if re.fullmatch(r"\d{1,3}(\.\d+)?", word):
        return float(word) if float(word) <= 360.0 else None
    quadrant = _QUADRANT.match(word)
    if quadrant:
        north, turn, east = quadrant.groups()
        angle = float(turn) if east == "E" else -float(turn)
        return (angle if north == "N" else 180.0 - angle) % 360.0
    if names_vertical(word):
        return None
    bare = _bare(word)
    seed = _SEED.match(bare)
    return _AXES.get(bare, _COMPASS.get(seed.group(1) if seed else bare))


def _bare(code: str) -> str:
    """A code without separators or a digit after its letters: "U-D" and "UD2" become "UD"."""
    return re.sub(r"(?<=[A-Z])\d$", "", _BARE.sub("", code.upper()))
