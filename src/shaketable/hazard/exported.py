"""The functions of a site's objects, as files of loss tools hold them."""

from __future__ import annotations

from dataclasses import dataclass

from shaketable.body import Body
from shaketable.fragility.exported import Export, Function, ordered
from shaketable.fragility.intensities import OWN
from shaketable.hazard.exposure import Exposure, exposure_of
from shaketable.hazard.objects import ObjectRate, ObjectRates


@dataclass(frozen=True, kw_only=True, eq=False)
class ExportedObjects:
    """An exposure with what is exported of it.

    Attributes:
        exposure: the objects.
        export: a function for each of them.
        functions: the identifier of each object's function, (object,).
    """

    exposure: Exposure
    export: Export
    functions: tuple[str, ...]


def exported_objects(rates: ObjectRates) -> ExportedObjects:
    """What is exported of the objects of a site.

    Raises:
        InputError: no object has a fragility function.
    """
    exposure = exposure_of(rates)
    names = {one.number: f"{one.item.name} {one.number}" for one in exposure.objects}
    written = tuple(
        ordered(
            {
                names[one.number]: [
                    Function(one.curve.state, one.curve.median, one.curve.beta, one.curve.caution)
                ]
                for one in exposure.objects
            },
            {names[one.number]: _about(one, rates) for one in exposure.objects},
        )
    )
    identifiers = {each.name: each.identifier for each in written}
    curve = exposure.objects[0].curve
    export = Export(
        functions=written,
        measure=rates.hazard.measure,
        place=curve.place,
        through_building=any(one.floor for one in exposure.objects),
        description=(
            f"Unanchored rigid bodies, each in a plane, under {rates.motions} motions of "
            f"{curve.recordings} recordings of {curve.events} earthquakes; "
            f"{rates.hazard.measure.name} of the ground in {{unit}}, {_components(rates)}; β is "
            "that of the motions alone"
        ),
    )
    functions = tuple(identifiers[names[one.number]] for one in exposure.objects)
    return ExportedObjects(exposure=exposure, export=export, functions=functions)


def _components(rates: ObjectRates) -> str:
    if rates.components == OWN:
        return "of any one horizontal component"
    return f"{rates.components} of both horizontal components"


def _about(one: ObjectRate, rates: ObjectRates) -> str:
    body = one.curve.body
    assert isinstance(body, Body)
    where = place_of(one)
    return (
        f"{where + ': ' if where else ''}falls {one.direction}; base {body.base:.4g} m in that "
        f"plane, centre of gravity at {body.cg_height:.4g} m. The demand is "
        f"{rates.hazard.measure.name} of the ground, {_components(rates)}."
    )


def place_of(one: ObjectRate) -> str:
    """The building of an object and where in it; "" if the list says neither."""
    return ", ".join(each for each in (one.item.building, one.item.location) if each)
