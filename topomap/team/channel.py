"""What of a robot's messages arrives where, and when."""

from __future__ import annotations

import heapq
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from topomap.errors import InputError

if TYPE_CHECKING:
    import numpy as np

    from worlds.world import World

__all__ = ["Channel", "Radio", "Traffic"]


@dataclass(frozen=True, slots=True)
class Radio:
    """How well robots hear each other.

    Raises
    ------
    InputError
        If a value lies outside the range said below.
    """

    range: float = math.inf
    """How far a message carries, in metres; above 0."""
    needs_sight: bool = False
    """Whether walls stop messages."""
    loss: float = 0.0
    """Probability that a message does not arrive, from 0 to 1."""
    delay: float = 0.0
    """Mean time on the way, in seconds; each message takes from 0 to twice that, so
    that a later one may come first."""
    duplication: float = 0.0
    """Probability that a message arrives twice, from 0 to 1."""

    def __post_init__(self) -> None:
        if not self.range > 0:
            raise InputError("", "range", self.range, "metres above 0")
        for name in ("loss", "duplication"):
            value = getattr(self, name)
            if not 0 <= value <= 1:
                raise InputError("", name, value, "a probability from 0 to 1")
        if not 0 <= self.delay < math.inf:
            raise InputError("", "delay", self.delay, "seconds, 0 or more")


@dataclass(frozen=True, slots=True)
class Traffic:
    """What was sent, counted once a message, and what became of it."""

    messages: int
    bytes: int
    heard: int
    """Arrivals: one message may arrive at many robots, or at none."""
    lost: int
    """Messages in range that did not arrive, once a robot."""


class Channel:
    """The air between robots; all that is random is drawn from one generator.

    Parameters
    ----------
    radio : Radio
        How well robots hear each other.
    world : World
        Its walls stop messages, where the radio needs sight.
    robots : int
        How many there are.
    rng : numpy.random.Generator
        Draws losses, delays and duplicates.

    Examples
    --------
    Two robots out of range of each other, and then in range:

    >>> import numpy as np
    >>> from worlds.world import make_world
    >>> hall = make_world([(0, 0), (9, 0), (9, 2), (0, 2)])
    >>> air = Channel(Radio(range=3), hall, 2, np.random.default_rng(1))
    >>> air.send(0, b"far", 0.0, [(1, 1), (8, 1)])
    >>> air.send(0, b"near", 1.0, [(6, 1), (8, 1)])
    >>> air.receive(1, 2.0)
    [b'near']
    """

    def __init__(
        self, radio: Radio, world: World, robots: int, rng: np.random.Generator
    ) -> None:
        self._radio = radio
        self._world = world
        self._rng = rng
        self._boxes: list[list[tuple[float, int, bytes]]] = [[] for _ in range(robots)]
        self._count = self._messages = self._bytes = self._heard = self._lost = 0

    @property
    def traffic(self) -> Traffic:
        """All that was sent so far."""
        return Traffic(self._messages, self._bytes, self._heard, self._lost)

    def send(
        self,
        sender: int,
        data: bytes,
        now: float,
        places: Sequence[tuple[float, float] | None],
    ) -> None:
        """Send to all in range, given where everybody is; None hears nothing."""
        self._messages += 1
        self._bytes += len(data)
        here = places[sender]
        for k, there in enumerate(places):
            if k != sender and here and there and self._reaches(here, there):
                self._carry(k, data, now)

    def receive(self, robot: int, now: float) -> list[bytes]:
        """Return what has arrived at a robot since it last asked."""
        box, found = self._boxes[robot], []
        while box and box[0][0] <= now:
            found.append(heapq.heappop(box)[2])
        self._heard += len(found)
        return found

    def _reaches(self, here: tuple[float, float], there: tuple[float, float]) -> bool:
        if math.dist(here, there) > self._radio.range:
            return False
        if not self._radio.needs_sight:
            return True
        import shapely

        return bool(self._world.free_space.covers(shapely.LineString([here, there])))

    def _carry(self, receiver: int, data: bytes, now: float) -> None:
        """Let a message arrive, once, twice or not at all."""
        lost, twice, *times = self._rng.random(4).tolist()
        if lost < self._radio.loss:
            self._lost += 1
            return
        for k in range(2 if twice < self._radio.duplication else 1):
            self._count += 1
            arrival = now + 2 * self._radio.delay * times[k]
            heapq.heappush(self._boxes[receiver], (arrival, self._count, data))
