"""A campaign as a TOML file describes it.

[bodies]
inventory = "rooms.xlsx"              # or a grid, or a sample:
only_standing = true                  # leaves out what falls by itself on one of the tilts
solids = true                         # its objects in three dimensions

[bodies.grid]                         # every combination
base_m = {from = 0.2, to = 0.6, count = 9}  # along the shaking
height_m = [1.0, 1.8]                 # also cg offsets and losses:
eccentricity = 0.5
restitution_factor = [0.8, 1.0]
#                                     # solids: depth_m (x) and width_m (y) of a box in place of
#                                     # base_m, or shape = "cylinder", whose diameter is base_m

[bodies.sobol]                        # spread evenly over ranges
count = 1024
seed = 1
base_m = {from = 0.2, to = 0.6, logarithmic = true}
height_m = {from = 1.0, to = 2.0}

[motions]
of = ["fema-p695-far-field", "records"]   # suites, folders, files; relative to this file
pairs = true                          # both horizontal components as one motion; for solids
vertical = false                      # and units, time_step_s for files that do not say

[shaking]
tilts_deg = [0, 2]
scales = [1.0]
polarities = [1, -1]
azimuth_deg = 180                     # solids: downhill, from +x toward +y
orientations_deg = [0, 45]            # and how they are turned on their supports

[model]
name = "general"
static_friction = 0.4

[surroundings]                        # solids, or planar bodies in the general model
wall_gap_mm = 10                      # from the side toward +x to a wall behind it
wall_restitution = 0.3                # likewise wall_friction
straps = ["top:slack=5mm,stiffness=100kN/m"]
mass_kg = 100                         # of what the inventory has no mass of
edge_mm = 20                          # from the side toward -x to where the support ends
lip_mm = 5                            # and the lip there
pad_n = 50                            # planar: force that pulls off a foot that is glued down

[results]
keep = "summary"                      # or "all"
recordings = true

[plan]
block = 262144                        # simulations, about
report = true                         # of an inventory: the whole report of `assess`
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from dataclasses import fields
from pathlib import Path

from shaketable.assess.job import require_assessable
from shaketable.campaign import surroundings
from shaketable.campaign.assessments import Assessments
from shaketable.campaign.bodies import (
    KINDS,
    ONLY_STANDING,
    SOLIDS,
    bodies_of,
    items_of,
    standing,
)
from shaketable.campaign.fingerprint import motion_hash
from shaketable.campaign.libraries import Libraries
from shaketable.campaign.plan import ALL, SUMMARY, Plan
from shaketable.campaign.simulations import Simulations
from shaketable.errors import InputError, named, quoted, refused
from shaketable.inputs import read_file
from shaketable.lazy_motions import heads_of
from shaketable.library.read import SECTION as LIBRARY
from shaketable.library.read import read_library
from shaketable.models import NAMES, Model
from shaketable.motion import Motion
from shaketable.motion_file import in_temporary_file
from shaketable.progress import Progress
from shaketable.records.pairs import each_paired
from shaketable.records.suites import each_of, info_of
from shaketable.simulate.checks import warn
from shaketable.simulate.kinds import CPU, are_solids
from shaketable.toml_file import TomlFile
from shaketable.units import radians


def _fields(kind: type[Model]) -> set[str]:
    """The parameters of a model."""
    return {field.name for field in fields(kind)}  # type: ignore[arg-type]


MOST_NAMED = 5
PARAMETERS = {name: sorted(_fields(kind)) for name, kind in NAMES.items()}
SECTIONS = {
    "bodies": (*KINDS, ONLY_STANDING, SOLIDS),
    "motions": ("of", "pairs", "vertical", "units", "time_step_s"),
    "shaking": ("tilts_deg", "scales", "polarities", "azimuth_deg", "orientations_deg"),
    "model": ("name", *sorted(set().union(*PARAMETERS.values()))),
    surroundings.SECTION: surroundings.KEYS,
    "results": ("keep", "recordings"),
    "plan": ("block", "report"),
}


def read_campaign(
    path: str | Path, *, device: str = CPU, progress: Progress = False
) -> Simulations | Assessments | Libraries:
    """What a TOML file describes: simulations, the assessment of an inventory, or a library.

    Args:
        path: of the file.
        device: where it is to run.
        progress: whether to draw a bar while folders of records are read.

    Raises:
        InputError: lists what is wrong, with the line and the key.
    """
    told = TomlFile(Path(path))
    if told.has(LIBRARY):
        return _library(told, device, progress)
    told.accept(SECTIONS)
    bodies, held = bodies_of(told)
    solid = are_solids(bodies)
    report = told.get("plan", "report", bool, False)
    pairs = told.get("motions", "pairs", bool, solid)
    if pairs and not (solid or report):
        told.fault("motions.pairs", "is for solids, or for a report; planar bodies take one")
    motions = _motions(told, pairs and not report, progress)
    model = _model(told, "general" if solid else "rocking")
    if not solid or report:
        for key in ("azimuth_deg", "orientations_deg"):
            if told.has(f"shaking.{key}"):
                told.fault(f"shaking.{key}", "is for solids; a report turns them by itself")
    if report and solid:
        told.fault(f"bodies.{SOLIDS}", "a report has both; set motions.pairs = true")
    tilts = [radians(tilt) for tilt in told.numbers("shaking", "tilts_deg", [0.0])]
    scales = told.numbers("shaking", "scales", [1.0])
    polarities = told.numbers("shaking", "polarities", [1.0, -1.0])
    azimuth = radians(told.get("shaking", "azimuth_deg", (int, float), 180.0))
    orientations = [radians(o) for o in told.numbers("shaking", "orientations_deg", [0.0])]
    keep = told.get("results", "keep", str, ALL)
    recordings = told.get("results", "recordings", bool, False)
    if recordings and keep != SUMMARY:
        told.fault("results.recordings", f'is for keep = "{SUMMARY}"; "{ALL}" has every motion')
    block = told.get("plan", "block", int, None)
    if report:
        items = items_of(told)
        _require_one_shaking(told, bool(items), tilts, scales, polarities)
        for section in ("results", "plan.block"):
            if told.has(section):
                told.fault(section, "a report keeps what it needs, in blocks of its own")
        if told.has(surroundings.SECTION):
            told.fault(surroundings.SECTION, "a report takes them from the columns of its list")
        told.require()
        if device != CPU:
            raise refused(path, "plan.report: a report is made on the CPU; leave the device")
        try:
            require_assessable(items, scales[0], tilts[0], model, pairs)
        except InputError as error:
            raise InputError(f"{path}: {error}") from None
        warn(model, tilts, motions)
        inventory = told.get("bodies", "inventory", str, "")
        return Assessments(
            items=items,
            motions=motions,
            scale=scales[0],
            tilt=tilts[0],
            model=model,
            inventory=inventory,
            inventory_sha256=hashlib.sha256(read_file(told.path.parent / inventory)).hexdigest(),
            motions_told=f"{len(motions)} motions ({_names(told)})",
            in_pairs=pairs,
        )
    told.require()
    bodies = standing(told, bodies, tilts, azimuth, orientations)
    bodies, around = surroundings.surrounded(told, bodies, held, orientations, model, tilts)
    told.require()
    try:
        plan = Plan.of(
            bodies,
            motions,
            tilts=tilts,
            scales=scales,
            polarities=polarities,
            azimuth=azimuth,
            orientations=orientations,
            model=model,
            surroundings=around,
            keep=keep,
            recordings=recordings,
            block=block,
            device=device,
        )
    except InputError as error:
        raise refused(path, f"{error}") from None
    return Simulations(plan)


def _library(told: TomlFile, device: str, progress: Progress) -> Libraries:
    """The library that a file describes."""
    library = read_library(told)
    motions = _motions(told, True, progress)
    told.require()
    if device != CPU:
        raise refused(told.path, "a library is made on the CPU; leave the device")
    alone = [head.name for head in heads_of(motions) if not head.has_transverse]
    if alone:
        raise refused(
            told.path, f"motions.of: things need both components; one alone: {named(alone, 3)}"
        )
    return Libraries(library=library, motions=motions)


def _names(told: TomlFile) -> str:
    """What the file calls its motions."""
    of = told.get("motions", "of", (str, list), "")
    return of if isinstance(of, str) else ", ".join(of)


def _require_one_shaking(
    told: TomlFile,
    inventory: bool,
    tilts: Sequence[float],
    scales: Sequence[float],
    polarities: Sequence[float],
) -> None:
    """Note what the assessment of an inventory cannot take."""
    if not inventory:
        told.fault("plan.report", "is for an inventory; give one in [bodies]")
    if len(tilts) != 1 or tilts[0] < 0.0:
        told.fault("shaking.tilts_deg", "a report is for one tilt, not below 0")
    if len(scales) != 1 or scales[0] <= 0.0:
        told.fault("shaking.scales", "a report is for one scale, above 0")
    if sorted(polarities) != [-1.0, 1.0]:
        told.fault("shaking.polarities", "a report takes every motion in both directions")


def _motions(told: TomlFile, pairs: bool, progress: Progress) -> Sequence[Motion]:
    given = told.get("motions", "of", (str, list), None)
    names = [given] if isinstance(given, str) else given
    if not names or not all(isinstance(name, str) for name in names):
        told.fault("motions.of", "give suites, folders or files of records")
        return []
    vertical = told.get("motions", "vertical", bool, False)
    units = told.get("motions", "units", str, None)
    time_step = told.get("motions", "time_step_s", (int, float), None)
    twice = [name for name in dict.fromkeys(names) if names.count(name) > 1]
    if twice:
        told.fault("motions.of", f"{quoted(twice[0])} is named {names.count(twice[0])} times")
        return []

    def each() -> Iterator[Motion]:
        for name in names:
            place: str | Path = name if info_of(name) else told.path.parent / name
            try:
                _, found = each_of(
                    place, vertical=vertical, units=units, time_step=time_step, progress=progress
                )
                yield from found
            except InputError as error:
                told.fault("motions.of", str(error))

    motions = in_temporary_file(each())
    hashes = [motion_hash(motion) for motion in motions]
    first = {each: k for k, each in reversed(list(enumerate(hashes)))}
    again = [head.name for k, head in enumerate(motions.heads) if first[hashes[k]] < k]
    if again:
        told.fault("motions.of", f"the same motion several times: {named(again, MOST_NAMED)}")
    if pairs:
        motions = in_temporary_file(each_paired(motions))
    if not motions and not told.faults:
        told.fault("motions.of", "no horizontal motion is there")
    return motions


def _model(told: TomlFile, usual: str) -> Model:
    name = told.get("model", "name", str, usual)
    if name not in NAMES:
        told.fault("model.name", f"unknown {quoted(name)}; accepted: {', '.join(NAMES)}")
        return NAMES["rocking"]()
    kind = NAMES[name]
    given = {}
    for key in SECTIONS["model"][1:]:
        value = told.get("model", key, (int, float), None)
        if value is None:
            continue
        if key not in PARAMETERS[name]:
            told.fault(f"model.{key}", f"the model {name!r} has no such parameter")
        else:
            given[key] = float(value)
    try:
        return kind(**given)
    except InputError as error:
        told.fault("model", str(error))
        return kind()
