"""How a map is made again from a log of our own, bit for bit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import msgspec

from behaviours.parameters import Parameters
from behaviours.port import Outcome, Primitive
from topomap.closers import SLIP, make_closer
from topomap.errors import InputError
from topomap.found import Found, map_by
from topomap.incursions.errors import Drift
from topomap.incursions.improving import Improvement, improve_found
from topomap.logs.messages import text_of
from topomap.logs.reading import Topics, messages_of
from topomap.logs.records import from_plain, to_plain

if TYPE_CHECKING:
    from evidence.walls import LoopCloser

__all__ = ["Recorded", "RecordedBody", "Replay", "read_recorded", "replay_map"]

FORMAT, VERSION = "topomap-log", 1
RUN, PRIMITIVE, OUTCOME = "/topomap/run", "/topomap/primitive", "/topomap/outcome"
ALTERNATING = "a primitive and its outcome by turns, numbered from 0"


@dataclass(frozen=True, slots=True)
class Recorded:
    """What was asked of a robot, and what it answered."""

    source: str
    """The log's name."""
    about: dict[str, Any]
    """What the run was: ``parameters``, ``sigma``, ``closing``, and so on."""
    parameters: Parameters
    steps: tuple[tuple[dict[str, Any], dict[str, Any]], ...]
    """Each primitive and its outcome, as plain values."""


@dataclass(frozen=True, slots=True)
class Replay(Found):
    """A map that was made of a log."""

    travelled: float
    """Way of the robot in metres."""
    simulated: float
    """Time in the robot's world, in seconds."""
    collisions: int = 0
    improvement: Improvement | None = None
    """What was done to the base map; None where its loop stayed open."""


def read_recorded(path: str | PathLike[str]) -> tuple[Recorded | None, Topics]:
    """Read what a log of our own holds of primitives and outcomes.

    Returns
    -------
    Recorded or None, dict
        None if the log is not one of ours; and the topics that it has.

    Raises
    ------
    InputError
        If it cannot be read, or its records contradict themselves.
    """
    source = fspath(path)
    topics: Topics = {}
    told: dict[str, list[dict[str, Any]]] = {RUN: [], PRIMITIVE: [], OUTCOME: []}
    for message in messages_of(path, lambda topic, _: topic in told, topics):
        try:
            plain = msgspec.json.decode(text_of(message.data), type=dict[str, Any])
        except ValueError as error:
            expected = f"JSON in a string: {error}"
            raise InputError(source, message.topic, None, expected) from None
        told[message.topic].append(plain)
    if not told[RUN]:
        return None, topics
    about = told[RUN][0]
    if (about.get("format"), about.get("version")) != (FORMAT, VERSION):
        got = f"{about.get('format')} {about.get('version')}"
        raise InputError(source, RUN, got, f"{FORMAT} {VERSION}")
    parameters = _made(source, f"{RUN}.parameters", about.get("parameters"), Parameters)
    asked, answered = told[PRIMITIVE], told[OUTCOME]
    numbers = [[step.get("n") for step in steps] for steps in (asked, answered)]
    if numbers[0] != numbers[1] or numbers[0] != list(range(len(asked))):
        raise InputError(source, PRIMITIVE, None, ALTERNATING)
    return Recorded(
        source, about, parameters, tuple(zip(asked, answered, strict=True))
    ), topics


class RecordedBody:
    """A body that answers what another one answered; a `behaviours.port.Body`.

    Parameters
    ----------
    recorded : Recorded
        Its answers, in order.
    """

    def __init__(self, recorded: Recorded) -> None:
        self.parameters = recorded.parameters
        self.travelled = 0.0
        self.clock = 0.0
        self.collisions = 0
        self._recorded = recorded
        self._next = 0

    def execute(self, primitive: Primitive) -> Outcome:
        """Return the recorded outcome.

        Raises
        ------
        InputError
            If another primitive was recorded here, or nothing more.
        """
        number, source = self._next, self._recorded.source
        plain = to_plain(primitive)
        if number == len(self._recorded.steps):
            place = f"{PRIMITIVE}[{number}]"
            raise InputError(source, place, None, f"{plain}; the log ends here")
        asked, answered = self._recorded.steps[number]
        asked = {key: value for key, value in asked.items() if key != "n"}
        if msgspec.json.encode(asked) != msgspec.json.encode(plain):
            raise InputError(source, f"{PRIMITIVE}[{number}]", asked, str(plain))
        self._next += 1
        place = f"{OUTCOME}[{number}]"
        outcome: Outcome = _made(source, place, answered, Outcome)
        told = _made(source, place, answered, _Told)
        self.travelled, self.clock = told.travelled, told.clock
        self.collisions = told.collisions
        return outcome


@dataclass(frozen=True, slots=True)
class _Told:
    """What a recorded outcome tells besides."""

    travelled: float = 0.0
    clock: float = 0.0
    collisions: int = 0


def replay_map(
    recorded: Recorded,
    *,
    closing: str | None = None,
    sigma: float | None = None,
    max_walls: int | None = None,
    watch: Callable[[LoopCloser], LoopCloser] | None = None,
) -> Replay:
    """Make the map again that a robot made, from its log.

    Parameters
    ----------
    recorded : Recorded
        As `read_recorded` returns it.
    closing, sigma, max_walls : optional
        As for `topomap.mapping.build_map`; those of the run where None, and the
        map is then the same, bit for bit.
    watch : callable, optional
        Gets the closer, and returns one that does the same and looks on.

    Returns
    -------
    Replay
        The map, and what it took.

    Raises
    ------
    InputError
        If the log does not fit to what the behaviours ask.
    JobError
        If the run failed, as it did when it was recorded.
    """
    about = _made(recorded.source, RUN, recorded.about, _About)
    name = closing or about.closing
    if name is None:
        expected = "the name of the run's closer: the log does not tell"
        raise InputError("", "closing", None, expected)
    deviation = about.sigma if sigma is None else sigma
    body = RecordedBody(recorded)
    closer = make_closer(name, deviation, recorded.parameters, slip=about.slip)
    found = map_by(
        body,
        closer if watch is None else watch(closer),
        max_walls or about.max_walls,
        deviation,
        halls=about.halls,
    )
    drift = replace(about.drift, sigma=deviation)
    better = improve_found(found, about.improve, drift, body)
    return Replay(
        better.map if better else found.map,
        *(found.closed, found.loops, found.recognitions, found.walls),
        found.refuted,
        body.travelled,
        body.clock,
        body.collisions,
        better,
    )


@dataclass(frozen=True, slots=True)
class _About:
    """What a replay has to know of a run."""

    sigma: float
    max_walls: int
    closing: str | None = None
    slip: float = SLIP
    halls: bool = False
    improve: str = "none"
    drift: Drift = field(default_factory=Drift)


def _made(source: str, field: str, plain: object, kind: type[Any]) -> Any:
    """Make a value, or name the field at fault."""
    try:
        return from_plain(plain, kind)
    except ValueError as error:
        raise InputError(source, field, None, str(error)) from None
