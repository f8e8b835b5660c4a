"""What a study is, what it takes and gives, the words that all share, and those installed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from importlib.metadata import entry_points
from typing import TYPE_CHECKING, Any, NamedTuple

from shaketable.motion import Motion
from shaketable.progress import Progress

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

YES, NO, OPEN = "yes", "no", "not decided"
BY_CONSTRUCTION = "by construction"  # it could not come out otherwise, and shows nothing


class Claim(NamedTuple):
    """What a paper says, what is found, whether it holds, and what that rests on.

    `records` is empty where it is what the whole study rests on.
    """

    claim: str
    paper_says: str
    we_find: str
    holds: str
    records: str = ""


def table_of(claims: Sequence[Claim], records: str) -> pd.DataFrame:
    """Claims as a table; those that do not say what they rest on rest on `records`."""
    import pandas as pd

    return pd.DataFrame([one._replace(records=one.records or records) for one in claims])


def verdict_within(low: float, high: float, least: float, most: float) -> str:
    """Whether an interval lies within limits, outside of them, or across one."""
    if least <= low and high <= most:
        return YES
    return NO if high < least or low > most else OPEN


def records_in_words(motions: int, recordings: int, description: str, events: int = 0) -> str:
    """The motions in words, for captions."""
    said = f"{motions} motions of {recordings} recordings"
    said += f" of {events} events" if events else ""
    return f"{said}, {description}" if description else said


@dataclass(frozen=True, kw_only=True, eq=False)
class Study:
    """A study's results.

    Attributes:
        records: the motions in words, as figures and tables give them.
        tables: by the name of their file; `claims` has the paper's claims and what was found.
        inputs: what it took besides the motions that every study takes, for the run log.
    """

    records: str
    tables: Mapping[str, pd.DataFrame]
    inputs: Mapping[str, object] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True, eq=False)
class StudyInput:
    """What a study is done with.

    Attributes:
        motions: at least one; each counts in both directions.
        description: what to call them.
        seed: of the bootstrap.
        units, time_step: for record files that do not state them, in a study that reads more.
        progress: as for simulate_many.
        options: values of the study's own options, by name.
    """

    motions: Sequence[Motion]
    description: str = ""
    seed: int = 0
    units: str | None = None
    time_step: float | None = None
    progress: Progress = True
    options: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class Option:
    """An option that only one study has.

    Attributes:
        name: of the argument; on the command line with dashes.
        kind: its type.
        default: its value where it is not given.
        help: what it is for.
    """

    name: str
    kind: Any
    default: object
    help: str


@dataclass(frozen=True, kw_only=True)
class PublishedStudy:
    """A paper whose study can be done again.

    Attributes:
        name: name of its command.
        reference: the paper.
        summary: what is done, for the command's help.
        run: does the study, with every option given; `do` fills in the defaults.
        figures: draws its figures, each with its name.
        options: those that only this study has.
        takes_verticals: whether motions may have a vertical component.
    """

    name: str
    reference: str
    summary: str
    run: Callable[[StudyInput], Study]
    figures: Callable[[Study], Iterable[tuple[str, Figure]]]
    options: tuple[Option, ...] = ()
    takes_verticals: bool = True

    def do(self, given: StudyInput) -> Study:
        """Do the study, with defaults for the options that are not given."""
        defaults = {option.name: option.default for option in self.options}
        return self.run(replace(given, options={**defaults, **given.options}))


@cache
def installed_studies() -> dict[str, PublishedStudy]:
    """The studies of all packages that are installed, by the names of their commands.

    A package offers its studies as entry points of the group `shaketable.studies`.
    """
    found = [point.load() for point in entry_points(group="shaketable.studies")]
    return {study.name: study for study in found}
