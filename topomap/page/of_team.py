"""A team's run as a recording: who went where and why, and the maps in the end."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from merge.rigid import RigidTransform
from topomap.page.recording import Recording
from topomap.page.tracks import Assignment, MapState, MapTrack, Message, RobotTrack

if TYPE_CHECKING:
    from topomap.comparison import Comparison
    from topomap.team.result import RobotRun, TeamRun
    from topomap.team.tasks import Event
    from worlds.world import World

__all__ = ["recording_of_team"]


def recording_of_team(run: TeamRun, world: World) -> Recording:
    """Return a recording of a team's run, in the frame of its world.

    Parameters
    ----------
    run : TeamRun
        What `topomap.explore` returned.
    world : World
        In which it was run.

    Returns
    -------
    Recording
        Robots on their ways; an arrow to the place each has chosen, with the reason;
        what happened, as messages; and each merged map when the last robot is done,
        where it lies best over the truth.
    """
    events = sorted(run.events, key=lambda event: event.time)
    facts = (
        ("robots", str(len(run.robots))),
        ("done after", f"{run.simulated:.0f} s"),
        ("maps", str(len(run.merged))),
        ("correct", "yes" if run.correct else "no"),
        ("messages", f"{run.traffic.messages}, {run.traffic.bytes / 1000:.0f} kB"),
    )
    return Recording(
        title=f"{len(run.robots)} robots in {world.name or 'a world'}",
        facts=facts,
        walls=world.rings,
        robots=tuple(_track(k, robot) for k, robot in enumerate(run.robots)),
        maps=tuple(
            MapTrack(
                "map of robots " + ", ".join(map(str, merged.robots)),
                (MapState(run.simulated, merged.map, _placement(merged.comparison)),),
            )
            for merged in run.merged
        ),
        assignments=tuple(
            Assignment(event.time, event.robot, _goal(run, event), event.reason)
            for event in events
            if event.kind == "goes"
        ),
        messages=tuple(
            Message(event.time, f"{event.kind}: {event.reason}", sender=event.robot)
            for event in events
            if event.kind != "goes"
        ),
    )


def _track(number: int, robot: RobotRun) -> RobotTrack:
    """Return a robot's way; where it stood at one time twice, the later place."""
    places = {time: (x, y) for time, x, y in robot.trail}
    times = np.array(sorted(places))
    xy = np.array([places[time] for time in times.tolist()])
    steps = np.diff(xy, axis=0, append=xy[-1:])
    headings = np.zeros(len(times))
    heading = robot.start.heading
    for k, (dx, dy) in enumerate(steps.tolist()):
        if dx or dy:
            heading = math.atan2(dy, dx)
        headings[k] = heading
    return RobotTrack(f"robot {number}", times, np.column_stack([xy, headings]))


def _placement(found: Comparison) -> RigidTransform:
    """Return how a map lies best over the truth; as it is where nothing agrees."""
    if found.rotation is None or found.offset is None:
        return RigidTransform()
    return RigidTransform(found.rotation, *found.offset)


def _goal(run: TeamRun, event: Event) -> tuple[float, float] | None:
    """Return where a robot wanted to go, if its map of the end still has the place."""
    if event.target is None:
        return None
    robot = run.robots[event.robot]
    for vertex in robot.map.vertices:
        if vertex.id == event.target[0] and vertex.position is not None:
            x, y = _placement(robot.comparison)([vertex.position])[0].tolist()
            return x, y
    return None
