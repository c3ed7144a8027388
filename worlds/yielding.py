"""How a robot gives way, and goes on where it was when the way is free."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from worlds.detours import Stay, back_off, leave, sidestep
from worlds.lookout import Doing
from worlds.manners import Act, Self, Verdict, verdict
from worlds.precedence import may_return, yields_to
from worlds.straight import Control, stop

if TYPE_CHECKING:
    from worlds.lookout import Lookout, Signal
    from worlds.robot import Robot

__all__ = ["Yielder", "give_way", "look_at_oneself", "make_way", "step_in"]

STEP = 0.5
"""Least way that a robot goes off to make room, in parts of the distance it keeps."""
HIDDEN = 1.1
"""How far it goes off from whom it makes room for, in the same parts, if it can."""
IN = 0.01
"""A robot that is no farther aside, in metres, is in the middle."""


@dataclass(slots=True)
class Yielder:
    """A robot that gives way: what it sees and says, and what room it keeps."""

    number: int
    robot: Robot
    lookout: Lookout
    signal: Signal
    lane: float
    """How far it steps aside, in metres."""
    distance: float
    """That it keeps from others, in metres, so as not to be in their sight."""
    now: Callable[[], float]
    """Its clock, in seconds."""
    begun: float = 0.0
    """What the wheels had counted when its primitive began, in metres."""


def look_at_oneself(one: Yielder) -> Self:
    """Return what a robot that has not waited yet takes into account of itself."""
    robot = one.robot
    looks = robot.is_still or abs(robot.speed_asked) > 1e-3
    return Self(
        number=one.number,
        doing=one.signal.doing,
        way=math.copysign(1.0, robot.speed_asked) if robot.speed_asked else 0.0,
        is_aside=one.robot.eyes.aside != 0.0,
        is_cramped=False,
        is_blind=one.lookout.is_blind and looks,
        waited=0.0,
        radius=robot.profile.radius,
        distance=one.distance,
    )


def give_way(one: Yielder, me: Self) -> Control[None]:
    """Wait, or make room, until the way is free; then all is as it was."""
    robot, lookout, signal = one.robot, one.lookout, one.signal
    yield from stop(robot)
    memory, seen, before = robot.memory(), lookout.seen, one.robot.eyes.aside
    since = one.now()
    while True:
        waited, aside = one.now() - since, one.robot.eyes.aside
        me = replace(
            me, waited=waited, is_aside=aside != 0.0, is_blind=lookout.is_blind
        )
        found = verdict(me, lookout.mates)
        signal.waits_for = found.mate.number if found.mate else None
        signal.is_blind = lookout.is_blind
        if found.act is Act.GO:
            break
        if found.act is Act.WAIT:
            yield
            continue
        yield from _make_room(one, found)
        if found.act is Act.ASIDE:
            me = replace(me, is_cramped=abs(one.robot.eyes.aside - aside) < IN)
        robot.remember(memory)
        lookout.recall(seen, robot.turned, one.robot.eyes.aside - before)
        since = one.now()
    robot.remember(memory)
    signal.waits_for, signal.is_blind = None, False


def step_in(one: Yielder) -> Control[None]:
    """Go back to the middle; a robot that is blocked on the way stays aside."""
    robot, eyes = one.robot, one.robot.eyes
    yield from stop(robot)
    memory, seen, before = robot.memory(), one.lookout.seen, eyes.aside
    yield from sidestep(robot, one.lookout, -eyes.aside)
    if abs(eyes.aside) < IN:
        eyes.step_aside(-eyes.aside)
    robot.remember(memory)
    one.lookout.recall(seen, robot.turned, eyes.aside - before)


def make_way(one: Yielder) -> Control[None]:
    """Back off from the place where it has to step in, and come again."""
    robot, lookout = one.robot, one.lookout
    yield from stop(robot)
    memory, seen = robot.memory(), lookout.seen
    yield from back_off(robot, lookout, STEP * one.distance, _stay(one))
    robot.remember(memory)
    lookout.recall(seen, robot.turned)


def _make_room(one: Yielder, found: Verdict) -> Control[None]:
    """Go where the other can pass."""
    robot, lookout, mate = one.robot, one.lookout, found.mate
    if mate is None:
        return
    if found.act is Act.ASIDE:
        yield from sidestep(robot, lookout, found.side * one.lane)
        return
    one.signal.yields_to = yields_to(one.number, mate)
    least = STEP * one.distance
    far = max(least, HIDDEN * one.distance - mate.distance)
    behind = min(far, robot.odometer - one.begun)
    if found.act is Act.BACK and behind > least / 4:
        yield from back_off(robot, lookout, behind, _stay(one))
    else:
        yield from leave(robot, lookout, mate.bearing, far, _stay(one))
    one.signal.yields_to = None


def _stay(one: Yielder) -> Stay:
    """Return how a robot waits where it has made room."""
    signal = one.signal

    def wait() -> Control[None]:
        doing, signal.doing, signal.waits_for = signal.doing, Doing.AWAY, None
        signal.is_blind = False
        since = one.now()
        while not may_return(
            one.number, one.distance, one.now() - since, one.lookout.mates
        ):
            yield
        signal.doing = doing

    def press(number: int | None) -> None:
        signal.presses = signal.waits_for = number

    return Stay(wait, press)
