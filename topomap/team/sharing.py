"""How another robot's map becomes part of one's own, without a common frame.

A vertex has a name, the robot that met it first and that robot's number for it.
Maps that have a name in common are laid over each other by it; maps that have none
are merged as those of strangers are, or are refused until they have grown.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from topomap.chart import Chart
from topomap.team.frames import Origin
from topomap.team.laying import grow, insert, measure_once, remove
from topomap.team.meeting import meet
from topomap.team.messages import LinkRow, MapReport, Name, PlaceRow

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from behaviours.ways import Ways

__all__ = ["Knowledge", "Verdict", "lay_over", "learn", "report_of"]


@dataclass(slots=True)
class Knowledge:
    """A robot's map, and under which names it knows its vertices."""

    robot: int
    chart: Chart
    names: dict[Name, int] = field(default_factory=dict)
    """Names that others gave, with the vertex in this chart."""
    turns: dict[int, int] = field(default_factory=dict)
    """Quarter turns from each other robot's directions to this one's."""
    origins: dict[int, Origin] = field(default_factory=dict)
    """Where each robot's map lies, if they have a frame in common."""

    def find(self, name: Name) -> int | None:
        """Return the vertex of a name, if it is known."""
        robot, number = name
        known = number if robot == self.robot else self.names.get(name)
        if known is None:
            return None
        known = self.chart.now(known)
        return known if known in self.chart.places else None


@dataclass(frozen=True, slots=True)
class Verdict:
    """What became of another robot's map."""

    accepted: bool
    reason: str
    """Why it was refused; how it was merged otherwise."""
    added: int = 0
    """Vertices that were new."""
    contradicts: bool = False
    """Whether the maps are known to overlap, and say different things there."""


def report_of(known: Knowledge, version: int) -> MapReport:
    """Return all that a robot knows, as it tells it."""
    chart = known.chart
    names: dict[int, list[Name]] = {k: [(known.robot, k)] for k in chart.places}
    for old in chart.became:
        names[chart.now(old)].append((known.robot, old))
    for name, vertex in known.names.items():
        names[chart.now(vertex)].append(name)
    return MapReport(
        known.robot,
        version,
        tuple(
            PlaceRow(
                k,
                place.type.value,
                _way_row(place.ways),
                tuple(names[k]),
            )
            for k, place in chart.places.items()
        ),
        tuple(
            LinkRow(
                *link.ends,
                link.behaviour,
                tuple(link.lengths),
                tuple(link.shifts),
                link.clearance,
            )
            for link in chart.each_link()
        ),
        dict(known.turns),
    )


def learn(
    known: Knowledge, report: MapReport, parameters: Parameters, sigma: float
) -> Verdict:
    """Make another robot's map part of one's own, if it surely fits.

    Parameters
    ----------
    known : Knowledge
        Changed, if the map is accepted.
    report : MapReport
        The other's map.
    parameters : Parameters
        Lengths both robots keep.
    sigma : float
        Standard deviation of a measured length, as a part of the length.

    Returns
    -------
    Verdict
        Refused where strangers' maps do not surely fit, or where the map contradicts
        what is known; nothing is changed then.

    Notes
    -----
    By names it takes O(V); between strangers what `merge.match` takes.
    """
    common = _turn_by_names(known, report)
    if common is None:
        frame = _frame(known, report)
        meeting = meet(known.chart, report, frame, parameters, sigma)
        verdict = Verdict(False, meeting.reason)
        for turn, pairs in meeting.overlays:
            verdict = lay_over(known, report, turn, pairs)
            if verdict.accepted:
                break
        # In a common frame it may lie elsewhere.
        return verdict if frame is None else replace(verdict, contradicts=False)
    return lay_over(known, report, common, _namesakes(known, report))


def lay_over(
    known: Knowledge, report: MapReport, turn: int, pairs: list[tuple[int, int]]
) -> Verdict:
    """Add a map, turned by quarter turns, and join vertices known to be one.

    Parameters
    ----------
    known : Knowledge
        Changed, unless the maps contradict each other.
    report : MapReport
        The other's map.
    turn : int
        Quarter turns from its directions to those of `known`.
    pairs : list of (int, int)
        Vertices of the other's map and of one's own that are one.

    Returns
    -------
    Verdict
        Refused where types, ways or edges contradict each other.
    """
    chart = known.chart
    number = insert(chart, report, turn)
    same = grow(chart, [(number[a], b) for a, b in pairs])
    if same is None:
        remove(chart, set(number.values()))
        return Verdict(False, "it contradicts what is known", contradicts=True)
    chart.join(same)
    measure_once(chart)
    for row in report.places:
        for name in row.names:
            if name[0] != known.robot:
                known.names[name] = chart.now(number[row.number])
    for vertex in number.values():
        chart.became.pop(vertex, None)  # nobody was ever told of these numbers
    known.turns[report.sender] = turn % 4
    for robot, more in report.turns.items():
        if robot != known.robot:
            known.turns[robot] = (more + turn) % 4
    return Verdict(True, "", len(number) - len(same))


def _turn_by_names(known: Knowledge, report: MapReport) -> int | None:
    """Return the turn between two maps that have a name in common; None if none."""
    if report.sender in known.turns:
        return known.turns[report.sender]
    if known.robot in report.turns:
        return -report.turns[known.robot] % 4
    for robot, turn in report.turns.items():
        if robot in known.turns:
            return (known.turns[robot] - turn) % 4
    return None


def _frame(known: Knowledge, report: MapReport) -> tuple[Origin, Origin] | None:
    """Return where both maps lie, if they have a frame in common."""
    origins = known.origins
    if known.robot in origins and report.sender in origins:
        return origins[known.robot], origins[report.sender]
    return None


def _namesakes(known: Knowledge, report: MapReport) -> list[tuple[int, int]]:
    """Return which vertices of the other's map are which of one's own, by name.

    Where the other knows that two vertices are one, they are joined here too.
    """
    chart = known.chart
    pairs = []
    for row in report.places:
        here = dict.fromkeys(v for v in map(known.find, row.names) if v is not None)
        for vertex in here:
            first, other = chart.now(next(iter(here))), chart.now(vertex)
            same = None if other == first else chart.pairs(other, first)
            if same is not None:
                chart.join(same)
        pairs += [(row.number, vertex) for vertex in here]
    return [(a, chart.now(b)) for a, b in pairs]


def _way_row(ways: Ways) -> tuple[str, str, str, str]:
    a, b, c, d = ("" if way is None else way.name for way in ways)
    return a, b, c, d
