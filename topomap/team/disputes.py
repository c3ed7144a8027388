"""When a robot gives up its own map because the maps of others speak against it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from itertools import combinations
from typing import TYPE_CHECKING

from topomap.team.meeting import LEAST, chart_of
from topomap.team.messages import MOST, Accusation

if TYPE_CHECKING:
    from topomap.chart import Chart
    from topomap.explored import Clue
    from topomap.team.messages import MapReport
    from topomap.team.sharing import Knowledge, Verdict

__all__ = ["Disputes", "Stand", "accusation", "is_outvoted", "twice_accused"]

LONGEST = 30.0
"""Seconds for which maps contradict each other until a robot gives up its own."""
TOLD = 4
"""So many of a robot's latest accusations go with each of its beacons."""
LIKE = 0.5
"""One of two maps of the same place has at least so many vertices, in parts of the
other's."""
SAME = 0.5
"""Two robots have found the same thing if their ways differ by less, in metres."""


class Stand(Enum):
    """How another robot's newest map stands to one's own."""

    AGREES = "agrees"
    """It is part of it."""
    CONTRADICTS = "contradicts"
    """Both hold that they have met the same place, and say different things of it."""


def is_outvoted(robot: int, stands: Mapping[int, Stand]) -> bool:
    """Return whether more robots contradict a robot's map than agree with it.

    Parameters
    ----------
    robot : int
        Its number.
    stands : mapping of int to Stand
        Of every other robot, by number, as far as it is known.

    Returns
    -------
    bool
        Of two camps that are equally large, the one without the lowest number is
        outvoted.

    Notes
    -----
    If two maps contradict each other one of them is wrong, and neither robot can tell
    which from where it stands. A mistake that was made once is held by the one who made
    it and those who merged it since, so most robots are right more often than not; and
    where they are not, who walks there finds out.

    Examples
    --------
    Of four robots two agree with this one; then two contradict it:

    >>> yes, no = Stand.AGREES, Stand.CONTRADICTS
    >>> is_outvoted(3, {0: yes, 1: no, 2: yes})
    False
    >>> is_outvoted(3, {0: yes, 1: no, 2: no}), is_outvoted(3, {0: no, 1: yes, 2: no})
    (False, True)
    """
    ours = {robot} | {k for k, stand in stands.items() if stand is Stand.AGREES}
    theirs = {k for k, stand in stands.items() if stand is Stand.CONTRADICTS}
    if not theirs:
        return False
    return (len(theirs), -min(theirs)) > (len(ours), -min(ours))


def twice_accused(
    known: Knowledge, accusations: Iterable[Accusation]
) -> tuple[int, int] | None:
    """Return an edge of a map at whose end two robots have found the same other thing.

    Parameters
    ----------
    known : Knowledge
        The map.
    accusations : iterable of Accusation
        Of all robots, each life of which counts for itself.

    Returns
    -------
    (int, int) or None
        The vertices that the edge joins.

    Notes
    -----
    One robot that finds something else than its map says may be lost itself, above all
    where others stand in its sight; two that find the same are not.
    """
    linked = {(link.ends[0][0], link.ends[1][0]) for link in known.chart.each_link()}
    linked |= {(b, a) for a, b in linked}
    found = []
    for accusation in accusations:
        a, b = known.find(accusation.source), known.find(accusation.target)
        if a is not None and b is not None and (a, b) in linked:
            found.append(((a, b), accusation))
    for (edge, one), (other_edge, other) in combinations(found, 2):
        is_same = edge == other_edge and one.type == other.type
        if (
            is_same
            and one.source[0] != other.source[0]
            and abs(one.length - other.length) < SAME
        ):
            return edge
    return None


@dataclass(slots=True)
class Disputes:
    """What speaks against a robot's map: others' maps, and what robots have found."""

    contradicted: dict[int, float] = field(default_factory=dict)
    """Since when each robot's map has contradicted this one's, in seconds."""
    accused: dict[Accusation, None] = field(default_factory=dict)
    """Edges that any robot has found to be wrong, in the order of hearing."""
    finished: set[tuple[int, int]] = field(default_factory=set)
    """Vertices and edges of the maps that this robot has finished and doubted."""

    def judge(self, sender: int, verdict: Verdict, now: float) -> None:
        """Note what became of another robot's map."""
        if verdict.contradicts:
            self.contradicted.setdefault(sender, now)
        else:
            self.contradicted.pop(sender, None)

    def is_open(self, sender: int) -> bool:
        """Return whether another robot's map has contradicted this one's so far."""
        return sender in self.contradicted

    def accuse(self, *accusations: Accusation) -> None:
        """Note what robots have found to be wrong."""
        self.accused.update(dict.fromkeys(accusations))

    def told_by(self, robot: int) -> tuple[Accusation, ...]:
        """Return a robot's latest accusations, of all the maps that it has dropped."""
        own = [one for one in self.accused if one.source[0] % MOST == robot]
        return tuple(own[-TOLD:])

    def objection(
        self,
        known: Knowledge,
        reports: Mapping[int, MapReport],
        learned: Mapping[int, int],
        now: float,
    ) -> str | None:
        """Return why a robot's map is rather wrong than those of others, if so.

        Parameters
        ----------
        known : Knowledge
            Its map.
        reports : mapping of int to MapReport
            The newest of each robot.
        learned : mapping of int to int
            The version of each robot's map that is part of its own.
        now : float
            In seconds.
        """
        edge = twice_accused(known, self.accused)
        if edge is not None:
            return f"two robots found the edge from vertex {edge[0]} to {edge[1]} wrong"
        stands = {}
        for sender in reports:
            since = self.contradicted.get(sender, math.inf)
            if now - since > LONGEST:
                stands[sender % MOST] = Stand.CONTRADICTS
            elif sender in learned and since == math.inf:
                stands[sender % MOST] = Stand.AGREES
        if not is_outvoted(known.robot % MOST, stands):
            return None
        against = sorted(k for k in stands if stands[k] is Stand.CONTRADICTS)
        return f"the maps of robots {', '.join(map(str, against))} contradict it"

    def doubt(
        self, chart: Chart, reports: Mapping[int, MapReport], *, was_disturbed: bool
    ) -> str | None:
        """Return why a finished map that fits nobody's is doubted, if it is.

        Where another robot has finished one, of a size that may be the same place's, or
        of any size where the robot has given way since it began its own. Once,
        unless it comes out differently the next time.
        """
        size = len(chart.places), len(chart.links)
        if size in self.finished:
            return None
        for sender, report in reports.items():
            theirs = chart_of(report)
            less, more = sorted((len(chart.places), len(theirs.places)))
            is_like = was_disturbed or less >= LIKE * more
            is_finished = len(theirs.places) >= LEAST and not any(theirs.unexplored())
            if is_like and is_finished:
                self.finished.add(size)
                return f"it is finished, as is that of robot {sender}, and they differ"
        return None


def accusation(robot: int, clue: Clue) -> Accusation:
    """Return what a robot tells others of an edge that it has found to be wrong."""
    source, target = (robot, clue.source), (robot, clue.target)
    return Accusation(source, target, clue.type, round(clue.length, 3))
