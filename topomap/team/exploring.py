"""Let a team without a common frame explore a world."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

from topomap.bodies import body_parameters, body_slip
from topomap.closers import make_closer
from topomap.errors import InputError
from topomap.exploration.registry import find_allocator
from topomap.explored import Exploration
from topomap.found import MAX_SIGMA, MAX_WALLS
from topomap.team.agent import Agent
from topomap.team.channel import Channel, Radio
from topomap.team.collecting import merge_all, robot_run
from topomap.team.faults import Fault
from topomap.team.frontiers import check_target
from topomap.team.grid_adapter import grid_lengths
from topomap.team.messages import MOST
from topomap.team.placing import place
from topomap.team.result import TeamRun
from topomap.team.scheduling import Member, run_by_clocks, run_in_arena
from topomap.team.sharing import Knowledge
from topomap.team.starts import check_starts, choose_starts
from topomap.truth import true_maps
from worlds.crew_body import CrewBody

if TYPE_CHECKING:
    import numpy as np

    from behaviours.parameters import Parameters
    from topomap.team.frames import Origin
    from worlds.ideal import IdealBody
    from worlds.pose import Pose
    from worlds.world import World

__all__ = ["explore"]

FRAMES = ("own", "common")
LIMIT = 1e5
"""Seconds after which a run is given up."""


def explore(
    world: World,
    rng: np.random.Generator,
    *,
    robots: int = 4,
    body: str = "ideal",
    sigma: float = 0.06,
    allocator: str = "minpos",
    target: str = "graph",
    frame: str = "own",
    radio: Radio | None = None,
    starts: Sequence[Pose] | None = None,
    faults: Sequence[Fault] = (),
    returns: bool = False,
    parameters: Parameters | None = None,
    closing: str = "likelihood",
    limit: float = LIMIT,
) -> TeamRun:
    """Let robots that know nothing of each other's starts explore a world together.

    Each builds its own map in its own frame. Within radio range they tell each other
    their maps and where they go; maps that surely fit are merged, and each robot goes
    to the exit that it allots to itself, until it knows of none that is open.

    Parameters
    ----------
    world : World
        Rectilinear.
    rng : numpy.random.Generator
        Draws starts, errors, and what becomes of messages.
    robots : int
        How many, from 1 to 64.
    body : str
        As for `topomap.build_map`. Physical robots share one space: they see each
        other's beacons, and give way.
    sigma : float
        Standard deviation of a measured length, as a part of the length.
    allocator : str
        Any of `topomap.exploration.allocators`.
    target : {"graph", "grid"}
        Distances by the edges of the map, or on a grid laid under it.
    frame : {"own", "common"}
        Whether every robot has a frame of its own, or all know where they were set
        down, so that places that both met are told by where they lie.
    radio : Radio, optional
        How well robots hear each other; everywhere and always where None.
    starts : sequence of Pose, optional
        Where they are set down; drawn where None.
    faults : sequence of Fault
        What goes wrong, a robot once at most.
    returns : bool
        Whether each robot ends at its first vertex.
    parameters : Parameters, optional
        The lengths the robots keep; the body's own where None.
    closing : str
        As for `topomap.build_map`.
    limit : float
        Give up after so many simulated seconds.

    Returns
    -------
    TeamRun
        Every robot's map, the merged one, and what it took.

    Raises
    ------
    InputError
        If a name is unknown or a number out of range.
    WorldError
        If the world is not rectilinear, or a start is not free.

    Examples
    --------
    Two robots in a building of rooms and halls:

    >>> import numpy as np, worlds
    >>> building = worlds.make("rooms", np.random.default_rng(1))
    >>> run = explore(building, np.random.default_rng(2), robots=2, sigma=0.0)
    >>> run.correct, run.merges
    (True, 2)
    """
    _check(robots, sigma, target, starts, faults, limit)
    if frame not in FRAMES:
        raise InputError("", "frame", frame, f"one of {', '.join(FRAMES)}")
    origins: dict[int, Origin] = {}
    find_allocator(allocator)
    parameters = parameters or body_parameters(body)
    truth = true_maps(world, parameters)
    start_rng, body_rng, air_rng = rng.spawn(3)
    if starts is None:
        starts = choose_starts(world, parameters, robots, start_rng)
    check_starts(world, parameters, starts)
    air = Channel(radio or Radio(), world, robots, air_rng)
    fault_of = {fault.robot: fault for fault in faults}
    team: list[Member] = []
    bodies, arena = place(body, world, starts, parameters, sigma, body_rng)
    for k, placed in enumerate(bodies):
        fault = fault_of.get(k, Fault(k))
        closer = make_closer(closing, sigma, parameters, slip=body_slip(body))
        found = Exploration(parameters, closer, sigma, MAX_WALLS)
        agent = _agent(k, found, air, team, fault)
        agent.allocator, agent.returns = allocator, returns
        if frame == "common":
            agent.known.origins, agent.locate = origins, partial(_pose, placed)
        if target == "grid":
            agent.costs = grid_lengths(parameters, sigma)
        if isinstance(placed, CrewBody):
            agent.beset, agent.gave_way = placed.beset, partial(_detours, placed)
        team.append(Member(agent, placed, fault.comes, fault.dies))
    end = (
        run_by_clocks(team, limit)
        if arena is None
        else run_in_arena(team, arena, limit)
    )
    return TeamRun(
        tuple(
            robot_run(member, start, truth)
            for member, start in zip(team, starts, strict=True)
        ),
        merge_all(team, parameters, sigma, truth),
        tuple(
            sorted(
                (event for member in team for event in member.agent.events),
                key=lambda event: event.time,
            )
        ),
        air.traffic,
        end,
    )


def _check(
    robots: int,
    sigma: float,
    target: str,
    starts: Sequence[Pose] | None,
    faults: Sequence[Fault],
    limit: float,
) -> None:
    """Refuse what is out of range."""
    if not 1 <= robots <= MOST:
        raise InputError("", "robots", robots, f"from 1 to {MOST}")
    if not (math.isfinite(sigma) and 0 <= sigma <= MAX_SIGMA):
        raise InputError("", "sigma", sigma, f"a part between 0 and {MAX_SIGMA}")
    check_target(target)
    if starts is not None and len(starts) != robots:
        raise InputError("", "starts", len(starts), f"one a robot, {robots}")
    if not limit > 0:
        raise InputError("", "limit", limit, "seconds above 0")
    for k, fault in enumerate(faults):
        others = {other.robot for other in faults[:k]}
        if fault.robot in others or not 0 <= fault.robot < robots:
            expected = f"a robot from 0 to {robots - 1}, once"
            raise InputError("", f"faults[{k}].robot", fault.robot, expected)


def _pose(body: IdealBody | CrewBody) -> tuple[float, float, float]:
    return body.pose


def _detours(body: CrewBody) -> int:
    return body.detours


def _agent(
    k: int, found: Exploration, air: Channel, team: list[Member], fault: Fault
) -> Agent:
    """Return a robot's mind, with its ear and mouth in the air."""

    def send(data: bytes) -> None:
        now = agent.now
        if now < fault.mute:
            air.send(k, data, now, [member.at(now) for member in team])

    agent = Agent(
        found,
        Knowledge(k, found.chart),
        send,
        lambda: air.receive(k, agent.now),
    )
    return agent
