"""What reads files that users give, each with a whole file to damage; and what they ask."""

from __future__ import annotations

import io
import json
import shutil
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from openpyxl import Workbook

from shaketable.building import read_building
from shaketable.calibration.prior_file import read_prior
from shaketable.calibration.shake_tests import read_tests
from shaketable.campaign.description import read_campaign
from shaketable.hazard import read_hazard
from shaketable.hazard.shakemap import read_shakemap
from shaketable.inventory import read_inventory
from shaketable.records import read_components, suite
from shaketable.records.selected import HEADER, fingerprint
from shaketable.rooms import read_room
from shaketable.synthesis.targets import read_spectrum
from shaketable.web.questions import Pulse, Shake, Thing
from tests.fuzz.asked import (
    ask,
    line_as_file,
    question_as_file,
    run_line,
    write_beside,
)
from tests.inventory.test_bombs import open_document, text_cells
from tests.support import record_files

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
MOTION = "a.AT2"  # beside every file: what some refer to

BUILDING = f"""
name = "Clinic"
storeys = 3
first_period_s = 0.4
damping = 0.05
motions = ["{MOTION}"]
"""
CAMPAIGN = f"""
[bodies.grid]
base_m = {{from = 0.2, to = 0.6, count = 3, logarithmic = true}}
height_m = [1.0, 1.8]
eccentricity = 0.5
[motions]
of = "{MOTION}"
[shaking]
tilts_deg = [0, 2]
scales = [1.0, 2.0]
[model]
name = "general"
static_friction = 0.4
[results]
keep = "summary"
recordings = true
[plan]
block = 1000
"""
PRIOR = "parameter,low,high,distribution\nslenderness,0.9,1.1,log-uniform\ntilt,-0.01,0.01,\n"
TESTS = f"test,motion,scale,fell,record,order\nT1,{MOTION},0.4,no,A,1\nT2,{MOTION},0.7,yes,A,2\n"
SPECTRUM = "period_s,acceleration_g\n" + "".join(
    f"{0.1 * k:.1f},{1 / k:.3f}\n" for k in range(1, 30)
)
OPENQUAKE = (
    "#,,,\"generated_by='OpenQuake engine 3.26', investigation_time=50.0, imt='PGA'\"\n"
    "lon,lat,depth,poe-0.0050000,poe-0.0100000,poe-0.1000000\n"
    "8.50000,47.40000,0.00000,9.9E-01,9.7E-01,1.2E-01\n"
)
USGS = {
    "response": {
        "hazardCurves": [
            {
                "imt": {"value": measure},
                "data": [{"component": "Total", "values": {"xs": [0.1, 0.2], "ys": [0.01, 0.002]}}],
            }
            for measure in ("PGA", "SA1P0")
        ]
    }
}


class Reader(NamedTuple):
    """A function that reads a file, and a whole file of its kind.

    Attributes:
        damaged: gives a damaged file; None for one in which bytes, lines and fields are.
    """

    kind: str
    name: str  # of the file
    raw: bytes
    read: Callable[[Path], Any]
    damaged: Callable[[np.random.Generator], bytes] | None = None


def readers(folder: Path) -> list[Reader]:
    """All of them.

    Args:
        folder: in which they are read; what they refer to is put there.
    """
    (folder / MOTION).write_text(record_files.at2())
    shutil.copy(EXAMPLES / "shakemap" / "uncertainty.xml", folder)
    found = [
        Reader("record", name, example.text.encode(), partial(read_components, **example.given))
        for name, example in record_files.examples().items()
    ]
    made: tuple[tuple[str, str, bytes | str, Callable[[Path], Any]], ...] = (
        ("inventory", "hospital.csv", (EXAMPLES / "hospital.csv").read_bytes(), read_inventory),
        ("inventory", "campus.csv", (EXAMPLES / "campus.csv").read_bytes(), read_inventory),
        ("spreadsheet", "list.xlsx", excel(), read_inventory),
        ("spreadsheet", "list.ods", ods(folder), read_inventory),
        ("building", "clinic.toml", BUILDING, read_building),
        ("room", "room.toml", (EXAMPLES / "hospital_room.toml").read_bytes(), read_room),
        ("campaign", "campaign.toml", CAMPAIGN, read_campaign),
        ("prior", "prior.csv", PRIOR, read_prior),
        ("hazard", "two.csv", (EXAMPLES / "hazard.csv").read_bytes(), read_hazard),
        ("hazard", "openquake.csv", OPENQUAKE, read_hazard),
        ("hazard", "usgs.json", json.dumps(USGS), partial(read_hazard, measure="PGA")),
        ("ShakeMap", "grid.xml", (EXAMPLES / "shakemap" / "grid.xml").read_bytes(), read_shakemap),
        ("spectrum", "spectrum.csv", SPECTRUM, read_spectrum),
        ("selection", "chosen.csv", selection(folder), suite),
        ("tests", "tests.csv", TESTS, partial(read_tests, folder=folder)),
    )
    write_beside(folder)
    pulse = Shake(thing=Thing(base_m=0.32, height_m=1.8), shaking=Pulse(period_s=0.5, peak_g=0.05))
    asked = (
        Reader("command line", "words", b'["suites"]', run_line, line_as_file),
        Reader(
            "question",
            "question",
            b"simulate\n" + pulse.model_dump_json().encode(),
            ask,
            question_as_file,
        ),
    )
    return [
        *found,
        *(
            Reader(kind, name, raw.encode() if isinstance(raw, str) else raw, read)
            for kind, name, raw, read in made
        ),
        *asked,
    ]


ROWS = (
    ("name", "depth_m", "width_m", "height_m"),
    ("shelf", 0.3, 0.8, 1.8),
    ("box", 0.4, 0.5, 0.6),
)


def excel() -> bytes:
    book = Workbook()
    for row in ROWS:
        book.worksheets[0].append(row)
    raw = io.BytesIO()
    book.save(raw)
    return raw.getvalue()


def ods(folder: Path) -> bytes:
    rows = (text_cells(*map(str, row)) for row in ROWS)
    text = "".join(f"<table:table-row>{row}</table:table-row>" for row in rows)
    return open_document(folder / "whole.ods", text).read_bytes()


def selection(folder: Path) -> str:
    (motion,) = suite(folder / MOTION)
    row = (MOTION, motion.name, "1.5", fingerprint(motion), "", "")
    return f"{','.join(HEADER)}\n{','.join(row)}\n"
