"""What one robot of a team knows, hears, tells and decides."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from topomap.explored import Clue, Exploration
from topomap.headings import quarter_of
from topomap.team.changes import Changes
from topomap.team.choosing import Choice, Costs, Mate, choose
from topomap.team.disputes import Disputes, accusation
from topomap.team.frames import Origin
from topomap.team.frontiers import way_lengths
from topomap.team.hearsay import Hearsay
from topomap.team.messages import MOST, Beacon, decode, encode
from topomap.team.sharing import Knowledge, learn, report_of
from topomap.team.tasks import Event

__all__ = ["BEAT", "Agent"]

BEAT = 5.0
"""Seconds between two beacons of a robot."""
PATIENCE = 120.0
"""Seconds after which a robot that is not heard any more is not counted on."""
GROWTH = 3
"""Vertices that two strangers' maps must grow by until they are compared again."""


@dataclass(slots=True)
class Agent:
    """A robot's mind. Time and messages are given to it from outside."""

    found: Exploration
    known: Knowledge
    send: Callable[[bytes], None]
    receive: Callable[[], list[bytes]]
    beset: Callable[[], float | None] = lambda: None
    """Bearing of a robot that waits for this one to go away, in radians."""
    gave_way: Callable[[], int] = lambda: 0
    """How often it has given way to others so far."""
    locate: Callable[[], tuple[float, float, float]] | None = None
    """Where it is in a frame that all have: metres, and radians; None without one."""
    allocator: str = "minpos"
    costs: Costs = way_lengths
    returns: bool = False
    """Whether it goes back to its first vertex when nothing is open."""
    now: float = 0.0
    """Its clock, in seconds."""
    is_done: bool = False
    """Whether it knows of nothing that is open, and is where it wants to be."""
    done_at: float = 0.0
    began: float = 0.0
    """When it began its map, in seconds."""
    made_way: float = -math.inf
    """When it last went out of another's way."""
    events: list[Event] = field(default_factory=list)
    report: bytes = b""
    """Its newest map, as it tells it."""
    _target: tuple[int, int] | None = None
    _is_venturing: bool = False
    _version: int = 0
    _state: tuple[int, int, int] = (0, 0, 0)
    _beacons: int = 0
    _next_beacon: float = 0.0
    _next_map: float = 0.0
    _heard: Hearsay = field(default_factory=Hearsay)
    _changes: Changes = field(default_factory=Changes)
    _learned: dict[int, int] = field(default_factory=dict)
    _refused: dict[int, int] = field(default_factory=dict)
    """Vertices of both maps when they were last refused."""
    _undisturbed: int = 0
    """How often it had given way when it began its map."""
    _disputes: Disputes = field(default_factory=Disputes)

    @property
    def robot(self) -> int:
        """Its number."""
        return self.known.robot % MOST

    def hear(self) -> None:
        """Take in what has arrived; the newest of each kind and robot counts."""
        for data in self.receive():
            message = decode(data)
            self._heard.take(message, self.now)
            if isinstance(message, Beacon):
                self._disputes.accuse(*message.accuses)

    def tell(self) -> None:
        """Send a beacon when it is time, and the map to those who lack it."""
        if self.now >= self._next_beacon:
            self._next_beacon = self.now + BEAT
            self._beacons += 1
            beacon = Beacon(
                sender=self.known.robot,
                count=self._beacons,
                version=self._version,
                here=self.found.here,
                target=self._target,
                is_venturing=self._is_venturing,
                heard={k: report.version for k, report in self._heard.maps.items()},
                accuses=self._disputes.told_by(self.robot),
            )
            self.send(encode(beacon))
        base = self._least_heard()
        if self._version and self.now >= self._next_map and base < self._version:
            self._next_map = self.now + BEAT
            whole = self.report
            change = encode(self._changes.since(base)) if base else whole
            self.send(min(change, whole, key=len))

    def learn(self) -> None:
        """Merge what others have told; what is refused is tried again when it grew."""
        for sender, report in sorted(self._heard.maps.items()):
            size = len(self.known.chart.places) + len(report.places)
            is_old = report.version == self._learned.get(sender)
            is_refused = size < self._refused.get(sender, -GROWTH) + GROWTH
            if is_old or (is_refused and not self._disputes.is_open(sender)):
                continue
            verdict = learn(self.known, report, self.found.parameters, self.found.sigma)
            self.found.here = self.known.chart.now(self.found.here)
            self._disputes.judge(sender, verdict, self.now)
            if verdict.accepted:
                is_first = sender not in self._learned
                self._learned[sender] = report.version
                self._refused.pop(sender, None)
                if is_first:
                    reason = f"robot {sender}: {verdict.added} new vertices"
                    self.note("merges", reason, other=sender)
            else:
                if self._refused.get(sender) != size:
                    reason = f"robot {sender}: {verdict.reason}"
                    self.note("refuses", reason, other=sender)
                self._refused[sender] = size
        self._renew_report()

    def objection(self, *, is_finished: bool) -> str | None:
        """Return why this robot's map had better be made once more, if so."""
        known, disputes = self.known, self._disputes
        found = disputes.objection(known, self._heard.maps, self._learned, self.now)
        if found is None and is_finished and not self._learned:
            was_disturbed = self.gave_way() > self._undisturbed
            maps = self._heard.maps
            found = disputes.doubt(known.chart, maps, was_disturbed=was_disturbed)
        return found

    def settle(self) -> None:
        """Let all know where the map lies, if there is a frame for that."""
        if self.locate is not None:
            x, y, heading = self.locate()
            turn = quarter_of(heading) - self.found.heading
            origin = Origin(self.found.here, x, y, turn % 4)
            self.known.origins[self.known.robot] = origin

    def choose(self) -> Choice:
        """Decide where to go next."""
        chart = self.known.chart
        mates = {}
        for k, beacon in self._heard.lately(self.now, PATIENCE):
            place = self.known.find((k, beacon.here))
            if place is not None and k in self.known.turns:
                target = self._claim(k, beacon)
                mates[k] = Mate(place, target, beacon.is_venturing)
        return choose(
            *(chart, self.known.robot, self.found.here, mates),
            *(self.allocator, self.costs),
        )

    def note(
        self,
        kind: str,
        reason: str,
        target: tuple[int, int] | None = None,
        other: int | None = None,
    ) -> None:
        """Write into the history."""
        self.events.append(Event(self.now, self.robot, kind, reason, target, other))

    def aim(self, target: tuple[int, int] | None, *, ventures: bool = False) -> None:
        """Settle on a target, and let the others know at once if it is a new one."""
        if (target, ventures) != (self._target, self._is_venturing):
            self._next_beacon = self.now
        self._target, self._is_venturing = target, ventures

    def begin_anew(self, reason: str, clue: Clue | None = None) -> None:
        """Drop the map, and go on as a robot that has just been set down.

        Under another name: what others have learned of its old map stays theirs. Where
        an edge was wrong they are told.
        """
        self.note("begins anew", reason)
        if clue is not None:
            self._disputes.accuse(accusation(self.known.robot, clue))
        self.is_done, self.began = False, self.now
        self._undisturbed = self.gave_way()
        found, known = self.found, self.known
        found.clear()
        known.robot += MOST
        known.names.clear()
        known.turns.clear()
        self._learned.clear()
        self._refused.clear()
        self._disputes.contradicted.clear()
        self._version, self._state, self.report = 0, (0, 0, 0), b""
        self._changes = Changes()
        self.aim(None)

    def _claim(self, robot: int, beacon: Beacon) -> tuple[int, int] | None:
        """Return another's target in one's own vertices and directions."""
        if beacon.target is None:
            return None
        vertex = self.known.find((robot, beacon.target[0]))
        if vertex is None:
            return None
        return vertex, (beacon.target[1] + self.known.turns[robot]) % 4

    def _least_heard(self) -> int:
        """Return the oldest version of the map that a robot heard just now has."""
        heard = (
            beacon.heard.get(self.known.robot, 0)
            for _, beacon in self._heard.lately(self.now, 2 * BEAT)
        )
        return min(heard, default=self._version)

    def _renew_report(self) -> None:
        chart = self.known.chart
        open_ = sum(1 for _ in chart.unexplored())
        state = len(chart.places), len(chart.links), open_
        if state != self._state:
            self._state = state
            self._version += 1
            report = report_of(self.known, self._version)
            self._changes.record(report)
            self.report = encode(report)
            self._next_map = self.now
