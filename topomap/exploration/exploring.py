"""How long robots take to explore a grid, step by step."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from topomap.errors import InputError
from topomap.exploration.registry import Allocator, find_allocator
from topomap.exploration.sight import sight_tree

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["Run", "Settings"]


@dataclass(frozen=True, slots=True)
class Settings:
    """How robots see, decide and talk. Lengths are in cells, times in steps."""

    allocator: str | Allocator = "minpos"
    """A name from `allocators`, or an allocator."""
    reach: float = 10.0
    """How far a robot sees."""
    group_size: int | None = None
    """Most cells in a frontier; by default half the sight's circumference, pi R_p."""
    period: int = 1
    """Steps from one decision to the next; arriving robots decide at once."""
    wait: int = 0
    """Steps that a redundant robot waits ([B] section 8.5.1)."""
    exchange: bool = False
    """Whether robots swap frontiers where it lowers costs ([B] section 10.2.3)."""
    radio: float = math.inf
    """How far messages carry."""
    loss: float = 0.0
    """Probability that a message is lost, in [0, 1]."""
    limit: int = 100_000
    """Steps after which a run is given up."""

    def __post_init__(self) -> None:
        sight_tree(self.reach)
        if isinstance(self.allocator, str):
            find_allocator(self.allocator)
        for name, least in (("period", 1), ("wait", 0), ("limit", 1)):
            if getattr(self, name) < least:
                raise InputError(
                    "settings", name, getattr(self, name), f"a number from {least} up"
                )
        if self.group_size is not None and self.group_size < 1:
            raise InputError("settings", "group_size", self.group_size, "1 or more")
        if not self.radio >= 0:
            raise InputError("settings", "radio", self.radio, "a distance from 0 up")
        if not 0 <= self.loss <= 1:
            raise InputError("settings", "loss", self.loss, "a probability")

    @property
    def choose(self) -> Allocator:
        """The allocator itself."""
        if isinstance(self.allocator, str):
            return find_allocator(self.allocator)
        return self.allocator

    @property
    def most(self) -> int:
        """The most cells in one frontier."""
        return self.group_size or math.floor(math.pi * self.reach)


@dataclass(frozen=True, slots=True)
class Run:
    """What came of exploring a grid. Times in steps or seconds, lengths in cells."""

    complete: bool
    """Whether some robot's map had no frontier within reach left."""
    time: float
    """When that was, T_total; or when the run was given up."""
    t90: float
    """When 90 % of what was seen at the end had been seen by the robots together."""
    lengths: tuple[float, ...]
    """How far each robot went."""
    overlap: float
    """Cells seen by each robot itself, summed, by cells seen together, less one."""
    deviation: float
    """Standard deviation of the robots' shares of what was seen together."""
    seen: NDArray[np.bool_] = field(repr=False)
    """Shape (rows, columns): what was seen."""
    trace: NDArray[np.int64] = field(repr=False)
    """Shape (times, robots, 2): cell (row, column) of each robot, from the start."""
