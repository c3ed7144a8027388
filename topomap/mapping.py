"""Let one robot build the map of a world."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from behaviours.automaton import UnforeseenError
from behaviours.port import run
from topomap.bodies import body_drift, body_parameters, make_body
from topomap.boundary import map_boundary
from topomap.closers import make_closer
from topomap.comparison import compare_maps
from topomap.errors import InputError, JobError
from topomap.folding import fold
from topomap.incursions.improving import IMPROVEMENTS, Improvement, improve_map
from topomap.parts import compare_wholes, in_one
from topomap.truth import true_maps
from worlds.fit import check_fit
from worlds.starts import check_start, choose_start

if TYPE_CHECKING:
    import numpy as np

    from behaviours.parameters import Parameters
    from evidence.walls import LoopCloser
    from topomap.boundary import Walk
    from topomap.comparison import Comparison
    from topomap.topological_map import TopologicalMap
    from worlds.pose import Pose
    from worlds.world import World

__all__ = ["MAX_SIGMA", "Build", "build_map"]

MAX_SIGMA = 0.5
"""Lengths that are off by half of themselves say nothing about a loop."""
MAX_WALLS = 5000
"""After so many walls an open loop is given up."""


@dataclass(frozen=True, slots=True)
class Build:
    """A map that a robot built, and what it took."""

    map: TopologicalMap
    """Of the closed loop, improved; of the open walk where no closure was found."""
    closed: bool
    """Whether the robot decided that it had come round."""
    comparison: Comparison
    """With the world's truth: of one loop; of all loops with active incursions."""
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
    improvement: Improvement | None = None
    """What was done to the base map; None where its loop stayed open."""

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
    improve: str = "none",
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
    improve : {"none", "passive", "active"}
        What is done to the closed base map: incursions through space that was seen,
        or driven ones too, which find the islands; see `topomap.incursions`.

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
    if not (math.isfinite(sigma) and 0 <= sigma <= MAX_SIGMA):
        raise InputError("", "sigma", sigma, f"a part between 0 and {MAX_SIGMA}")
    if improve not in IMPROVEMENTS:
        raise InputError("", "improve", improve, f"one of {', '.join(IMPROVEMENTS)}")
    if max_walls < 1:
        raise InputError("", "max_walls", max_walls, "a number of at least 1")
    start_rng, body_rng = rng.spawn(2)
    parameters = parameters or body_parameters(body)
    check_fit(world, parameters)
    if start is None:
        start = choose_start(world, parameters, start_rng)
    check_start(world, parameters, start)
    robot = make_body(body, world, start, body_rng, sigma=sigma, parameters=parameters)
    closer = (
        make_closer(closing, sigma, parameters) if isinstance(closing, str) else closing
    )
    try:
        walk = run(map_boundary(parameters, closer, max_walls), robot)
    except UnforeseenError as error:
        raise JobError(str(error)) from error
    chart = fold(walk, parameters, sigma)
    improvement = None
    if walk.period is not None:
        name = closing if isinstance(closing, str) else "likelihood"
        improvement = improve_map(
            chart,
            improve,
            body_drift(body, sigma),
            body=robot,
            vertex=len(walk.legs) % walk.period,
            make_closer=lambda: make_closer(name, sigma, parameters),
        )
        chart = improvement.map
    truth = true_maps(world, parameters)
    return Build(
        chart,
        walk.period is not None,
        compare_wholes(chart, in_one(truth))
        if improve == "active"
        else compare_maps(chart, *truth),
        walk,
        start,
        robot.travelled,
        robot.clock,
        robot.collisions,
        improvement,
    )
