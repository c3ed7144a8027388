"""What robots tell each other, as frozen values and as bytes."""

from __future__ import annotations

import msgspec

__all__ = [
    "MOST",
    "Accusation",
    "Beacon",
    "End",
    "LinkRow",
    "MapChange",
    "MapReport",
    "Message",
    "Name",
    "PlaceRow",
    "decode",
    "encode",
]

MOST = 64
"""Robots of a team; a map begun anew has its robot's number and so many more."""
Name = tuple[int, int]
"""A vertex by the robot that met it, and that robot's number for it."""
End = tuple[int, int]
"""A vertex of the sender, and one of its exits in quarter turns."""


class PlaceRow(msgspec.Struct, frozen=True, array_like=True):
    """A vertex of a map."""

    number: int
    """In the sender's map."""
    type: str
    ways: tuple[str, str, str, str]
    """Ways to leave in the directions 0, 90, 180, 270 degrees of the sender's map;
    empty where there is none."""
    names: tuple[Name, ...]
    """All names under which it is known, the sender's own included."""


class LinkRow(msgspec.Struct, frozen=True, array_like=True):
    """An edge of a map, with all that was measured on it."""

    source: End
    target: End
    behaviour: str
    lengths: tuple[float, ...]
    shifts: tuple[float, ...]
    clearance: float


class MapReport(msgspec.Struct, frozen=True, array_like=True, tag="map"):
    """All that a robot knows of the building."""

    sender: int
    version: int
    """Rises with every change; an older one says nothing new."""
    places: tuple[PlaceRow, ...]
    links: tuple[LinkRow, ...]
    turns: dict[int, int]
    """For each robot whose map is part of this one, the quarter turns that take
    directions of its map to directions of the sender's."""


class MapChange(msgspec.Struct, frozen=True, array_like=True, tag="change"):
    """What a robot has learned since a version of its map that others have."""

    sender: int
    base: int
    """Who has this version, or a later one, can catch up."""
    version: int
    places: tuple[PlaceRow, ...]
    """New and changed ones."""
    gone_places: tuple[int, ...]
    """Those that were found to be another one."""
    links: tuple[LinkRow, ...]
    gone_links: tuple[tuple[End, End], ...]
    turns: dict[int, int]
    """As in `MapReport`, all of them."""


class Accusation(msgspec.Struct, frozen=True, array_like=True):
    """What a robot found at the end of an edge, where its map had something else."""

    source: Name
    """The vertex that it came from, under the name in the map that it dropped."""
    target: Name
    """The vertex to which the edge should have led."""
    type: str
    """Of the vertex that was found."""
    length: float
    """Of the way there, in metres."""


class Beacon(msgspec.Struct, frozen=True, array_like=True, tag="beacon"):
    """Where a robot is and what it is about to do."""

    sender: int
    count: int
    """Rises with every beacon: one that comes late is told from a new one."""
    version: int
    """Of its map."""
    here: int
    """The vertex it stands on, or left last."""
    target: End | None
    """The unexplored exit it goes to."""
    is_venturing: bool
    """Whether it has gone through that exit."""
    heard: dict[int, int]
    """The version of each other robot's map that it has."""
    accuses: tuple[Accusation, ...] = ()
    """Edges that it has found to be wrong."""


Message = MapReport | MapChange | Beacon

_ENCODER = msgspec.msgpack.Encoder()
_DECODER: msgspec.msgpack.Decoder[Message] = msgspec.msgpack.Decoder(Message)


def encode(message: Message) -> bytes:
    """Return a message as it goes over the air (MessagePack).

    Examples
    --------
    >>> hello = Beacon(0, 1, 1, 4, (4, 2), False, {1: 3})
    >>> decode(encode(hello)) == hello, len(encode(hello))
    (True, 20)
    """
    return _ENCODER.encode(message)


def decode(data: bytes) -> Message:
    """Return the message that bytes hold."""
    return _DECODER.decode(data)
