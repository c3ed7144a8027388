"""The physical body: wheels that slip, eyes that see no farther than a step.

It knows what a real robot knows, its wheels' counts, its rangers and its
bumper, and carries out the primitives of `behaviours.port` as closed-loop
controllers at a fixed time step.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from worlds.controlled import ControlledBody
from worlds.simulated_robot import SimulatedRobot

if TYPE_CHECKING:
    import numpy as np

    from behaviours.parameters import Parameters
    from worlds.arena import Arena
    from worlds.pose import Pose
    from worlds.profile import Profile

__all__ = ["PhysicalBody"]


class PhysicalBody(ControlledBody):
    """A simulated robot that executes primitives; a `behaviours.port.Body`.

    Parameters
    ----------
    arena : Arena
        The world it stands in, shared with other robots or not.
    start : Pose
        Where its centre is, at any heading.
    profile : Profile
        What it is made of; `worlds.profiles.PROFILES` has some by name.
    rng : numpy.random.Generator
        Draws all its errors.
    sigma : float
        Standard deviation of a straight leg's measured length, as a part of its
        length, from 0 to 0.5: slip of the wheels and their wrong radius. The
        error is drawn anew at each turn.
    parameters : Parameters, optional
        The lengths it keeps, if not its profile's own.

    Raises
    ------
    WorldError
        If it does not fit at its start.
    ProfileError
        If it cannot keep the parameters.
    ValueError
        If sigma is out of its range.

    Notes
    -----
    Besides sigma, the profile's own noise is at work: of the rangers, of the
    wheels over a time step, a bend of each leg, and an error of each turn. For
    exact lengths, within a centimetre or two, take ``profile.without_noise()``
    and sigma 0.

    The robot's heading is known from the walls alone: following a wall corrects
    it, turning and driving make it vaguer. Errors of the sensed geometry differ
    from the ideal body's in one way that the port leaves open: behind an inner
    corner whose wall is shorter than r0, `Follow` ends RECEDED at a *negative*
    distance, for the wall's edge lies behind the place where it began.

    Examples
    --------
    Along the wall of a room, up to the next one:

    >>> import numpy as np
    >>> from behaviours.port import Follow
    >>> from worlds.arena import Arena
    >>> from worlds.pose import Pose
    >>> from worlds.profiles import GENERIC
    >>> from worlds.world import make_world
    >>> arena = Arena(make_world([(0, 0), (4, 0), (4, 3), (0, 3)]))
    >>> rng = np.random.default_rng(1)
    >>> body = PhysicalBody(arena, Pose(2, 0.3), GENERIC, rng, sigma=0)
    >>> outcome = body.execute(Follow())
    >>> outcome.reason.name, round(outcome.distance, 1)
    ('BLOCKED', 1.7)
    """

    def __init__(
        self,
        arena: Arena,
        start: Pose,
        profile: Profile,
        rng: np.random.Generator,
        sigma: float = 0.06,
        parameters: Parameters | None = None,
    ) -> None:
        if not 0.0 <= sigma <= 0.5:
            raise ValueError(f"sigma must be from 0 to 0.5; got {sigma}")
        if parameters is not None:
            profile = replace(profile, parameters=parameters)
        self.arena = arena
        """The world it stands in, and whoever else is there."""
        self._simulated = SimulatedRobot(arena, start, profile, rng, sigma)
        super().__init__(self._simulated)

    @property
    def travelled(self) -> float:
        """True way since the start, in metres."""
        return self._simulated.travelled

    @property
    def clock(self) -> float:
        """Time since the arena's start, in simulated seconds."""
        return self.arena.clock

    @property
    def collisions(self) -> int:
        """How often the body has begun to touch a wall or another robot."""
        return self._simulated.disc.contacts

    @property
    def pose(self) -> tuple[float, float, float]:
        """True x and y, in metres, and heading, in radians, in the world's frame."""
        disc = self._simulated.disc
        return disc.x, disc.y, disc.angle

    def pass_time(self) -> None:
        """Let one time step pass for all robots of the arena."""
        self.arena.step()
