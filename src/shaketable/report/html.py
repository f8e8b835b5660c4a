"""What all pages share: how templates are filled, and pictures inside the page."""

from __future__ import annotations

import base64
from functools import cache

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup


@cache
def pages() -> Environment:
    """The Jinja environment with the templates of `shaketable.report`, each compiled once."""
    return Environment(
        loader=PackageLoader("shaketable", "report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )


def embedded_svg(text: str) -> Markup:
    """A picture as an address that an <img> takes."""
    data = base64.b64encode(text.encode()).decode()
    return Markup(f"data:image/svg+xml;base64,{data}")  # noqa: S704  base64 of our own figure
