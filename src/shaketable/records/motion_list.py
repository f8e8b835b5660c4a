"""A list of motions that says what it holds."""

from __future__ import annotations

import html

from shaketable.motion import Motion
from shaketable.units import STANDARD_GRAVITY


class Suite(list[Motion]):
    """The motions of a suite, of a folder or of a file: a list with a name."""

    def __init__(self, name: str, motions: list[Motion]) -> None:
        super().__init__(motions)
        self.name = name

    def __repr__(self) -> str:
        if not self:
            return f"Suite({self.name!r}, no motions)"
        peaks = [motion.peak_ground_acceleration / STANDARD_GRAVITY for motion in self]
        return (
            f"Suite({self.name!r}, {len(self)} motions, peaks {min(peaks):.3g} to "
            f"{max(peaks):.3g} g)"
        )

    def _repr_html_(self) -> str:
        """For notebooks: a row a motion."""
        rows = "".join(
            f"<tr><td>{html.escape(motion.name)}</td><td>{motion.duration:.1f}</td>"
            f"<td>{motion.peak_ground_acceleration / STANDARD_GRAVITY:.3f}</td></tr>"
            for motion in self
        )
        header = "<tr><th>motion</th><th>duration [s]</th><th>peak [g]</th></tr>"
        return f"<p>{html.escape(repr(self))}</p><table>{header}{rows}</table>"
