"""What a study gives: its tables, from which everything else is drawn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import pandas as pd


YES, NO, OPEN = "yes", "no", "not decided"


class Claim(NamedTuple):
    """What a paper says, what is found with the records at hand, and whether it holds."""

    claim: str
    paper_says: str
    we_find: str
    holds: str


def records_in_words(motions: int, recordings: int, description: str) -> str:
    """For captions."""
    said = f"{motions} motions of {recordings} recordings"
    return f"{said}, {description}" if description else said


@dataclass(frozen=True, kw_only=True, eq=False)
class Study:
    """A study's results.

    Attributes:
        name: of the paper, "author_year" with hyphens.
        reference: the paper.
        records: which motions made it, in words, for captions.
        tables: by name; units are in the columns' names. "claims" has the columns claim,
            paper_says, we_find, holds and records.
    """

    name: str
    reference: str
    records: str
    tables: Mapping[str, pd.DataFrame]
