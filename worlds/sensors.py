"""What a simulated robot's infrared rangers answer."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from worlds.profile import Profile, Ranger
from worlds.view import View

if TYPE_CHECKING:
    from worlds.arena import Arena, Disc

__all__ = ["Eyes", "ray_table"]


class Eyes(View):
    """The rangers of one simulated robot, read all at once."""

    def __init__(
        self,
        profile: Profile,
        arena: Arena,
        disc: Disc,
        normal: Callable[[], float],
    ) -> None:
        from worlds.rays import cast

        super().__init__(profile)
        self._arena = arena
        self._row = disc.row
        self._normal = normal
        self._cast = cast
        self._rays = ray_table(profile.rangers)
        self._ranges = np.empty(len(profile.rangers))
        self.screen: Callable[[list[float]], list[float]] | None = None
        """Takes out of the answers what is of other robots, where it is told from
        walls."""
        self._optics = [
            (ranger.near, ranger.far, ranger.noise, ranger.noise_growth)
            for ranger in profile.rangers
        ]

    def look(self, x: float, y: float, heading: float) -> None:
        """Take a new reading of every ranger, from a pose in the world."""
        arena, ranges = self._arena, self._ranges
        self._cast(
            *(x, y, heading, self._rays, arena.walls),
            *(arena.places, self._row, ranges),
        )
        answers = ranges.tolist()
        for k, reading in enumerate(answers):
            if reading == math.inf:
                continue
            near, far, noise, growth = self._optics[k]
            if noise or growth:
                deviation = noise + growth * reading * reading
                reading += deviation * self._normal()
            answers[k] = math.inf if reading > far else max(reading, near)
        self.take(answers if self.screen is None else self.screen(answers))


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
