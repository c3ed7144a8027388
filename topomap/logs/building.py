"""How a map is built and its run logged, in one call."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from os import PathLike
from typing import TYPE_CHECKING, Any

from topomap.bodies import body_drift, body_parameters, body_slip
from topomap.closers import make_closer
from topomap.found import MAX_WALLS
from topomap.logs.recording import recording
from topomap.mapping import Build, build_map
from worlds.fit import is_open

if TYPE_CHECKING:
    import numpy as np

    from behaviours.parameters import Parameters
    from behaviours.port import Body
    from evidence.walls import LoopCloser
    from worlds.pose import Pose
    from worlds.world import World

__all__ = ["about_run", "build_logged"]


def build_logged(
    world: World,
    rng: np.random.Generator,
    log: str | PathLike[str],
    *,
    body: str = "ideal",
    sigma: float = 0.06,
    start: Pose | None = None,
    parameters: Parameters | None = None,
    closing: str = "likelihood",
    max_walls: int = MAX_WALLS,
    improve: str = "none",
    watch: Callable[[Body], Body] | None = None,
    listen: Callable[[LoopCloser], LoopCloser] | None = None,
) -> Build:
    """Build a map as `topomap.build_map` does, and log the run.

    Parameters
    ----------
    world : World
        As for `topomap.build_map`, as all options that are not explained here.
    rng : numpy.random.Generator
        Draws all that is drawn.
    log : path-like
        MCAP file to write. It is kept of a job that failed, too.
    body : str
        Name of the body.
    sigma : float
        Standard deviation of a measured length, as a part of the length.
    start : Pose, optional
        Where the robot is set down.
    parameters : Parameters, optional
        The lengths the robot keeps.
    closing : str
        One of `topomap.closers.CLOSINGS`.
    max_walls : int
        The loop is given up as open after so many walls.
    improve : {"none", "passive", "active"}
        What is done to the closed base map.
    watch : callable, optional
        Gets the body, and returns one that does the same and looks on.
    listen : callable, optional
        Gets the closer, and returns one that does the same and looks on.

    Returns
    -------
    Build
        The same as without a log, bit for bit.

    Raises
    ------
    InputError
        If the log cannot be written, the packages for logs are missing, or as
        `topomap.build_map`.
    JobError
        As `topomap.build_map`.

    Examples
    --------
    >>> import numpy as np, worlds
    >>> from tempfile import TemporaryDirectory
    >>> from topomap.logs.replaying import read_recorded, replay_map
    >>> room = worlds.make("l", np.random.default_rng(1))
    >>> with TemporaryDirectory() as folder:
    ...     log = folder + "/run.mcap"
    ...     build = build_logged(room, np.random.default_rng(7), log)
    ...     recorded, topics = read_recorded(log)
    >>> replay_map(recorded).map == build.map, topics["/odom"]
    (True, 'nav_msgs/msg/Odometry')
    """
    lengths = parameters or body_parameters(body)
    slip = body_slip(body)
    closer = make_closer(closing, sigma, lengths, slip=slip)
    about = {
        "body": body,
        "start": None if start is None else asdict(start),
        "sigma": sigma,
        "closing": closing,
        "slip": slip,
        "max_walls": max_walls,
        "improve": improve,
    }
    with recording(log, about_run(world, lengths, **about)) as recorder:
        built = build_map(
            world,
            rng,
            body=body,
            sigma=sigma,
            start=start,
            parameters=parameters,
            closing=recorder.listen(closer if listen is None else listen(closer)),
            max_walls=max_walls,
            improve=improve,
            watch=lambda robot: recorder.watch(
                robot if watch is None else watch(robot)
            ),
        )
        recorder.show(built.map)
    return built


def about_run(world: World, parameters: Parameters, **about: Any) -> dict[str, Any]:
    """Return what the log of a simulated run says of it.

    Parameters
    ----------
    world : World
        Decides which exploration is called for.
    parameters : Parameters
        The lengths the robot keeps.
    **about
        The options of the run, ``body`` and ``sigma`` among them.

    Returns
    -------
    dict
        The options; whether there are ``halls``; and the ``drift`` of the body, which
        decides which incursions are sure.
    """
    drift = asdict(body_drift(about["body"], about["sigma"]))
    return {**about, "halls": not is_open(world, parameters), "drift": drift}
