"""How a map is put beside another in one chart, and joined where both are one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from behaviours.vertices import VertexType
from behaviours.ways import Way, Ways, turned
from topomap.chart import Chart, Place

if TYPE_CHECKING:
    from topomap.team.messages import MapReport

__all__ = ["grow", "insert", "measure_once", "remove"]


def insert(chart: Chart, report: MapReport, turn: int) -> dict[int, int]:
    """Add a map beside what is there; return the new number of each vertex."""
    number = {
        row.number: chart.add_place(
            Place(VertexType(row.type), turned(_ways(row.ways), -turn))
        )
        for row in report.places
    }
    for row in report.links:
        link = chart.add_link(
            (number[row.source[0]], (row.source[1] + turn) % 4),
            (number[row.target[0]], (row.target[1] + turn) % 4),
            row.behaviour,
        )
        link.lengths += row.lengths
        link.shifts += row.shifts
        link.clearance = row.clearance
    return number


def remove(chart: Chart, vertices: set[int]) -> None:
    """Take out vertices that nothing else is linked to."""
    for vertex in vertices:
        del chart.places[vertex]
    for end in [end for end in chart.links if end[0] in vertices]:
        del chart.links[end]


def grow(chart: Chart, pairs: list[tuple[int, int]]) -> dict[int, int] | None:
    """Return what is the same if these pairs are; None where that contradicts.

    As `Chart.pairs`, from many pairs at once. Two vertices of the other's map may be
    one of one's own, where that is known by name, but none that is found on the way.
    """
    found: dict[int, int] = {}
    for a, b in pairs:
        if found.setdefault(a, b) != b:
            return None
    todo = list(found)
    taken = set(found.values())
    while todo:
        a = todo.pop()
        b = found[a]
        if chart.places[a] != chart.places[b]:
            return None
        for quarters in range(4):
            first, second = (a, quarters), (b, quarters)
            if first not in chart.links or second not in chart.links:
                continue
            c, back = chart.links[first].beyond(first)
            d, back_too = chart.links[second].beyond(second)
            if back != back_too or found.get(c, d) != d:
                return None
            if c not in found:
                if d in taken:
                    return None
                found[c] = d
                taken.add(d)
                todo.append(c)
    return found


def measure_once(chart: Chart) -> None:
    """Keep each measurement once, however many robots told of it."""
    for link in chart.each_link():
        once = dict.fromkeys(zip(link.lengths, link.shifts, strict=True))
        if len(once) < len(link.lengths):
            link.lengths = [length for length, _ in once]
            link.shifts = [shift for _, shift in once]


def _ways(row: tuple[str, str, str, str]) -> Ways:
    a, b, c, d = (Way[name] if name else None for name in row)
    return a, b, c, d
