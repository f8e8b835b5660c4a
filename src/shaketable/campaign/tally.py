"""What has become of the blocks of a run, for who watches it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass
class Tally:
    """Counts of blocks; it grows while the run goes on."""

    blocks: int
    done: int = 0
    failed: int = 0
    again: int = 0  # tried again, as their worker died or raised something unforeseen

    def __str__(self) -> str:
        return (
            f"{self.done:,} of {self.blocks:,} blocks done, {self.failed:,} failed, "
            f"{self.again:,} tried again"
        )
