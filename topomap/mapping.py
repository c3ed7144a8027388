"""Let one robot build the map of a world."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from behaviours.automaton import UnforeseenError
from behaviours.port import run
from behaviours.vertices import VertexType
from topomap.bodies import body_drift, body_parameters, make_body
from topomap.boundary import Walk, map_boundary
from topomap.closers import make_closer
from topomap.comparison import compare_maps
from topomap.embedding import embedded
from topomap.errors import InputError, JobError
from topomap.exploring import explore_halls
from topomap.folding import fold
from topomap.incursions.improving import IMPROVEMENTS, Improvement, improve_map
from topomap.parts import compare_wholes, in_one
from topomap.truth import true_maps
from worlds.fit import is_open
from worlds.starts import check_start, choose_start

if TYPE_CHECKING:
    import numpy as np

    from behaviours.parameters import Parameters
    from behaviours.port import Body
    from evidence.walls import LoopCloser
    from topomap.comparison import Comparison
    from topomap.recognition import Recognition
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
    loops: tuple[Walk, ...]
    """Every base loop as it was walked, and what was made of each wall."""
    recognitions: tuple[Recognition, ...]
    """What was made of vertices beyond halls that may be earlier ones."""
    walls: int
    """How many edges were walked, known ones included."""
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
        """How many closures and recognitions were ever thought possible."""
        closures = {
            (k, hypothesis.period)
            for k, walk in enumerate(self.loops)
            for decision in walk.decisions
            for hypothesis in decision.hypotheses
        }
        recognised = {
            (found.vertex, candidate)
            for found in self.recognitions
            for candidate, _ in found.candidates
        }
        return len(closures) + len(recognised)

    @property
    def error_probability(self) -> float:
        """Probability, by the robot's own account, that the map is wrong somewhere.

        The sum over all loops and over all vertices that may have been earlier ones.
        """
        last = {found.vertex: found.doubt for found in self.recognitions}
        loops = (walk.decisions[-1] for walk in self.loops if walk.decisions)
        total = sum(last.values()) + sum(loop.error_probability for loop in loops)
        return min(1.0, total)

    @property
    def reason(self) -> str:
        """Why the loop that is least sure was closed, or is open."""
        decided = [walk.decisions[-1] for walk in self.loops if walk.decisions]
        worst = max(decided, key=lambda d: (d.period is None, d.error_probability))
        return worst.reason

    @property
    def walk(self) -> Walk:
        """The base loop that was walked first; an empty one if there is none."""
        return self.loops[0] if self.loops else Walk(VertexType.TERM, (), ())


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
    improve: str = "none",
) -> Build:
    """Set a robot down in a world and let it map all it can reach along walls.

    Parameters
    ----------
    world : World
        Rectilinear. Where all passages are wider than 2 r0 there is one boundary
        loop to walk; else the robot explores rooms and halls, 2 r_w to 2 r0 wide.
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
    truth = true_maps(world, parameters)
    if start is None:
        start = choose_start(world, parameters, start_rng)
    check_start(world, parameters, start)
    robot = make_body(body, world, start, body_rng, sigma=sigma, parameters=parameters)
    if watch is not None:
        robot = watch(robot)
    closer = (
        make_closer(closing, sigma, parameters) if isinstance(closing, str) else closing
    )
    has_halls = not is_open(world, parameters)
    if has_halls and improve != "none":
        expected = "none: incursions are for worlds without halls"
        raise InputError("", "improve", improve, expected)
    explore = _explore_halls if has_halls else _explore_open
    try:
        found = explore(robot, closer, sigma, max_walls)
    except UnforeseenError as error:
        raise JobError(str(error)) from error
    improvement = None
    if found["closed"] and not has_halls:
        (walk,) = found["loops"]
        name = closing if isinstance(closing, str) else "likelihood"
        improvement = improve_map(
            found["map"],
            improve,
            body_drift(body, sigma),
            body=robot,
            vertex=len(walk.legs) % walk.period,
            make_closer=lambda: make_closer(name, sigma, parameters),
        )
        found["map"] = improvement.map
    return Build(
        comparison=compare_wholes(found["map"], in_one(truth))
        if improve == "active"
        else compare_maps(found["map"], *truth),
        start=start,
        travelled=robot.travelled,
        simulated=robot.clock,
        collisions=robot.collisions,
        improvement=improvement,
        **found,
    )


def _explore_open(
    robot: Body, closer: LoopCloser, sigma: float, max_walls: int
) -> dict[str, Any]:
    """Map the one boundary loop that is all there is without halls, [K] 3.2.2."""
    walk = run(map_boundary(robot.parameters, closer, max_walls), robot)
    return {
        "map": fold(walk, robot.parameters, sigma),
        "closed": walk.period is not None,
        "loops": (walk,),
        "recognitions": (),
        "walls": len(walk.legs),
    }


def _explore_halls(
    robot: Body, closer: LoopCloser, sigma: float, max_walls: int
) -> dict[str, Any]:
    """Map loops and the halls between them, until no exit is unexplored."""
    found = run(explore_halls(robot.parameters, closer, sigma, max_walls), robot)
    return {
        "map": embedded(found.chart.as_map(robot.parameters, sigma)),
        "closed": found.closed,
        "loops": tuple(found.loops),
        "recognitions": tuple(found.recognitions),
        "walls": found.walls,
    }
