"""What the answers of a robot's rangers mean around it."""

from __future__ import annotations

import math
from collections.abc import Iterable

from worlds.profile import Profile, Ranger, looks_along

__all__ = ["View"]

STRAIGHT = 0.95
"""Cosine of the yaw up to which a ranger looks straight ahead."""


class View:
    """What a robot sees, from the newest answers of all its rangers.

    `front` is the distance ahead of the centre of the nearest point seen in the
    swath, r_min to either side of the centre line, by whatever ranger;
    `beam` is the mean of what looks straight ahead; `left` and `right` are the
    least of what looks sideways. All in metres from the centre, infinite where
    nothing is seen.
    """

    def __init__(self, profile: Profile) -> None:
        self.front = self.beam = self.left = self.right = math.inf
        self.answers: list[float] = [math.inf] * len(profile.rangers)
        """What each ranger said last, in metres from its mount."""
        self._swath = profile.parameters.r_min
        self._mounts = [_mount(ranger) for ranger in profile.rangers]
        self._aside = 0.0

    def step_aside(self, way: float) -> None:
        """Tell everything as seen from where the robot was before it went sideways.

        By `way` metres to the left, which are added to those of earlier calls.
        """
        self._aside += way
        self._mounts = [
            (x, y + way, cos, sin, side) for x, y, cos, sin, side in self._mounts
        ]

    @property
    def aside(self) -> float:
        """How far to the left of where it says the robot is, in metres."""
        return self._aside

    def take(self, answers: Iterable[float]) -> None:
        """Take in new answers.

        Parameters
        ----------
        answers : iterable of float
            One for each ranger of the profile, in its order, in metres from the
            mount; infinite where it sees nothing.
        """
        self.answers = list(answers)
        front = left = right = math.inf
        beams: list[float] = []
        swath = self._swath
        for reading, mount in zip(self.answers, self._mounts, strict=True):
            if reading == math.inf:
                continue
            x, y, cos, sin, side = mount
            ahead = x + cos * reading
            aside = y + sin * reading
            if ahead > 0.0 and -swath < aside < swath and ahead < front:
                front = ahead
            if side > 0:
                left = min(left, aside)
            elif side < 0:
                right = min(right, -aside)
            elif cos > STRAIGHT:
                beams.append(ahead)
        self.front, self.left, self.right = front, left, right
        self.beam = sum(beams) / len(beams) if beams else math.inf


def _mount(ranger: Ranger) -> tuple[float, ...]:
    """Return where a ranger sits and looks, its side as +1, -1 or 0."""
    side = looks_along(ranger, math.pi / 2) - looks_along(ranger, -math.pi / 2)
    yaw = math.cos(ranger.yaw), math.sin(ranger.yaw)
    return ranger.x, ranger.y, *yaw, float(side)
