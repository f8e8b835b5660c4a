"""Errors as the command line says them: what mends them in Python is an option here."""

from __future__ import annotations

import re

#: Words of Python, as regular expressions, and what takes their place; the first that fits.
SPELLINGS = (
    (r"give model=General\(static_friction=\.\.\.\)", "give --model general --static-friction"),
    (r"give model=General\(\.\.\.\)", "give --model general"),
    (r"General\(\.\.\.\); without sliding, General\(\) as it is", "--model general"),
    (r"solids know General\(\.\.\.\) and Rocking\(\) without restitution=",
     "in three dimensions --model general or no --restitution is known"),
    (r"Rocking\(restitution=([\d.]+)\) is for", r"--restitution \1 is for"),
    (r"the general model, General\(\.\.\.\),", "the general model, --model general,"),
    (r"suite\(name, pairs=True\) gives them", "the suite fema-p695-both-directions has them"),
    (r"fragility\(\.\.\., ground=\.\.\.\)", "--building"),
    (r"give Wall\(vertical=False\), the back", "a wall that is tilted with it is the back"),
    (r" \(ground=\)", ""),
    (r"\bplanar=True", "--planar"),
    (r"\b(device|demand)='(\w+)'", r"--\1 \2"),
    (r"give (Body\(mass=\.\.\.\)|mass=) \[kg\]", "give --mass-kg"),
    (r";[^;:]*: Motion\([^)]*\)", ""),
    (r"belongs to one-sided rocking, Rocking\(\.\.\.\)", "belongs to one-sided rocking"),
    (r"give a Body under General\(\.\.\.\)", "take --model general in a plane"),
    (r"must be Surroundings\(\.\.\.\)", "must be surroundings"),
    (r"must be (\w+)\(\.\.\.\)", r"must be a \1"),
    (r" \((in|en) Python \w+=\)", ""),
    # a header of OpenQuake's has names of its own
    (r"\b(?!investigation_time|imt)([a-z_]+)=(?=$|[\s,;.)])", r"--\1"),
)  # fmt: skip
_UNDERSCORES = re.compile(r"--\w+_\w+")


def as_options(message: str) -> str:
    """A message in which words of Python are options of the command line."""
    for python, option in SPELLINGS:
        message = re.sub(python, option, message)
    return _UNDERSCORES.sub(lambda found: found[0].replace("_", "-"), message)
