"""Let one robot build the map of a world."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from behaviours.automaton import UnforeseenError
from behaviours.port import run
from topomap.bodies import body_parameters, make_body
from topomap.boundary import map_boundary
from topomap.closers import make_closer
from topomap.comparison import compare_maps
from topomap.errors import InputError, JobError
from topomap.folding import fold
from topomap.truth import true_maps
from worlds.fit import check_fit
from worlds.starts import check_start, choose_start

if TYPE_CHECKING:
    import numpy as np

    from behaviours.parameters import Parameters
    from behaviours.port import Body
    from evidence.walls import LoopCloser
    from topomap.boundary import Walk
    from topomap.comparison import Comparison
    from topomap.topological_map import TopologicalMap
    from worlds.pose import Pose
    from worlds.world import World

__all__ = ["MAX_SIGMA", "MAX_WALLS", "Build", "build_map", "check_options", "map_by"]

MAX_SIGMA = 0.5
"""Lengths that are off by half of themselves say nothing about a loop."""
MAX_WALLS = 5000
"""After so many walls an open loop is given up."""


@dataclass(frozen=True, slots=True)
class Build:
    """A map that a robot built, and what it took."""

    map: TopologicalMap
    """Of the closed loop; of the open walk where no closure was found."""
    closed: bool
    """Whether the robot decided that it had come round."""
    comparison: Comparison
    """With the world's truth."""
    walk: Walk
    """Every wall walked, and what was made of it."""
    start: Pose
    """Where the robot was set down."""
    travelled: float
    """True way, in metres."""
    simulated: float
    """Time in the robot's world, in seconds."""
    collisions: int
    """How often the body began to touch something."""

    @property
    def correct(self) -> bool:
        """Whether the map is closed and isomorphic to the truth."""
        return self.closed and self.comparison.correct

    @property
    def hypotheses(self) -> int:
        """How many closures were ever thought possible."""
        return len(
            {
                hypothesis.period
                for decision in self.walk.decisions
                for hypothesis in decision.hypotheses
            }
        )


def build_map(
    world: World,
    rng: np.random.Generator,
    *,
    body: str = "ideal",
    sigma: float = 0.06,
    start: Pose | None = None,
    parameters: Parameters | None = None,
    closing: str | LoopCloser = "likelihood",
    max_walls: int = MAX_WALLS,
    watch: Callable[[Body], Body] | None = None,
) -> Build:
    """Set a robot down in a world and let it map the boundary it first meets.

    Parameters
    ----------
    world : World
        Rectilinear, all passages wider than 2 r0.
    rng : numpy.random.Generator
        Draws the start, where none is given, and all of the body's errors.
    body : {"ideal", "physical"} or a profile's name
        What executes the behaviours; see `topomap.bodies.make_body`.
    sigma : float
        Standard deviation of a measured length, as a part of the length, from
        0, exact, to 0.5. The robot knows it.
    start : Pose, optional
        Where the robot is set down. Chosen at random where None.
    parameters : Parameters, optional
        The lengths the robot keeps; the body's own where None.
    closing : str or LoopCloser
        Decides when the robot has come round; names as in
        `topomap.closers.CLOSINGS`.
    max_walls : int
        The loop is given up as open after so many walls.
    watch : callable, optional
        Given the body before it moves; what it returns is used in its place. So a
        recorder can look on, as `topomap.page.BuildRecorder` does.

    Returns
    -------
    Build
        The map, whether it is correct, and what it took.

    Raises
    ------
    InputError
        If a name is unknown or sigma is out of range.
    WorldError
        If the world is not rectilinear, too narrow, or the start is not free.
    JobError
        If the robot is stuck or loses its wall.

    Notes
    -----
    The ideal body takes about 0.1 ms a wall. The same generator state gives the
    same build, bit for bit.

    Examples
    --------
    A robot whose lengths are 5 % off comes round an L-shaped room:

    >>> import numpy as np
    >>> import worlds
    >>> room = worlds.make("l", np.random.default_rng(1))
    >>> build = build_map(room, np.random.default_rng(7), sigma=0.05)
    >>> build.correct, len(build.map.vertices), build.map.unexplored_exits
    (True, 6, 0)
    """
    check_options(sigma, max_walls)
    start_rng, body_rng = rng.spawn(2)
    parameters = parameters or body_parameters(body)
    check_fit(world, parameters)
    if start is None:
        start = choose_start(world, parameters, start_rng)
    check_start(world, parameters, start)
    robot = make_body(body, world, start, body_rng, sigma=sigma, parameters=parameters)
    if watch is not None:
        robot = watch(robot)
    closer = (
        make_closer(closing, sigma, parameters) if isinstance(closing, str) else closing
    )
    walk, chart = map_by(robot, closer, max_walls, sigma)
    return Build(
        chart,
        walk.period is not None,
        compare_maps(chart, *true_maps(world, parameters)),
        walk,
        start,
        robot.travelled,
        robot.clock,
        robot.collisions,
    )


def map_by(
    body: Body, closer: LoopCloser, max_walls: int, sigma: float
) -> tuple[Walk, TopologicalMap]:
    """Let a body map the boundary that it first meets.

    Parameters
    ----------
    body : Body
        Simulated, real or recorded.
    closer : LoopCloser
        Decides when it has come round.
    max_walls : int
        The loop is given up as open after so many walls.
    sigma : float
        Standard deviation of a measured length, as a part of the length.

    Returns
    -------
    Walk, TopologicalMap
        What it met, and the map of that, closed or open.

    Raises
    ------
    JobError
        If the body is stuck or loses its wall.
    """
    try:
        walk = run(map_boundary(body.parameters, closer, max_walls), body)
    except UnforeseenError as error:
        raise JobError(str(error)) from error
    return walk, fold(walk, body.parameters, sigma)


def check_options(sigma: float | None, max_walls: int | None) -> None:
    """Check what a map is made by; None is right.

    Raises
    ------
    InputError
        If sigma or the number of walls is out of range.
    """
    if sigma is not None and not (math.isfinite(sigma) and 0 <= sigma <= MAX_SIGMA):
        raise InputError("", "sigma", sigma, f"a part between 0 and {MAX_SIGMA}")
    if max_walls is not None and max_walls < 1:
        raise InputError("", "max_walls", max_walls, "a number of at least 1")
