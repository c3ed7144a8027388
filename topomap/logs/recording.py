"""How a run is logged: all that the robot sensed, was asked, answered and believed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from os import PathLike
from typing import TYPE_CHECKING, Any, BinaryIO

from behaviours.port import Outcome, Primitive
from topomap.errors import JobError
from topomap.files.atomic import written_whole
from topomap.logs.dead_reckoning import moved
from topomap.logs.looks import Looks, looks_of
from topomap.logs.map_growing import GrowingMap
from topomap.logs.markers import MARKERS, TRANSFORMS, map_markers
from topomap.logs.mcap_writing import Block, McapWriter
from topomap.logs.records import to_json, to_plain
from topomap.logs.ros_types import encoded, message

if TYPE_CHECKING:
    from behaviours.port import Body
    from evidence.walls import Decision, LoopCloser, Wall
    from topomap.topological_map import TopologicalMap

__all__ = ["FORMAT", "VERSION", "Recording", "recording"]

FORMAT, VERSION = "topomap-log", 1
RUN, PRIMITIVE, OUTCOME, DECISION, MAP_TOPIC = (
    *("/topomap/run", "/topomap/primitive", "/topomap/outcome"),
    *("/topomap/decision", "/topomap/map"),
)
TEXT = "std_msgs/msg/String"
TOPICS = (
    (RUN, TEXT, True),
    (PRIMITIVE, TEXT, False),
    (OUTCOME, TEXT, False),
    (DECISION, TEXT, False),
    (MAP_TOPIC, MARKERS, True),
    ("/tf_static", TRANSFORMS, True),
)
"""Topic, type, and whether a late listener must hear it too."""
SHOWN = 8
"""So many hypotheses of a decision are logged, the most believed first."""
FULL = 2000
"""After so many messages of what was done a chunk of them is written."""


@contextmanager
def recording(
    path: str | PathLike[str], about: Mapping[str, object]
) -> Iterator[Recording]:
    """Log a run while the block runs, to a file that is whole or not there.

    Parameters
    ----------
    path : path-like
        The MCAP file.
    about : mapping
        What the run is, in plain values: a replay needs ``sigma``, ``max_walls``,
        ``closing``, the closer's name, and ``halls``, whether they were explored.

    Yields
    ------
    Recording
        To be given the body by `watch` and the closer by `listen`.

    Raises
    ------
    InputError
        If the file cannot be written, or the packages for logs are missing.
    JobError
        That of the block. The log of a job that failed is kept.
    """
    failure: JobError | None = None
    with written_whole(path) as stream:
        log = Recording(stream, about)
        try:
            yield log
        except JobError as error:
            failure = error
        log.finish()
    if failure is not None:
        raise failure


class Recording:
    """A log that is being written; made by `recording`."""

    def __init__(self, stream: BinaryIO, about: Mapping[str, object]) -> None:
        self._writer = writer = McapWriter(stream, "topomap")
        self._about = about
        self._body: Body | None = None
        self._looks: Looks | None = None
        self._block = Block()
        self._counts: dict[str, int] = {}
        self._channels = {
            topic: writer.channel(topic, kind, latched=latched)
            for topic, kind, latched in TOPICS
        }
        self._growing = GrowingMap()

    def watch(self, body: Body) -> Body:
        """Return a body that does the same, and all of it is logged.

        Parameters
        ----------
        body : Body
            It has not moved yet.
        """
        self._body = body
        self._looks = looks = looks_of(body, self._writer, self._flush)
        head = {"format": FORMAT, "version": VERSION, **self._about}
        self._say(RUN, {**head, "parameters": to_plain(body.parameters)})
        mounts = message(TRANSFORMS, looks.mounts(self.stamp))
        self._put("/tf_static", TRANSFORMS, mounts)
        return _LoggedBody(body, self)

    def listen(self, closer: LoopCloser) -> LoopCloser:
        """Return a closer that does the same, and whose decisions are logged."""
        return _LoggedCloser(closer, self)

    @property
    def stamp(self) -> int:
        """Time in the robot's world, in nanoseconds."""
        return 0 if self._body is None else round(self._body.clock * 1e9)

    def asked(self, primitive: Primitive) -> None:
        """Log what the body is asked to do."""
        self._say(PRIMITIVE, to_plain(primitive))

    def answered(self, primitive: Primitive, outcome: Outcome) -> None:
        """Log what came of it."""
        plain = to_plain(outcome)
        if self._looks is not None:
            self._looks.after(moved(primitive, outcome), outcome)
        if self._body is not None:
            plain["travelled"] = to_plain(self._body.travelled)
            plain["clock"] = self._body.clock
            plain["collisions"] = self._body.collisions
        self._say(OUTCOME, plain)

    def begin(self, kind: str, turn: float) -> None:
        """Log the corner where the map begins."""
        self._growing.begin(kind, turn)
        self._grow()

    def observe(self, wall: Wall, decision: Decision) -> None:
        """Log a wall, and what was made of it."""
        likely = replace(decision, hypotheses=decision.hypotheses[:SHOWN])
        self._say(DECISION, to_plain(likely))
        self._growing.observe(wall)
        self._grow()

    def show(self, chart: TopologicalMap) -> None:
        """Log the map that the run came to."""
        self._put(MAP_TOPIC, MARKERS, map_markers(self.stamp, chart))

    def finish(self) -> None:
        """Write what is left, and the end of the file."""
        if self._looks is not None:
            self._looks.flush()
        self._flush()
        self._writer.finish()

    def _grow(self) -> None:
        """Log the newest corner, and where the odometry's frame is in the map's."""
        stamp, growing = self.stamp, self._growing
        self._put(MAP_TOPIC, MARKERS, growing.newest(stamp))
        if self._looks is not None:
            frame = growing.frame(stamp, self._looks.pose)
            self._add(self._looks.tf_channel, TRANSFORMS, frame)

    def _say(self, topic: str, plain: dict[str, Any]) -> None:
        """Log an object, numbered by its topic."""
        number = self._counts.get(topic, 0)
        text = to_json({"n": number, **plain})
        self._put(topic, TEXT, message(TEXT, text))

    def _put(self, topic: str, kind: str, value: Any) -> None:
        self._counts[topic] = self._counts.get(topic, 0) + 1
        self._add(self._channels[topic], kind, value, self._counts[topic] - 1)

    def _add(self, channel: int, kind: str, value: Any, number: int = 0) -> None:
        self._block.add(channel, number, self.stamp, encoded(kind, value))
        if sum(map(len, self._block.places.values())) >= FULL:
            self._flush()

    def _flush(self) -> None:
        """Write a chunk of what was done and believed."""
        block, self._block = self._block, Block()
        self._writer.block(block)


class _LoggedBody:
    """A body whose primitives and outcomes are logged; otherwise the one inside."""

    def __init__(self, body: Body, log: Recording) -> None:
        self._body = body
        self._log = log

    def execute(self, primitive: Primitive) -> Outcome:
        """Let the body carry out a primitive, and log it."""
        self._log.asked(primitive)
        outcome = self._body.execute(primitive)
        self._log.answered(primitive, outcome)
        return outcome

    def __getattr__(self, name: str) -> Any:
        """Return what the body itself has."""
        return getattr(self._body, name)


class _LoggedCloser:
    """A loop closer whose decisions are logged."""

    def __init__(self, closer: LoopCloser, log: Recording) -> None:
        self._closer = closer
        self._log = log

    def begin(self, kind: str, turn: float) -> None:
        """Pass on v_0."""
        self._closer.begin(kind, turn)
        self._log.begin(kind, turn)

    def observe(self, wall: Wall) -> Decision:
        """Pass on a wall, and log what was made of it."""
        decision = self._closer.observe(wall)
        self._log.observe(wall, decision)
        return decision
