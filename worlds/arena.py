"""Walls that stop, robots that collide: the physics of a world, by Pymunk.

Bodies are driven by forces. To set `body.velocity` before each step would
defeat the collisions: the step first moves a body by that velocity, into the
wall, and only then computes what the wall answers.
"""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np
import pymunk
import shapely
from numpy.typing import NDArray

from worlds.errors import WorldError
from worlds.pose import Pose
from worlds.walled_space import ROBOT, walled_space
from worlds.world import World

__all__ = ["Arena", "Disc", "Rider"]

GRIP = 8.0
"""Most that the wheels push, in newtons a kilogram: rubber on a floor."""
STRIDE = 0.005
"""Farthest, in metres, that a body goes between two tests for contact."""
NOBODY = pymunk.ShapeFilter(categories=0, mask=0)
"""What a robot off the floor collides with."""


class Rider(Protocol):
    """What takes part in every time step of an arena: the inside of a robot."""

    def act(self) -> None:
        """Set the disc's wished speed and spin, before the step."""

    def sense(self) -> None:
        """Take note of what the step has changed, after it."""


class Disc:
    """The round body of one robot, driven by a force and a torque.

    Made by `Arena.add`.
    """

    __slots__ = (
        *("_inertia", "_mass", "angle", "body", "contacts", "radius", "row"),
        *("speed", "spin", "touching", "x", "y"),
    )

    def __init__(self, body: pymunk.Body, radius: float, row: int) -> None:
        self.body = body
        self.radius = radius
        self.row = row
        """Which of the arena's robots it is."""
        self.x, self.y = body.position
        """Where its centre is, in metres."""
        self.angle = body.angle
        """Its heading, in radians."""
        self.speed = 0.0
        """What the wheels strive for ahead, in metres a second."""
        self.spin = 0.0
        """What the wheels strive for in turning, in radians a second."""
        self.contacts = 0
        """How often it has begun to touch a wall or a robot."""
        self.touching = 0
        """How many walls and robots it touches now."""
        self._mass = body.mass
        self._inertia = body.moment

    def locate(self) -> None:
        """Read from the physics where the body is."""
        self.x, self.y = self.body.position
        self.angle = self.body.angle

    def push(self, dt: float) -> None:
        """Press on the ground so as to reach the wished speed in one step."""
        body = self.body
        angle = self.angle
        vx, vy = body.velocity
        fx = self._mass * (self.speed * math.cos(angle) - vx) / dt
        fy = self._mass * (self.speed * math.sin(angle) - vy) / dt
        most = GRIP * self._mass
        size = math.hypot(fx, fy)
        if size > most:
            fx, fy = fx * most / size, fy * most / size
        body.force = (fx, fy)
        body.torque = self._inertia * (self.spin - body.angular_velocity) / dt


class Arena:
    """A world that robots share, with one clock.

    Parameters
    ----------
    world : World
        Its walls are those of all rings.
    time_step : float
        Seconds between two decisions of a robot.
    ghosts : bool
        Whether robots pass through each other, unseen, as if each were alone.

    Raises
    ------
    ValueError
        If the time step is not a positive number of seconds.
    """

    def __init__(
        self, world: World, time_step: float = 0.02, *, ghosts: bool = False
    ) -> None:
        if not (math.isfinite(time_step) and time_step > 0):
            raise ValueError(f"time_step must be finite and above 0; got {time_step}")
        self.world = world
        self.time_step = time_step
        self.ghosts = ghosts
        self.ticks = 0
        self.discs: list[Disc] = []
        self.riders: list[Rider] = []
        """The insides of the robots; each joins by itself."""
        self.places: NDArray[np.float64] = np.zeros((0, 3))
        """Centre and radius of each robot, in metres; no ray meets a radius below 0."""
        self.walls = np.array(
            [
                (*a, *b)
                for ring in world.rings
                for a, b in zip(ring, ring[1:] + ring[:1], strict=True)
            ]
        )
        self._free = world.free_space
        self._substeps = 1
        self._disc_of: dict[pymunk.Shape, Disc] = {}
        self._space = walled_space(self.walls, self._disc_of)

    @property
    def clock(self) -> float:
        """Time since the start, in seconds."""
        return self.ticks * self.time_step

    def add(self, pose: Pose, radius: float, mass: float, speed: float) -> Disc:
        """Put a robot into the world.

        Parameters
        ----------
        pose : Pose
            Where its centre is, in metres and radians.
        radius, mass : float
            In metres and kilograms.
        speed : float
            The fastest that it will go, in metres a second.

        Returns
        -------
        Disc
            The robot in the world, standing.

        Raises
        ------
        WorldError
            If the body does not fit there.
        """
        self._check_place(pose, radius)
        body = pymunk.Body(mass, pymunk.moment_for_circle(mass, 0.0, radius))
        body.position, body.angle = (pose.x, pose.y), pose.heading
        shape = pymunk.Circle(body, radius)
        shape.collision_type = ROBOT
        shape.friction = 0.5
        if self.ghosts:
            shape.filter = pymunk.ShapeFilter(group=1)
        self._space.add(body, shape)
        disc = Disc(body, radius, len(self.discs))
        self._disc_of[shape] = disc
        self.discs.append(disc)
        seen = -1.0 if self.ghosts else radius
        self.places = np.vstack([self.places, (pose.x, pose.y, seen)])
        needed = math.ceil(speed * self.time_step / STRIDE)
        self._substeps = max(self._substeps, needed)
        return disc

    def lift(self, disc: Disc) -> None:
        """Take a robot off the floor: nothing meets it or sees it."""
        self._shape_of(disc).filter = NOBODY
        self.places[disc.row, 2] = -1.0

    def lower(self, disc: Disc) -> bool:
        """Put it back where it was; return whether there was room for it."""
        places = self.places[self.places[:, 2] > 0]
        gaps = np.hypot(places[:, 0] - disc.x, places[:, 1] - disc.y) - places[:, 2]
        if (gaps < disc.radius).any():
            return False
        self._shape_of(disc).filter = pymunk.ShapeFilter()
        self.places[disc.row, 2] = disc.radius
        return True

    def _shape_of(self, disc: Disc) -> pymunk.Shape:
        return next(iter(disc.body.shapes))

    def step(self) -> None:
        """Let one time step pass for all robots."""
        for rider in self.riders:
            rider.act()
        self.ticks += 1
        dt = self.time_step / self._substeps
        for _ in range(self._substeps):
            for disc in self.discs:
                disc.push(dt)
            self._space.step(dt)
            for disc in self.discs:
                disc.locate()
        places = self.places
        for disc in self.discs:
            places[disc.row, 0] = disc.x
            places[disc.row, 1] = disc.y
        for rider in self.riders:
            rider.sense()

    def _check_place(self, pose: Pose, radius: float) -> None:
        """Refuse a place in a wall, outside, or in another robot."""
        here = f"({pose.x:g}, {pose.y:g})"
        if not all(map(math.isfinite, (pose.x, pose.y, pose.heading))):
            raise WorldError("start", f"expected finite numbers; got {pose}")
        centre = shapely.Point(pose.x, pose.y)
        if not self._free.contains(centre):
            raise WorldError("start", f"{here} is not in free space")
        gap = self._free.boundary.distance(centre)
        if gap < radius:
            fault = f"{here} is {gap:.3f} m from a wall; the body needs {radius:g} m"
            raise WorldError("start", fault)
        for other in self.discs:
            gap = math.hypot(other.x - pose.x, other.y - pose.y)
            if gap < radius + other.radius:
                fault = f"{here} is {gap:.3f} m from another robot's centre"
                raise WorldError("start", fault)
