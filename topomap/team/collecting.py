"""What robots bring home: each its own map, and one of all."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from topomap.comparison import compare_maps
from topomap.embedding import embedded
from topomap.team.result import MergedMap, RobotRun
from topomap.team.sharing import Knowledge, learn, report_of
from topomap.topological_map import TopologicalMap

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from topomap.team.scheduling import Member
    from worlds.pose import Pose

__all__ = ["merge_all", "robot_run"]


def robot_run(
    member: Member, start: Pose, truth: tuple[TopologicalMap, ...]
) -> RobotRun:
    """Return what one robot found."""
    agent = member.agent
    found = agent.found
    chart = TopologicalMap((), (), found.parameters)
    if found.chart.places:
        chart = embedded(found.chart.as_map(found.parameters, found.sigma))
    return RobotRun(
        map=chart,
        comparison=compare_maps(chart, *truth),
        start=start,
        travelled=member.body.travelled,
        walls=found.walls,
        is_done=agent.is_done,
        lost=member.lost,
        knows=tuple(sorted(agent.known.turns)),
        told=len(agent.report),
        trail=tuple(member.trail),
        collisions=member.body.collisions,
    )


def merge_all(
    team: Sequence[Member],
    parameters: Parameters,
    sigma: float,
    truth: tuple[TopologicalMap, ...],
) -> tuple[MergedMap, ...]:
    """Merge what the robots bring home; those out there are lost with their maps."""
    groups: list[tuple[Knowledge, list[int]]] = []
    for member in team:
        if member.is_out or not member.agent.found.chart.places:
            continue
        report = report_of(member.agent.known, 1)
        for known, robots in groups:
            if learn(known, report, parameters, sigma).accepted:
                robots.append(report.sender)
                break
        else:
            groups.append((member.agent.known, [report.sender]))
    found = []
    for known, robots in groups:
        chart = embedded(known.chart.as_map(parameters, sigma))
        found.append(MergedMap(tuple(robots), chart, compare_maps(chart, *truth)))
    return tuple(sorted(found, key=lambda one: -len(one.map.vertices)))
