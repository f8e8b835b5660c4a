"""The results of a campaign as Zarr arrays: a block is a whole chunk of each.

The note of a block tells bytes and checksum of each of its chunks, so that a damaged one, or one
that is another block's, is an error and not a wrong number (`notes.faults_of`); what is missing
would be read as the fill value.
"""

from __future__ import annotations

import zlib
from collections import deque
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.campaign import sketch
from shaketable.campaign.objects import Objects
from shaketable.campaign.plan import ALL, BlockSpan, Plan
from shaketable.campaign.summary import LEVELS, MOMENTS, Summary
from shaketable.campaign.work import RESULTS
from shaketable.errors import SimulationError
from shaketable.simulate.ensemble import Ensemble
from shaketable.simulate.result_fields import FIELDS, Results

CELLS = ("body", "tilt", "scale")


class Layout(NamedTuple):
    """An array of a store; its first chunk axes are those along which blocks lie."""

    dimensions: tuple[str, ...]
    shape: tuple[int, ...]
    chunks: tuple[int, ...]
    dtype: np.dtype[Any]
    attributes: Mapping[str, Any]


@lru_cache(maxsize=4)
def layouts(plan: Plan) -> dict[str, Layout]:
    """The arrays of a plan, by name."""
    ensemble, parts = plan.ensemble, plan.motion_parts
    bodies, some = len(ensemble.bodies), plan.bodies_per_block
    tilts, scales = ensemble.tilts.size, ensemble.scales.size
    if plan.keep == ALL:
        one = Results(ensemble.kind.has(ensemble.model), 1, ensemble.surroundings)
        at_once = max(end - first for first, end in parts)
        names, shape = tuple(ensemble.dimensions), tuple(ensemble.dimensions.values())
        chunks = (some, at_once, *shape[2:])
        found = {}
        for name, array in one.arrays.items():
            field, own = FIELDS[name], array.shape[1:]  # one of each strap, if any
            along = (field.along,) if field.along else ()
            found[name] = Layout(
                (*names, *along), (*shape, *own), (*chunks, *own), array.dtype, field.attributes
            )
        return found

    def of_parts(kind: type, before: Mapping[str, int], after: Mapping[str, int]) -> Layout:
        names = ("part", *before, *CELLS, *after)
        inner, outer = (tuple(each.values()) for each in (before, after))
        shape = (len(parts), *inner, bodies, tilts, scales, *outer)
        return Layout(names, shape, (1, *inner, some, tilts, scales, *outer), np.dtype(kind), {})

    found = {
        "downhill": of_parts(np.int64, {}, {}),
        "uphill": of_parts(np.int64, {}, {}),
        "moments": of_parts(np.int64, {"level": len(LEVELS), "moment": len(MOMENTS)}, {}),
        "peaks": of_parts(np.uint32, {}, {"bin": sketch.BINS}),
    }
    if ensemble.held_field:
        found[ensemble.held_field] = of_parts(np.int64, {}, {})
    if plan.recordings:
        most = max(recordings_in(plan))
        found["by_recording"] = of_parts(np.int32, {"direction": 2, "recording": most}, {})
    return found


@lru_cache(maxsize=4)
def recordings_in(plan: Plan) -> list[int]:
    """How many recordings each motion part holds."""
    recording = plan.sources.recording
    return [int(np.unique(recording[first:end]).size) for first, end in plan.motion_parts]


def create(plan: Plan, objects: Objects) -> None:
    """Make the arrays, without a chunk, and the coordinates."""
    import xarray as xr
    from zarr import open_group
    from zarr.codecs import Crc32cCodec, ZstdCodec

    store, arrays = zarr_store(objects), layouts(plan)
    used = {name for layout in arrays.values() for name in layout.dimensions}
    coordinates = xr.Dataset(coords=plan.ensemble.coordinates())
    coordinates = coordinates.drop_vars([name for name in coordinates.dims if name not in used])
    for name in coordinates.coords:
        if coordinates[name].dtype.kind == "U":  # Zarr has no text of fixed length
            coordinates[name] = coordinates[name].astype(object)
    coordinates.attrs["model"] = repr(plan.ensemble.model)
    coordinates.to_zarr(store, mode="w", zarr_format=3, consolidated=False)
    group = open_group(store, mode="r+")
    for name, layout in arrays.items():
        group.create_array(
            name,
            shape=layout.shape,
            chunks=layout.chunks,
            dtype=layout.dtype,
            compressors=(ZstdCodec(level=1), Crc32cCodec()),
            fill_value=np.nan if layout.dtype.kind == "f" else 0,
            dimension_names=layout.dimensions,
            attributes=dict(layout.attributes),
        )


def zarr_store(objects: Objects) -> Any:
    """The Zarr store of the results."""
    from zarr.storage import FsspecStore, LocalStore

    if objects.folder is not None:
        return LocalStore(objects.folder / RESULTS)
    return FsspecStore.from_url(f"{objects.place}/{RESULTS}")


def opened(plan: Plan, objects: Objects) -> dict[str, Any]:
    """The arrays of the results, to be read and written.

    A chunk in which nothing happens is written too: Zarr would leave out what equals the fill
    value, and then nothing could tell it from one that was lost.
    """
    import zarr

    with zarr.config.set({"array.write_empty_chunks": True}):
        group = zarr.open_group(zarr_store(objects), mode="r+")
        return {name: group[name] for name in layouts(plan)}


def is_there(plan: Plan, objects: Objects) -> bool:
    """Whether all arrays of a plan can be opened, with their shapes."""
    try:
        found = opened(plan, objects)
    except (OSError, ValueError, KeyError):
        return False
    return all(
        name in found and found[name].shape == layout.shape and found[name].chunks == layout.chunks
        for name, layout in layouts(plan).items()
    )


def place_of(plan: Plan, block: BlockSpan, layout: Layout) -> tuple[int, ...]:
    """The number of a block's chunk along each axis."""
    row, part = divmod(block.number, len(plan.motion_parts))
    along = {"body": row, "motion": part, "part": part}
    return tuple(along.get(name, 0) for name in layout.dimensions)


def region_of(layout: Layout, place: tuple[int, ...]) -> tuple[slice, ...]:
    """The part of an array that a chunk holds."""
    return tuple(
        slice(k * size, min((k + 1) * size, length))
        for k, size, length in zip(place, layout.chunks, layout.shape, strict=True)
    )


def chunk_name(name: str, place: tuple[int, ...]) -> str:
    """The object that holds a chunk, in the default encoding of Zarr 3."""
    return "/".join([RESULTS, name, "c", *map(str, place)])


def values_of_all(results: Results, ensemble: Ensemble, plan: Plan) -> dict[str, NDArray[Any]]:
    """What a block writes where every simulation is kept.

    Its bodies may have fewer straps than others of the plan, or nothing that surrounds them.
    """
    shape = tuple(ensemble.dimensions.values())
    values = {}
    for name, layout in layouts(plan).items():
        own = layout.shape[len(shape) :]
        values[name] = np.full((*shape, *own), FIELDS[name].unknown, layout.dtype)
        if (found := results.arrays.get(name)) is not None:
            own = found.shape[1:]
            whole = values[name][..., : own[0]] if own else values[name]
            whole[...] = found.reshape(*shape, *own)
    return values


def values_of_summary(summary: Summary, plan: Plan) -> dict[str, NDArray[Any]]:
    """What a block writes where a summary is kept."""
    found: dict[str, NDArray[Any]] = {
        "downhill": summary.downhill[None],
        "uphill": summary.uphill[None],
        "moments": summary.moments[None],
        "peaks": summary.peaks[None],
    }
    if plan.ensemble.held_field:
        found[plan.ensemble.held_field] = summary.held[None]
    if plan.recordings:
        counts = summary.by_recording
        most = max(recordings_in(plan))
        padded = np.zeros((1, 2, most, *counts.shape[2:]), np.int32)
        padded[0, :, : counts.shape[1]] = counts
        found["by_recording"] = padded
    return found


def write(
    values: Mapping[str, NDArray[Any]],
    plan: Plan,
    block: BlockSpan,
    kept: Mapping[str, Any],
    objects: Objects,
) -> dict[str, list[int]]:
    """Write a block's chunks; returns the bytes and the checksum of each object, by its name.

    All at once: an object store takes a while for each.
    """
    places, regions = {}, {}
    for name, layout in layouts(plan).items():
        place = place_of(plan, block, layout)
        regions[name] = region_of(layout, place)
        shape = tuple(part.stop - part.start for part in regions[name])
        # a chunk that is written in part would be read, changed and written: two blocks might race
        if values[name].shape != shape or values[name].dtype != layout.dtype:
            raise AssertionError(f"{name}: {values[name].shape} is no whole chunk, {shape} is")
        places[name] = chunk_name(name, place)

    def keep(name: str) -> None:
        kept[name][regions[name]] = values[name]

    with ThreadPoolExecutor(len(places)) as pool:
        deque(pool.map(keep, places), maxlen=0)  # raises what a write has raised
    written = objects.get_many(list(places.values()))
    for name in places.values():
        if name not in written:
            raise SimulationError(f"{objects.place}: {name} was not kept")
    return {name: [len(content), zlib.crc32(content)] for name, content in written.items()}
