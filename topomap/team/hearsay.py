"""What a robot has heard of the others: the newest beacon and map of each."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from topomap.team.changes import caught_up
from topomap.team.messages import MOST, Beacon, MapChange, MapReport, Message

__all__ = ["Hearsay"]


@dataclass(slots=True)
class Hearsay:
    """Beacons with the time they were heard, and maps, by sender.

    Of a robot that has begun anew, under a higher number, the former map is forgotten,
    and where it said that it was.
    """

    beacons: dict[int, tuple[Beacon, float]] = field(default_factory=dict)
    maps: dict[int, MapReport] = field(default_factory=dict)
    _latest: dict[int, int] = field(default_factory=dict)
    """The highest number of each robot from which anything was heard."""

    def take(self, message: Message, now: float) -> None:
        """Keep a message if it is newer than what was heard of its kind and sender."""
        sender = message.sender
        former = self._latest.get(sender % MOST, sender)
        if sender < former:
            return
        if sender > former:
            self.beacons.pop(former, None)
            self.maps.pop(former, None)
        self._latest[sender % MOST] = sender
        if isinstance(message, Beacon):
            last = self.beacons.get(sender)
            if last is None or message.count > last[0].count:
                self.beacons[sender] = message, now
            return
        newer = self._newer(message)
        if newer is not None:
            self.maps[sender] = newer

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
