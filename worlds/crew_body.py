"""A physical robot among others: it tells them from walls, and gives way."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from behaviours.port import Approach, Direction, Follow, Outcome, Primitive
from worlds.detours import back_off, leave, part, sidestep
from worlds.lookout import Doing, Lookout, Signal
from worlds.manners import LONGEST, Act, Self, is_abreast, lane_of, passed, verdict
from worlds.physical import PhysicalBody
from worlds.straight import Control, stop

if TYPE_CHECKING:
    import numpy as np

    from behaviours.parameters import Parameters
    from worlds.arena import Arena
    from worlds.lookout import Mate
    from worlds.pose import Pose
    from worlds.profile import Profile

__all__ = ["CrewBody", "can_pass"]

FIT = 2.5
"""Least half width of a hall in which two pass, in parts of a body's radius."""
STEP = 0.5
"""How far a robot goes off to make room, in parts of the distance that it keeps."""
AWAY = 20.0
"""Longest, in seconds, that it stays off."""
HEEDLESS = 10.0
"""Seconds for which a robot that has waited too long goes on unseeing."""


def can_pass(radius: float, r_w: float) -> bool:
    """Return whether two bodies pass each other in the narrowest hall, 2 r_w wide.

    Examples
    --------
    Two of 14 cm do in 40 cm, two of 7 cm do not in 11 cm:

    >>> can_pass(0.07, 0.2), can_pass(0.035, 0.055)
    (True, False)
    """
    return r_w >= FIT * radius


class CrewBody(PhysicalBody):
    """A physical body that shares its arena with others; see `PhysicalBody`.

    It sees the beacons of robots in sight, takes out of its ranges what is of them,
    and interrupts its primitive where one is in the way, until none is: to wait, to
    step aside and pass on the right, or to make room and come back. The primitive goes
    on where it was, and knows nothing of it.

    Parameters
    ----------
    arena : Arena
        The world it stands in.
    signals : list of Signal
        What the beacons of the arena's robots say; the robot adds its own.
    start : Pose
        Where it is set down, as the rest for `PhysicalBody`.
    profile : Profile
        Its measures, wheels and rangers.
    rng : numpy.random.Generator
        For all noise.
    sigma : float
        Standard deviation of a measured length, as a part of the length.
    parameters : Parameters, optional
        The lengths it keeps.

    Notes
    -----
    Where two bodies have no room for each other, `can_pass`, robots that meet in a
    narrow hall wait for each other in vain.
    """

    def __init__(
        self,
        arena: Arena,
        signals: list[Signal],
        start: Pose,
        profile: Profile,
        rng: np.random.Generator,
        sigma: float = 0.06,
        parameters: Parameters | None = None,
    ) -> None:
        super().__init__(arena, start, profile, rng, sigma, parameters)
        r_w = self.parameters.r_w
        robot = self._simulated
        self.signal = Signal()
        """What its beacon says."""
        signals.append(self.signal)
        self.lookout = Lookout(profile, arena, robot.disc, robot.normal, signals)
        self._eyes = robot.eyes
        robot.screen(self._screen)
        self._number = robot.disc.row
        self._lane = lane_of(profile.radius, r_w)
        self._distance = 1.1 * max(
            math.hypot(r.x, r.y) + r.far for r in profile.rangers
        )
        self._detour: Control[None] | None = None
        self._axis = 0.0
        self._heedless_until = 0.0
        self._held: Outcome | None = None

    def beset(self) -> float | None:
        """Return the bearing of one that waits for this robot to go, in radians."""
        for mate in self.lookout.mates:
            signal = mate.signal
            if signal.waits_for == self._number or (
                signal.is_blind and mate.distance < self._distance
            ):
                return mate.bearing
        return None

    def lift(self) -> None:
        """Take the robot off the floor: nobody meets it, and it does nothing."""
        self.halt()
        self.arena.lift(self._simulated.disc)

    def lower(self) -> bool:
        """Put it back on the floor; return whether there was room."""
        return self.arena.lower(self._simulated.disc)

    def begin(self, primitive: Primitive) -> None:
        """Take up a primitive, to be carried out by `step` or by `poll`."""
        super().begin(primitive)
        follows = isinstance(primitive, Follow) or (
            isinstance(primitive, Approach)
            and primitive.direction is Direction.FORWARD
            and primitive.limit == math.inf
        )
        self.signal.doing = Doing.FOLLOWS if follows else Doing.BUSY

    def poll(self) -> Outcome | None:
        """Decide what the wheels do in the next time step, or end the primitive.

        As `ControlledBody.poll`, which does not go on while the robot gives way.
        """
        if self._detour is None and self.robot.is_fresh:
            self._start_detour()
        if self._detour is not None:
            try:
                next(self._detour)
            except StopIteration:
                self._detour = None
            else:
                return None
        outcome, self._held = self._held, None
        if outcome is None:
            outcome = super().poll()
        if outcome is not None and self._eyes.aside:
            self._held = outcome
            self.signal.doing = Doing.BUSY
            return None
        if outcome is not None:
            self.signal.doing = Doing.PARKED
        return outcome

    def halt(self) -> None:
        """Drop the primitive, and stop the wheels."""
        super().halt()
        self.signal.doing = Doing.PARKED

    def _screen(self, answers: list[float]) -> list[float]:
        """Take out of new answers what is of mates, and tell where those are."""
        robot, lookout, signal = self.robot, self.lookout, self.signal
        found = lookout.screen(answers, robot.odometer, robot.turned)
        turned = 0.0 if self._detour is None else robot.turned - self._axis
        signal.bearings = {m.number: m.bearing + turned for m in lookout.mates}
        return found

    def _me(self) -> Self:
        robot = self.robot
        looks = robot.is_still or abs(robot.speed_asked) > 1e-3
        return Self(
            number=self._number,
            doing=self.signal.doing,
            way=math.copysign(1.0, robot.speed_asked) if robot.speed_asked else 0.0,
            is_aside=self._eyes.aside != 0.0,
            is_blind=self.lookout.is_blind
            and looks
            and self.clock >= self._heedless_until,
            waited=0.0,
            radius=self.robot.profile.radius,
            distance=self._distance,
        )

    def _start_detour(self) -> None:
        """Give way if there is reason to."""
        mates = self.lookout.mates
        if not (mates or self._eyes.aside):
            return
        me = self._me()
        if self._touches():
            self._take(part(self.robot, self.lookout))
        elif self._eyes.aside and self._may_step_in(me):
            self._take(self._step_in())
        elif self._held is None and verdict(me, mates).act is not Act.GO:
            self._take(self._give_way(me))

    def _take(self, detour: Control[None]) -> None:
        self._axis = self.robot.turned
        self._detour = detour

    def _touches(self) -> bool:
        """Return whether the body touches a mate, and not a wall."""
        close = 2 * self.robot.profile.radius + 0.03
        return self.robot.is_touching and any(
            mate.distance < close for mate in self.lookout.mates
        )

    def _may_step_in(self, me: Self) -> bool:
        """Return whether there is room in the middle, and a reason to be there."""
        mates = self.lookout.mates
        return not is_abreast(me, mates) if self._held else passed(me, mates)

    def _step_in(self) -> Control[None]:
        """Go back to the middle."""
        robot = self.robot
        yield from stop(robot)
        memory, seen = robot.memory(), self.lookout.seen
        yield from sidestep(robot, self.lookout, -self._eyes.aside)
        self._eyes.step_aside(-self._eyes.aside)
        robot.remember(memory)
        self.lookout.recall(seen, robot.turned)

    def _give_way(self, me: Self) -> Control[None]:
        """Wait, or make room, until the way is free; then all is as it was."""
        robot, lookout, signal = self.robot, self.lookout, self.signal
        yield from stop(robot)
        memory, seen = robot.memory(), lookout.seen
        since = self.clock
        while True:
            waited = self.clock - since
            me = replace(
                me,
                waited=waited,
                is_aside=self._eyes.aside != 0.0,
                is_blind=lookout.is_blind,
            )
            found = verdict(me, lookout.mates)
            signal.waits_for = found.mate.number if found.mate else None
            signal.is_blind = lookout.is_blind
            if found.act is Act.GO:
                break
            if found.act is Act.WAIT or found.mate is None:
                yield
                continue
            yield from self._make_room(found.act, found.mate)
            robot.remember(memory)
            lookout.recall(seen, robot.turned)
            since = self.clock
        if waited >= LONGEST:
            self._heedless_until = self.clock + HEEDLESS
        robot.remember(memory)
        signal.waits_for, signal.is_blind = None, False

    def _make_room(self, act: Act, mate: Mate) -> Control[None]:
        """Go where the other can pass."""
        robot, lookout = self.robot, self.lookout
        far = STEP * self._distance
        behind = min(far, robot.odometer - self._start)
        until = self._gone(self.clock + AWAY)
        if act is Act.ASIDE:
            yield from sidestep(robot, lookout, -self._lane)
        elif act is Act.BACK and behind > far / 4:
            yield from back_off(robot, lookout, behind, until)
        else:
            yield from leave(robot, lookout, mate.bearing, far, until)

    def _gone(self, latest: float) -> Callable[[], bool]:
        """Return what tells whether nobody is near, or it has got too late."""

        def gone() -> bool:
            near = 1.2 * self._distance
            is_free = all(mate.distance > near for mate in self.lookout.mates)
            return is_free or self.clock > latest

        return gone
