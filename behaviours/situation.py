"""What a situation for a body is: a small world, a start, what must happen."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeAlias

from behaviours.port import Align, Approach, Follow, Primitive, Reason, Sensor, Turn

__all__ = ["Corners", "Situation", "Step", "mirrored"]

Corners: TypeAlias = tuple[tuple[float, float], ...]

_MIRROR = {
    Sensor.FRONT: Sensor.FRONT,
    Sensor.LEFT: Sensor.RIGHT,
    Sensor.RIGHT: Sensor.LEFT,
}


@dataclass(frozen=True, slots=True)
class Step:
    """A primitive and what must come of it; None where anything may."""

    primitive: Primitive
    reason: Reason
    distance: float | None = None
    front: float | None = None
    left: float | None = None
    right: float | None = None
    shift: float | None = None
    clearance: float | None = None


@dataclass(frozen=True, slots=True)
class Situation:
    """A small world, a start, and what happens there."""

    name: str
    ring: Corners
    """Corners in metres, counter-clockwise."""
    x: float
    y: float
    heading: float
    steps: tuple[Step, ...]


def mirrored(situation: Situation) -> Situation:
    """Return the situation in a mirror: left and right change places."""
    return Situation(
        situation.name + ", on the left",
        tuple((x, -y) for x, y in reversed(situation.ring)),
        situation.x,
        -situation.y,
        -situation.heading,
        tuple(_mirrored_step(step) for step in situation.steps),
    )


def _mirrored_step(step: Step) -> Step:
    """Return a step with its sides exchanged."""
    primitive = step.primitive
    if isinstance(primitive, (Turn, Align, Follow)):
        primitive = replace(primitive, side=primitive.side.opposite)
    if isinstance(primitive, Approach):
        sensors = tuple(_MIRROR[sensor] for sensor in primitive.sensors)
        primitive = replace(primitive, sensors=sensors)
    shift = None if step.shift is None else -step.shift
    return replace(
        step, primitive=primitive, left=step.right, right=step.left, shift=shift
    )
