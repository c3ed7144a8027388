"""Let one robot build the map of a world."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from topomap.bodies import body_drift, body_parameters, body_slip, make_body
from topomap.closers import make_closer
from topomap.comparison import compare_maps
from topomap.errors import InputError
from topomap.found import MAX_WALLS, Found, check_options, map_by
from topomap.incursions.improving import IMPROVEMENTS, Improvement, improve_found
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
    from worlds.pose import Pose
    from worlds.profile import Profile
    from worlds.world import World

__all__ = ["Build", "build_map"]


@dataclass(frozen=True, slots=True)
class Build(Found):
    """A map that a robot built, and what it took."""

    comparison: Comparison
    """With the world's truth: of one loop; of all loops with active incursions."""
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


def build_map(
    world: World,
    rng: np.random.Generator,
    *,
    body: str | Profile = "ideal",
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
    body : {"ideal", "physical"}, a profile's name or a Profile
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
    check_options(sigma, max_walls)
    if improve not in IMPROVEMENTS:
        raise InputError("", "improve", improve, f"one of {', '.join(IMPROVEMENTS)}")
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
        make_closer(closing, sigma, parameters, slip=body_slip(body))
        if isinstance(closing, str)
        else closing
    )
    halls = not is_open(world, parameters)
    if halls and improve == "active":
        expected = "none or passive: ways are driven in worlds without halls"
        raise InputError("", "improve", improve, expected)
    found = map_by(robot, closer, max_walls, sigma, halls=halls)
    name = closing if isinstance(closing, str) else "likelihood"
    drift = body_drift(body, sigma)
    improvement = improve_found(found, improve, drift, robot, name)
    chart = improvement.map if improvement else found.map
    return Build(
        *(chart, found.closed, found.loops, found.recognitions, found.walls),
        found.refuted,
        compare_wholes(chart, in_one(truth))
        if improve == "active"
        else compare_maps(chart, *truth),
        start,
        robot.travelled,
        robot.clock,
        robot.collisions,
        improvement,
    )
