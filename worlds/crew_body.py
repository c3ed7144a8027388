"""A physical robot among others: it tells them from walls, and gives way."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from behaviours.port import Approach, Direction, Follow, Outcome, Primitive
from worlds.detours import part
from worlds.lookout import Doing, Lookout, Signal
from worlds.manners import Act, Self, is_abreast, lane_of, passed, verdict
from worlds.physical import PhysicalBody
from worlds.precedence import nearest, patience
from worlds.yielding import Yielder, give_way, look_at_oneself, make_way, step_in

if TYPE_CHECKING:
    import numpy as np

    from behaviours.parameters import Parameters
    from worlds.arena import Arena
    from worlds.pose import Pose
    from worlds.profile import Profile
    from worlds.straight import Control

__all__ = ["CrewBody", "can_pass"]

FIT = 2.5
"""Least half width of a hall in which two pass, in parts of a body's radius."""


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
        robot = self._simulated
        self.signal = Signal()
        """What its beacon says."""
        signals.append(self.signal)
        self.lookout = Lookout(profile, arena, robot.disc, robot.normal, signals)
        self._eyes = robot.eyes
        robot.screen(self._screen)
        self._number = robot.disc.row
        self._distance = 1.1 * max(
            math.hypot(r.x, r.y) + r.far for r in profile.rangers
        )
        self._yielder = Yielder(
            number=self._number,
            robot=self.robot,
            lookout=self.lookout,
            signal=self.signal,
            lane=lane_of(profile.radius, self.parameters.r_w),
            distance=self._distance,
            now=lambda: self.clock,
        )
        self.detours = 0
        """How often it has given way so far."""
        self._detour: Control[None] | None = None
        self._axis = 0.0
        self._held: Outcome | None = None
        self._held_at = 0.0

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
        self._detour = self._held = None
        self.arena.lift(self._simulated.disc)

    def lower(self) -> bool:
        """Put it back on the floor; return whether there was room."""
        return self.arena.lower(self._simulated.disc)

    def begin(self, primitive: Primitive) -> None:
        """Take up a primitive, to be carried out by `step` or by `poll`."""
        super().begin(primitive)
        self._yielder.begun = self._start
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
        if self._detour is None and (self.robot.is_fresh or self._touches()):
            self._start_detour()
        if self._detour is not None:
            try:
                next(self._detour)
            except StopIteration:
                self._detour = None
                self._held_at = self.clock
            else:
                return None
        outcome, self._held = self._held, None
        if outcome is None:
            outcome, self._held_at = super().poll(), self.clock
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

    def _start_detour(self) -> None:
        """Give way if there is reason to."""
        mates = self.lookout.mates
        if not (mates or self._eyes.aside):
            return
        me = look_at_oneself(self._yielder)
        if self._touches():
            self._take(part(self.robot, self.lookout))
        elif self._eyes.aside and self._may_step_in(me):
            self._take(step_in(self._yielder))
        elif self._held is not None and self._is_stalemate(me):
            self._take(make_way(self._yielder))
        elif self._held is None and verdict(me, mates).act is not Act.GO:
            self._take(give_way(self._yielder, me))

    def _take(self, detour: Control[None]) -> None:
        self.detours += 1
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

    def _is_stalemate(self, me: Self) -> bool:
        """Return whether it has waited long enough for somebody abreast."""
        mate = nearest(self.lookout.mates)
        return self.clock - self._held_at > patience(me.number, mate)
