"""Captions under which a study's figures appear."""

from __future__ import annotations

import textwrap

from matplotlib.figure import Figure

from shaketable.drawing.shown import drawn

LETTERS = 13.5  # of small print in an inch


def caption(figure: Figure, text: str) -> None:
    """Write a caption above a figure, in lines as wide as the figure."""
    width = int(LETTERS * figure.get_size_inches()[0])
    figure.suptitle(
        "\n".join(textwrap.wrap(drawn(text), width)),
        fontsize="small",
        x=0.02,
        ha="left",
    )
