"""What a robot of a team asks for, and what it writes down."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass
from typing import TypeAlias

from behaviours.port import Outcome, Primitive

__all__ = ["Event", "Task", "Wait"]


@dataclass(frozen=True, slots=True)
class Wait:
    """Stand still for a while."""

    seconds: float


Task: TypeAlias = Generator[Primitive | Wait, Outcome | None, None]


@dataclass(frozen=True, slots=True)
class Event:
    """Something a robot decided, and why."""

    time: float
    """In seconds."""
    robot: int
    kind: str
    """``goes``, ``waits``, ``makes way``, ``merges``, ``refuses``, ``begins anew`` or
    ``ends``."""
    reason: str
    target: tuple[int, int] | None = None
    """Vertex and exit, in its own map, for ``goes`` and ``waits``."""
    other: int | None = None
    """The other robot, for ``merges`` and ``refuses``."""
