"""How a recording is written into a page: few bytes, quickly read."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from behaviours.vertices import VertexType
from topomap.page.map_encoding import encode_states
from topomap.page.numbers import differences, hundredths, thousandths

if TYPE_CHECKING:
    from topomap.page.recording import Recording
    from topomap.page.tracks import (
        BeliefTrack,
        MapTrack,
        RobotTrack,
    )

__all__ = ["VERSION", "encode"]

VERSION = 1
UNSEEN = -1
"""Stands for a range at which nothing was seen."""


def encode(run: Recording) -> dict[str, Any]:
    """Return a recording as plain lists, texts and whole numbers.

    Parameters
    ----------
    run : Recording
        Any.

    Returns
    -------
    dict
        For JSON. Lengths are millimetres, times thousandths, angles hundredths of a
        degree, ranges centimetres, probabilities thousandths. Times and poses are
        differences from the value before.
    """
    return {
        "version": VERSION,
        "title": run.title,
        "unit": run.unit,
        "end": thousandths(run.end),
        "facts": [list(fact) for fact in run.facts],
        "walls": [[thousandths(value) for value in sum(r, ())] for r in run.walls],
        "types": [type_.value for type_ in VertexType],
        "robots": [_robot(robot) for robot in run.robots],
        "maps": [_map(chart) for chart in run.maps],
        "hypotheses": [_belief(track) for track in run.hypotheses],
        "matches": [
            [
                thousandths(match.time),
                *(match.map_a, match.vertex_a, match.map_b, match.vertex_b),
                *(match.group, match.note),
            ]
            for match in run.matches
        ],
        "assignments": [
            [
                thousandths(sent.time),
                sent.robot,
                None if sent.target is None else [*map(thousandths, sent.target)],
                sent.reason,
            ]
            for sent in run.assignments
        ],
        "messages": [
            [thousandths(said.time), said.text, said.sender, said.receiver, said.lost]
            for said in run.messages
        ],
    }


def _robot(robot: RobotTrack) -> dict[str, Any]:
    x, y, heading = robot.poses.T
    return {
        "name": robot.name,
        "radius": thousandths(robot.radius),
        "t": differences(robot.times, 1000),
        "x": differences(x, 1000),
        "y": differences(y, 1000),
        "h": differences(np.degrees(np.unwrap(heading)), 100),
        "rangers": [
            [thousandths(ahead), thousandths(aside), hundredths(math.degrees(yaw))]
            for ahead, aside, yaw in robot.rangers.tolist()
        ],
        "ranges": None if robot.ranges is None else _ranges(robot.ranges),
    }


def _ranges(ranges: Any) -> list[list[int]]:
    """Return the ranges of each ranger over time, in centimetres."""
    seen = np.isfinite(ranges)
    whole = np.where(seen, np.rint(np.where(seen, ranges, 0.0) * 100), UNSEEN)
    columns: list[list[int]] = whole.astype(np.int64).T.tolist()
    return columns


def _map(chart: MapTrack) -> dict[str, Any]:
    return {
        "name": chart.name,
        "until": thousandths(chart.until) if math.isfinite(chart.until) else None,
        "states": encode_states(chart.states),
    }


def _belief(track: BeliefTrack) -> dict[str, Any]:
    return {
        "name": track.name,
        "t": differences(track.times, 1000),
        "belief": np.rint(track.belief * 1000).astype(int).tolist(),
        "plausibility": np.rint(track.plausibility * 1000).astype(int).tolist(),
        "accepted": track.accepted.astype(int).tolist(),
    }
