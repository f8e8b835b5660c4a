"""What has become of the blocks of a run, for who watches it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass
class BlockTally:
    """Counts of blocks; it grows while the run goes on."""

    blocks: int
    done: int = 0
    failed: int = 0
    again: int = 0  # tried again, as their worker died or raised something unforeseen

    def __str__(self) -> str:
        faults = ((self.failed, "failed"), (self.again, "tried again"))
        told = [f"{count:,} {word}" for count, word in faults if count]
        return ", ".join([f"{self.done:,}/{self.blocks:,} blocks", *told])
