"""What a robot's infrared rangers answer, and what that means around it."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from worlds.profile import Profile, Ranger, looks_along

if TYPE_CHECKING:
    from worlds.arena import Arena, Disc

__all__ = ["Eyes", "ray_table"]

STRAIGHT = 0.95
"""Cosine of the yaw up to which a ranger looks straight ahead."""


class Eyes:
    """The rangers of one robot, read all at once.

    `front` is the distance ahead of the centre of the nearest point seen in the
    swath, r_min to either side of the centre line, by whatever ranger;
    `beam` is the mean of what looks straight ahead; `left` and `right` are the
    least of what looks sideways. All in metres from the centre, infinite where
    nothing is seen.
    """

    def __init__(
        self,
        profile: Profile,
        arena: Arena,
        disc: Disc,
        normal: Callable[[], float],
    ) -> None:
        from worlds.rays import cast

        self.front = self.beam = self.left = self.right = math.inf
        self.answers: list[float] = [math.inf] * len(profile.rangers)
        """What each ranger said last, in metres from its mount."""
        self._arena = arena
        self._row = disc.row
        self._normal = normal
        self._swath = profile.parameters.r_min
        self._cast = cast
        self._rays = ray_table(profile.rangers)
        self._ranges = np.empty(len(profile.rangers))
        self._optics = [_optics(ranger) for ranger in profile.rangers]

    def look(self, x: float, y: float, heading: float) -> None:
        """Take a new reading of every ranger, from a pose in the world."""
        arena, ranges = self._arena, self._ranges
        self._cast(
            *(x, y, heading, self._rays, arena.walls),
            *(arena.places, self._row, ranges),
        )
        front = left = right = math.inf
        beams: list[float] = []
        swath = self._swath
        answers = self.answers
        for k, (reading, optics) in enumerate(
            zip(ranges.tolist(), self._optics, strict=True)
        ):
            answers[k] = math.inf
            if reading == math.inf:
                continue
            mount_x, mount_y, cos, sin, near, far, noise, growth, side = optics
            if noise or growth:
                deviation = noise + growth * reading * reading
                reading += deviation * self._normal()
            if reading > far:
                continue
            answers[k] = reading = max(reading, near)
            ahead = mount_x + cos * reading
            aside = mount_y + sin * reading
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


def ray_table(rangers: tuple[Ranger, ...]) -> NDArray[np.float64]:
    """Return the rays of all rangers as `worlds.rays.cast` wants them.

    Parameters
    ----------
    rangers : tuple of Ranger
        In the order of their numbers.

    Returns
    -------
    array, shape (M, 5)
        Number of the ranger, mount x and y, yaw, greatest range.
    """
    rows = []
    for k, ranger in enumerate(rangers):
        spread = np.linspace(-ranger.cone, ranger.cone, ranger.rays)
        for yaw in spread if ranger.rays > 1 else (0.0,):
            rows.append((k, ranger.x, ranger.y, ranger.yaw + yaw, ranger.far))
    return np.array(rows, dtype=float)


def _optics(ranger: Ranger) -> tuple[float, ...]:
    """Return a ranger's figures as plain numbers, its side as +1, -1 or 0."""
    side = looks_along(ranger, math.pi / 2) - looks_along(ranger, -math.pi / 2)
    return (
        *(ranger.x, ranger.y, math.cos(ranger.yaw), math.sin(ranger.yaw)),
        *(ranger.near, ranger.far, ranger.noise, ranger.noise_growth, float(side)),
    )
