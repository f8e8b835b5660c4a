"""The motions that a command is given: suites, folders and files, and where they come from."""

from __future__ import annotations

import logging
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import typer

from shaketable.cli.options import ReadingOptions
from shaketable.errors import InputError, joined, named
from shaketable.motion import Motion
from shaketable.records import DEFAULT_SUITE, read_components, read_motion, suite
from shaketable.records.folders import record_files
from shaketable.records.pairs import joined_pairs, pairs_among
from shaketable.records.suites import files_of, info_of
from shaketable.records.text import NoAccelerationError
from shaketable.signal import IntensityMeasure
from shaketable.units import STANDARD_GRAVITY

log = logging.getLogger(__name__)

EVERY_MOTION = "fema-p695"
DEFAULT_MOTION = "NORTHR/MUL009"  # Northridge 1994, Beverly Hills

Motions = Annotated[
    list[str] | None,
    typer.Option(help=f"Names of suites, record files, folders of records. [{DEFAULT_SUITE}]"),
]
Vertical = Annotated[
    bool,
    typer.Option(
        "--vertical",
        help="Pair records with their vertical components, in the same file or beside it.",
    ),
]


@dataclass(frozen=True, eq=False)
class ShakingAsked:
    """Motions, what to call them, and the files they came from.

    Attributes:
        motions: every horizontal component by itself, or in pairs.
        description: in words.
        files: of which they are.
        names: of the components, where two of them are one motion.
    """

    motions: list[Motion]
    description: str
    files: list[Path]
    names: tuple[str, ...] = ()

    def in_pairs(self) -> ShakingAsked:
        """The same with both components of a recording as one motion, where both are known."""
        names = tuple(motion.name for motion in self.motions)
        return replace(self, motions=joined_pairs(self.motions), names=names)

    def in_components(self) -> ShakingAsked:
        """The same with each horizontal component by itself."""
        parts = [part for motion in self.motions for part in motion.components()]
        return replace(self, motions=parts)

    def scaled_to(self, measure: IntensityMeasure) -> ShakingAsked:
        """The same with every motion scaled to 1 of a measure."""
        scaled = [motion.scaled(measure.factor(motion)) for motion in self.motions]
        return replace(self, motions=scaled)

    def entries(self, scale: float = 1.0) -> dict[str, Any]:
        """Their entries in a run log."""
        from shaketable.report.run_log import sha256

        parts = self.in_components().motions
        peaks = [m.peak_ground_acceleration * scale / STANDARD_GRAVITY for m in parts]
        return {
            "description": self.description,
            "count": len(parts),
            "smallest_pga_g": min(peaks),
            "largest_pga_g": max(peaks),
            "sources": [{"name": str(file), "sha256": sha256(file)} for file in self.files],
            "names": list(self.names) or [motion.name for motion in self.motions],
            "origins": [_origins(motion) for motion in parts],
        }


def motion_of(
    record: str,
    *,
    component: str | None,
    components: int,
    vertical: str | None,
    units: str | None,
    time_step: float | None,
) -> Motion:
    """The motion of a record file, or one of the suites by its name, such as NORTHR/MUL009.

    Args:
        record: a file, or a name.
        component, components, vertical, units, time_step: as for `read_motion`.

    Raises:
        InputError: neither is there, options of files beside a name, or what `read_motion` says.
    """
    found = None
    if not Path(record).exists():
        found = next((m for m in suite(EVERY_MOTION) if m.name == record), None)
    if found is None:
        require_used([record], units, time_step)
        try:
            return read_motion(
                record, component=component, components=components, vertical=vertical, units=units,
                time_step=time_step,
            )  # fmt: skip
        except InputError as error:
            if Path(record).exists():
                raise
            raise InputError(
                f"{error}; nor is it a motion of the suites, such as {DEFAULT_MOTION}"
            ) from None
    options = {
        "--component": component, "--vertical": vertical, "--units": units,
        "--time-step-s": time_step,
    }  # fmt: skip
    given = [option for option, value in options.items() if value is not None]
    if given or components == 3:
        raise InputError(
            f"{named(given or ['--components 3'], 4)}: for a record file; {record} is a motion of "
            "the suites, with horizontal components alone"
        )
    if components == 1:
        return found
    recorded = [m for m in suite(EVERY_MOTION) if _station(m) == _station(found)]
    pair = next(iter(pairs_among(recorded)), None)
    if pair is None:
        raise InputError(f"{record}: its second component is not known; give --components 1")
    return pair


def _station(motion: Motion) -> tuple[str, str] | None:
    origin = motion.origin
    return None if origin is None else (origin.event, origin.station)


def require_used(names: list[str], units: str | None, time_step: float | None) -> None:
    """InputError where --units or --time-step-s changes nothing: the files say it themselves.

    Args:
        names: suites, files and folders; of a folder one file that needs them is enough.
        units, time_step: that are given.
    """
    files = [path for name in names if not info_of(name) for path in _files(Path(name))]
    if time_step is not None and not files:
        raise InputError("--time-step-s: for record files; the package's suites state theirs")
    if units is None or any(_states_no_unit(path, time_step) for path in files):
        return
    which = "each file states its own" if files else "the package's suites state theirs"
    raise InputError(f"--units: {which}, and nothing else would be used; leave it out")


def _files(path: Path) -> list[Path]:
    return record_files(path) if path.is_dir() else [path]


def _states_no_unit(path: Path, time_step: float | None) -> bool:
    """Whether a file needs to be told its unit, or cannot be read, of which another error tells."""
    try:
        read_components(path, time_step=time_step)
    except InputError as error:
        return not isinstance(error, NoAccelerationError)
    return False


def load_motions(
    chosen: list[str],
    vertical: bool,
    reading: ReadingOptions,
    option: str = "--motions",
) -> ShakingAsked:
    """The motions of suites, folders and files.

    Raises:
        InputError: lists all that is wrong with the names and files.
    """
    motions: list[Motion] = []
    sources: list[Path] = []
    faults = [
        f"{option}: {name!r} is named {chosen.count(name)} times and would count as often"
        for name in dict.fromkeys(chosen)
        if chosen.count(name) > 1
    ]
    try:
        require_used(chosen, **reading.as_read)
    except InputError as error:
        faults.append(str(error))
    for name in chosen:
        try:
            found = suite(
                name,
                vertical=vertical,
                **reading.as_read,
                progress=True,
            )
        except InputError as error:
            faults.append(f"{option}: {error}")
            continue
        if not found:
            log.warning("%s: left out, as it is a vertical component", name)
            continue
        motions += found
        sources += files_of(name)
    if vertical and all(info_of(name) for name in chosen):
        faults.append("--vertical: the package's own suites have no vertical components")
    if not motions and not faults:
        faults = [f"{option}: no horizontal motion is left"]
    if faults:
        raise InputError(joined(faults))
    description = chosen[0] if len(chosen) == 1 else f"{len(chosen)} files and suites"
    return ShakingAsked(motions, description, sources)


@dataclass(frozen=True)
class MotionOptions(ReadingOptions):
    """The motions of a command, and how their files are read."""

    motions: Motions = None
    vertical: Vertical = False

    def load(self, otherwise: tuple[str, ...] = (DEFAULT_SUITE,)) -> ShakingAsked | None:
        """The motions; those of another choice where none are named, or None."""
        given = self.motions or list(otherwise)
        if not given:
            return None
        return load_motions(given, self.vertical, self)

    def required(self) -> ShakingAsked:
        """The motions; the default suite where none are named."""
        shaking = self.load()
        assert shaking is not None
        return shaking


def _origins(motion: Motion) -> dict[str, Any]:
    """What is known about where a motion comes from."""
    parts = {
        "horizontal": motion.origin,
        "vertical": motion.vertical_origin,
        "transverse": motion.transverse_origin,
    }
    return {name: asdict(origin) for name, origin in parts.items() if origin is not None}
