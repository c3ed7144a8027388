"""What one robot of a team does: explore, tell, listen, merge, choose."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from behaviours.automaton import UnforeseenError
from topomap.errors import JobError
from topomap.explored import Exploration, RefutedError
from topomap.exploring import first_vertex, venture
from topomap.headings import angle_of
from topomap.team.choosing import Choice, Costs, Mate, choose
from topomap.team.frontiers import way_lengths
from topomap.team.messages import Beacon, MapReport, decode, encode
from topomap.team.sharing import Knowledge, learn, report_of
from topomap.team.tasks import Event, Task, Wait
from topomap.walking import go

if TYPE_CHECKING:
    from behaviours.port import Behaviour, Outcome

__all__ = ["Agent", "explore_with_others"]

BEAT = 5.0
"""Seconds between two beacons of a robot."""
PATIENCE = 120.0
"""Seconds after which a robot that is not heard any more is not counted on."""
LONGEST_WAIT = 60.0
"""Seconds after which a robot goes where another should have gone."""
MOST = 64
"""Robots of a team; a map begun anew has its robot's number and so many more."""
LIVES = 20
"""How often a robot begins anew until it is given up."""
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
    allocator: str = "minpos"
    costs: Costs = way_lengths
    returns: bool = False
    """Whether it goes back to its first vertex when nothing is open."""
    now: float = 0.0
    """Its clock, in seconds."""
    is_done: bool = False
    """Whether it knows of nothing that is open, and is where it wants to be."""
    done_at: float = 0.0
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
    _peers: dict[int, tuple[Beacon, float]] = field(default_factory=dict)
    _reports: dict[int, MapReport] = field(default_factory=dict)
    _learned: dict[int, int] = field(default_factory=dict)
    _refused: dict[int, int] = field(default_factory=dict)
    """Vertices of both maps when they were last refused."""

    @property
    def robot(self) -> int:
        """Its number."""
        return self.known.robot % MOST

    def hear(self) -> None:
        """Take in what has arrived; the newest of each kind and robot counts."""
        for data in self.receive():
            message = decode(data)
            if isinstance(message, MapReport):
                last = self._reports.get(message.sender)
                if last is None or message.version > last.version:
                    self._reports[message.sender] = message
            else:
                peer = self._peers.get(message.sender)
                if peer is None or message.count > peer[0].count:
                    self._peers[message.sender] = message, self.now

    def tell(self) -> None:
        """Send a beacon when it is time, and the map to those who lack it."""
        if self.now >= self._next_beacon:
            self._next_beacon = self.now + BEAT
            self._beacons += 1
            heard = {k: report.version for k, report in self._reports.items()}
            self.send(
                encode(
                    Beacon(
                        *(
                            self.known.robot,
                            self._beacons,
                            self._version,
                            self.found.here,
                        ),
                        *(self._target, self._is_venturing, heard),
                    )
                )
            )
        if self._version and self.now >= self._next_map and self._is_missed():
            self._next_map = self.now + BEAT
            self.send(self.report)

    def learn(self) -> None:
        """Merge what others have told; what is refused is tried again when it grew."""
        for sender in sorted(self._reports):
            report = self._reports[sender]
            size = len(self.known.chart.places) + len(report.places)
            is_old = report.version == self._learned.get(sender)
            if is_old or size < self._refused.get(sender, -GROWTH) + GROWTH:
                continue
            verdict = learn(self.known, report, self.found.parameters, self.found.sigma)
            self.found.here = self.known.chart.now(self.found.here)
            if verdict.accepted:
                is_first = sender not in self._learned
                self._learned[sender] = report.version
                self._refused.pop(sender, None)
                if is_first:
                    reason = f"robot {sender}: {verdict.added} new vertices"
                    self.note("merges", reason, other=sender)
            else:
                self._refused[sender] = size
                self.note("refuses", f"robot {sender}: {verdict.reason}", other=sender)
        self._renew_report()

    def choose(self) -> Choice:
        """Decide where to go next."""
        chart = self.known.chart
        mates = {}
        for k, (beacon, heard_at) in self._peers.items():
            place = self.known.find((k, beacon.here))
            if place is None or k not in self.known.turns:
                continue
            if self.now - heard_at <= PATIENCE:
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

    def begin_anew(self, reason: str) -> None:
        """Drop the map, and go on as a robot that has just been set down.

        Under another name: what others have learned of its old map stays theirs.
        """
        self.note("begins anew", reason)
        found, known = self.found, self.known
        found.clear()
        known.robot += MOST
        known.names.clear()
        known.turns.clear()
        self._learned.clear()
        self._refused.clear()
        self._version, self._state, self.report = 0, (0, 0, 0), b""
        self.aim(None)

    def _claim(self, robot: int, beacon: Beacon) -> tuple[int, int] | None:
        """Return another's target in one's own vertices and directions."""
        if beacon.target is None:
            return None
        vertex = self.known.find((robot, beacon.target[0]))
        if vertex is None:
            return None
        return vertex, (beacon.target[1] + self.known.turns[robot]) % 4

    def _is_missed(self) -> bool:
        """Return whether some robot heard just now lacks the newest map."""
        return any(
            beacon.heard.get(self.known.robot, 0) < self._version
            for beacon, heard_at in self._peers.values()
            if self.now - heard_at <= 2 * BEAT
        )

    def _renew_report(self) -> None:
        chart = self.known.chart
        open_ = sum(1 for _ in chart.unexplored())
        state = len(chart.places), len(chart.links), open_
        if state != self._state:
            self._state = state
            self._version += 1
            self.report = encode(report_of(self.known, self._version))
            self._next_map = self.now


def explore_with_others(agent: Agent) -> Task:
    """EXPLORE as one of a team, each of which decides for itself.

    As `topomap.exploring.explore_halls`, but at every vertex the robot merges what it
    has heard, and goes to the exit that it allots to itself. It waits for nobody: a
    message that does not come changes only what it knows.

    Parameters
    ----------
    agent : Agent
        Its mind.

    Returns
    -------
    Task
        A coroutine without an end: a robot that has nothing left to do stands, tells
        what it knows, and goes on if it hears of something open.
    """
    for _ in range(LIVES):
        try:
            yield from _explore(agent)
        except (JobError, RefutedError, UnforeseenError) as error:
            last = error
            agent.begin_anew(str(error))
    raise last


def _explore(agent: Agent) -> Task:
    """Explore, from where the robot stands, with nothing known."""
    found, chart = agent.found, agent.found.chart
    yield from _attentively(agent, first_vertex(found))
    waited = 0.0
    while True:
        agent.hear()
        agent.learn()
        choice = agent.choose()
        if not found.closed or found.walls >= found.max_walls:
            choice = Choice(None, False, "a loop was never closed")
        if choice.waits and waited < LONGEST_WAIT:
            _note_once(agent, "waits", choice)
            agent.aim(None)
            agent.tell()
            waited += BEAT
            yield from _stand(agent)
            continue
        waited = 0.0
        if choice.target is None:
            yield from _rest(agent, choice)
            continue
        agent.is_done = False
        vertex, exit_ = choice.target
        if vertex == found.here:
            _note_once(agent, "goes", choice)
            agent.aim(choice.target, ventures=True)
            yield from _attentively(agent, venture(found, exit_))
            agent.aim(None)
        else:
            _note_once(agent, "goes", choice)
            agent.aim(choice.target)
            step = chart.route(found.here, vertex)[0]
            yield from _attentively(agent, go(found, step[1]))


def _rest(agent: Agent, choice: Choice) -> Task:
    """Go home if asked to, by one edge; else stand for a beat."""
    found, chart = agent.found, agent.found.chart
    agent.aim(None)
    home = chart.now(0)
    if agent.returns and found.here != home:
        yield from _attentively(agent, go(found, chart.route(found.here, home)[0][1]))
        return
    if not agent.is_done:
        agent.is_done, agent.done_at = True, agent.now
        agent.note("ends", choice.reason)
    agent.tell()
    yield from _stand(agent)


def _stand(agent: Agent) -> Task:
    """Stand for a beat, or go one edge out of the way of another robot."""
    found = agent.found
    bearing = agent.beset()
    exits = [q for q in range(4) if (found.here, q) in found.chart.links]
    if bearing is None or not exits:
        yield Wait(BEAT)
        return
    facing = bearing + angle_of(found.heading)
    away = min(exits, key=lambda q: math.cos(angle_of(q) - facing))
    agent.note("makes way", "another robot waits for it", (found.here, away))
    yield from _attentively(agent, go(found, away))


def _note_once(agent: Agent, kind: str, choice: Choice) -> None:
    """Write a choice into the history unless it is the last one still."""
    last = agent.events[-1] if agent.events else None
    if last is None or (last.kind, last.target) != (kind, choice.target):
        agent.note(kind, choice.reason, choice.target)


def _attentively(agent: Agent, behaviour: Behaviour[None]) -> Task:
    """Carry out a behaviour, telling and listening between its primitives."""
    outcome: Outcome | None = None
    while True:
        agent.hear()
        agent.tell()
        try:
            primitive = next(behaviour) if outcome is None else behaviour.send(outcome)
        except StopIteration:
            return
        outcome = yield primitive
