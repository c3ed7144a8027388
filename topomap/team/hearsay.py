"""What a robot has heard of the others: the newest beacon and map of each."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TypeVar

from topomap.team.changes import caught_up
from topomap.team.messages import MOST, Beacon, MapChange, MapReport, Message

__all__ = ["Hearsay"]

Heard = TypeVar("Heard")


@dataclass(slots=True)
class Hearsay:
    """Beacons with the time they were heard, and maps, by sender.

    Of a robot that has begun anew, under a higher number, the former map is forgotten,
    and where it said that it was.
    """

    beacons: dict[int, tuple[Beacon, float]] = field(default_factory=dict)
    maps: dict[int, MapReport] = field(default_factory=dict)

    def take(self, message: Message, now: float) -> None:
        """Keep a message if it is newer than what was heard of its kind and sender."""
        sender = message.sender
        if isinstance(message, Beacon):
            last = self.beacons.get(sender)
            if last is None or message.count > last[0].count:
                self.beacons[sender] = message, now
                _forget_former(self.beacons)
            return
        newer = self._newer(message)
        if newer is not None:
            self.maps[sender] = newer
            _forget_former(self.maps)

    def lately(self, now: float, within: float) -> Iterator[tuple[int, Beacon]]:
        """Return the robots heard within so many seconds, and what they said."""
        for sender, (beacon, heard_at) in self.beacons.items():
            if now - heard_at <= within:
                yield sender, beacon

    def _newer(self, message: MapReport | MapChange) -> MapReport | None:
        last = self.maps.get(message.sender)
        if isinstance(message, MapChange):
            return None if last is None else caught_up(last, message)
        is_old = last is not None and message.version <= last.version
        return None if is_old else message


def _forget_former(heard: dict[int, Heard]) -> None:
    """Keep the highest number of each robot."""
    latest: dict[int, int] = {}
    for sender in heard:
        latest[sender % MOST] = max(sender, latest.get(sender % MOST, sender))
    for sender in list(heard):
        if sender != latest[sender % MOST]:
            del heard[sender]
