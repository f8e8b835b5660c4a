"""Where a motion comes from: what its file says, and what was done to it since."""

from __future__ import annotations

from dataclasses import dataclass, replace


@dataclass(frozen=True, kw_only=True)
class Origin:
    """The source of one component; it travels with the motion.

    Attributes:
        event, station: as in the file, "" if none.
        component: the network's word for the component ("H1", "360", "UD").
        azimuth: clockwise from north [degrees], None if the file does not say.
        magnitude: of the event, on the scale of its source; None if that is not said.
        distance: of the station to the rupture, at the nearest [km]; None if that is not said.
        start: time of the first sample on the recorder's clock [s], 0 if that is not said.
        location: where in the building or in the ground the instrument stands, "" if not said.
        file: the file's path; for a member of an archive, the archive's path before its name.
        sha256: of the file's content.
        processing: what the network says it did, then every step taken here, in order.
    """

    event: str = ""
    station: str = ""
    component: str = ""
    azimuth: float | None = None
    magnitude: float | None = None
    distance: float | None = None
    start: float = 0.0
    location: str = ""
    file: str = ""
    sha256: str = ""
    processing: tuple[str, ...] = ()

    def after(self, step: str) -> Origin:
        """The origin with `step` added to its processing."""
        return replace(self, processing=(*self.processing, step))
