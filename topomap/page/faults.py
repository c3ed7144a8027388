"""What is wrong with a recording: the field, the value, and what was expected."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from topomap.page.tracks import (
        Assignment,
        BeliefTrack,
        MapTrack,
        Message,
        RobotTrack,
        VertexMatch,
    )
    from worlds.world import Ring

__all__ = ["Fault", "faults"]

Fault: TypeAlias = tuple[str, object, str]


def faults(
    walls: tuple[Ring, ...],
    robots: tuple[RobotTrack, ...],
    maps: tuple[MapTrack, ...],
    hypotheses: tuple[BeliefTrack, ...],
    matches: tuple[VertexMatch, ...],
    assignments: tuple[Assignment, ...],
    messages: tuple[Message, ...],
) -> Iterator[Fault]:
    """Yield field, value and what was expected instead, for each fault of a recording.

    What is asked for is what `topomap.page.recording.Recording` is made of.
    """
    for k, ring in enumerate(walls):
        if len(ring) < 3 or not np.isfinite(np.asarray(ring, dtype=float)).all():
            yield f"walls[{k}]", len(ring), "at least 3 corners of finite metres"
    for k, robot in enumerate(robots):
        yield from _of_robot(f"robots[{k}]", robot)
    for k, chart in enumerate(maps):
        yield from _of_map(f"maps[{k}]", chart)
    for k, hypothesis in enumerate(hypotheses):
        yield from _of_belief(f"hypotheses[{k}]", hypothesis)
    yield from _of_matches(maps, matches)
    yield from _of_times("assignments", [sent.time for sent in assignments])
    for k, sent in enumerate(assignments):
        yield from _of_index(f"assignments[{k}].robot", sent.robot, robots, "robot")
        if sent.target is not None and not all(map(math.isfinite, sent.target)):
            yield f"assignments[{k}].target", sent.target, "finite metres"
    yield from _of_times("messages", [said.time for said in messages])
    for k, said in enumerate(messages):
        for end in ("sender", "receiver"):
            robot_k = getattr(said, end)
            if robot_k is not None:
                yield from _of_index(f"messages[{k}].{end}", robot_k, robots, "robot")


def _of_robot(field: str, robot: RobotTrack) -> Iterator[Fault]:
    yield from _of_series(field, robot.times)
    count, rangers = len(robot.times), len(robot.rangers)
    yield from _of_shape(f"{field}.poses", robot.poses, (count, 3))
    yield from _of_shape(f"{field}.rangers", robot.rangers, (rangers, 3))
    if robot.ranges is None:
        return
    if robot.ranges.shape != (count, rangers):
        expected = f"shape {(count, rangers)}"
        yield f"{field}.ranges", robot.ranges.shape, expected
    elif not (robot.ranges >= 0).all():
        yield f"{field}.ranges", None, "ranges of 0 and more, or infinity"


def _of_map(field: str, chart: MapTrack) -> Iterator[Fault]:
    if not chart.states:
        yield f"{field}.states", 0, "at least one"
    yield from _of_times(f"{field}.states", [state.time for state in chart.states])
    if math.isnan(chart.until):
        yield f"{field}.until", chart.until, "a time, or infinity"
    for k, state in enumerate(chart.states):
        move = state.placement
        if not all(map(math.isfinite, (move.angle, move.x, move.y))):
            yield f"{field}.states[{k}].placement", move, "finite numbers"
        if not 0 <= state.glide < math.inf:
            yield f"{field}.states[{k}].glide", state.glide, "a time, not negative"


def _of_belief(field: str, track: BeliefTrack) -> Iterator[Fault]:
    yield from _of_series(field, track.times)
    shape = (len(track.times),)
    for name in ("belief", "plausibility"):
        values = getattr(track, name)
        yield from _of_shape(f"{field}.{name}", values, shape)
        if values.shape == shape and not ((values >= 0) & (values <= 1)).all():
            yield f"{field}.{name}", None, "probabilities from 0 to 1"
    if track.accepted.shape != shape:
        yield f"{field}.accepted", track.accepted.shape, f"shape {shape}"


def _of_matches(
    maps: tuple[MapTrack, ...], matches: tuple[VertexMatch, ...]
) -> Iterator[Fault]:
    known = [
        {vertex.id for state in chart.states for vertex in state.map.vertices}
        for chart in maps
    ]
    for k, match in enumerate(matches):
        if not math.isfinite(match.time):
            yield f"matches[{k}].time", match.time, "a finite time"
        for end in ("a", "b"):
            chart, vertex = (
                getattr(match, f"map_{end}"),
                getattr(match, f"vertex_{end}"),
            )
            wrong = list(_of_index(f"matches[{k}].map_{end}", chart, maps, "map"))
            yield from wrong
            if not wrong and vertex not in known[chart]:
                yield f"matches[{k}].vertex_{end}", vertex, f"a vertex of map {chart}"


def _of_index(
    field: str, index: int, among: tuple[object, ...], what: str
) -> Iterator[Fault]:
    if not 0 <= index < len(among):
        yield field, index, f"the number of a {what}, below {len(among)}"


def _of_series(field: str, times: Any) -> Iterator[Fault]:
    if times.ndim != 1 or not len(times):
        yield f"{field}.times", times.shape, "at least one time"
    else:
        yield from _of_times(f"{field}.times", times.tolist())


def _of_times(field: str, times: Iterable[float]) -> Iterator[Fault]:
    last = -math.inf
    for k, time in enumerate(times):
        if not math.isfinite(time):
            yield f"{field}[{k}]", time, "a finite time"
        elif time < last:
            yield f"{field}[{k}]", time, f"a time not before {last:g}"
        last = time


def _of_shape(field: str, values: Any, shape: tuple[int, ...]) -> Iterator[Fault]:
    if values.shape != shape:
        yield field, values.shape, f"shape {shape}"
    elif not np.isfinite(values).all():
        yield field, None, "finite numbers only"
