"""How the maps of two robots that have nothing in common may lie over each other."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from merge.options import Options
from merge.pairwise import match
from topomap.chart import Chart
from topomap.merging import to_graph
from topomap.team.frames import Origin, at_one_place
from topomap.team.laying import insert

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from topomap.team.messages import MapReport

__all__ = ["LEAST", "Meeting", "Overlay", "chart_of", "meet"]

FALSE_MERGE = 1e-4
"""The greatest probability that an overlay is wrong, where a robot merges a stranger's
map: two robots try it ten times and more while their maps grow, and one wrong merge
spoils the maps of all."""
LEAST = 4
"""A map of fewer vertices is not yet compared with a stranger's."""


class Overlay(NamedTuple):
    """One way to lay another's map over one's own."""

    turn: int
    """Quarter turns from its directions to one's own."""
    pairs: list[tuple[int, int]]
    """Vertices of the other's map and of one's own that are one."""


class Meeting(NamedTuple):
    """How two maps may lie, the likeliest first."""

    overlays: Iterable[Overlay]
    reason: str
    """Why they are not merged, if none of the overlays holds."""


def meet(
    chart: Chart,
    report: MapReport,
    frame: tuple[Origin, Origin] | None,
    parameters: Parameters,
    sigma: float,
) -> Meeting:
    """Find how another's map may lie over one's own.

    Parameters
    ----------
    chart : Chart
        One's own map.
    report : MapReport
        The other's.
    frame : (Origin, Origin), optional
        Where the one and the other map lie, if they have a frame in common.
    parameters : Parameters
        Lengths both robots keep.
    sigma : float
        Standard deviation of a measured length, as a part of the length.

    Returns
    -------
    Meeting
        Without a frame one overlay, that which surely fits, or none; with one, a
        single pair of vertices each, by where they lie.
    """
    if frame is not None:
        return _in_frame(chart, report, frame, parameters, sigma)
    theirs = chart_of(report)
    if min(len(chart.places), len(theirs.places)) < LEAST:
        return Meeting((), f"a map has fewer than {LEAST} vertices")
    mine = chart.as_map(parameters, sigma)
    other = theirs.as_map(parameters, sigma)
    found = match(to_graph(mine), to_graph(other), Options(false_merge=FALSE_MERGE))
    if not found.accepted or found.transform is None:
        return Meeting((), f"it does not surely fit: {found.reason}")
    numbers = [row.number for row in report.places]
    pairs = [
        (numbers[other.vertices[b].id], mine.vertices[a].id)
        for a, b in found.pairs.tolist()
    ]
    turn = round(found.transform.angle / (math.pi / 2)) % 4
    return Meeting([Overlay(turn, pairs)], "")


def chart_of(report: MapReport) -> Chart:
    """Return the map of a report, in its sender's directions and numbers in order."""
    chart = Chart()
    insert(chart, report, 0)
    return chart


def _in_frame(
    chart: Chart,
    report: MapReport,
    frame: tuple[Origin, Origin],
    parameters: Parameters,
    sigma: float,
) -> Meeting:
    """Find vertices that lie at one place."""
    mine, other = frame
    turn = (other.quarter - mine.quarter) % 4
    name = report.sender, other.vertex
    first = next(k for k, row in enumerate(report.places) if name in row.names)
    places = mine, replace(other, vertex=first)
    near = at_one_place(chart, chart_of(report), places, parameters, sigma)
    numbers = [row.number for row in report.places]
    overlays = (Overlay(turn, [(numbers[b], a)]) for b, a in near)
    return Meeting(overlays, "no vertex of both lies at one place")
