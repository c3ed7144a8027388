"""What has changed in a map since others heard of it, and how they catch up."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TypeVar

from topomap.team.messages import End, LinkRow, MapChange, MapReport, PlaceRow

__all__ = ["Changes", "caught_up"]

Key = TypeVar("Key", int, tuple[End, End])
Row = TypeVar("Row", PlaceRow, LinkRow)


@dataclass(slots=True)
class Changes:
    """When each row of a robot's map was last changed or taken out.

    Examples
    --------
    A place that was told in version 1, and one that is new in version 2:

    >>> from topomap.team.messages import PlaceRow
    >>> old, new = (PlaceRow(k, "INT", ("", "", "", ""), ((0, k),)) for k in (0, 1))
    >>> changes = Changes()
    >>> changes.record(MapReport(0, 1, (old,), (), {}))
    >>> changes.record(MapReport(0, 2, (old, new), (), {}))
    >>> [row.number for row in changes.since(1).places]
    [1]
    """

    report: MapReport | None = None
    """The newest map."""
    _places: dict[int, int] = field(default_factory=dict)
    """The version of each place's newest change, taken out or not."""
    _links: dict[tuple[End, End], int] = field(default_factory=dict)

    def record(self, report: MapReport) -> None:
        """Take in the newest map, of a higher version than the last."""
        before = self.report or MapReport(report.sender, 0, (), (), {})
        version = report.version
        old, new = places_of(before.places), places_of(report.places)
        self._places.update(dict.fromkeys(_changed(old, new), version))
        was, is_ = links_of(before.links), links_of(report.links)
        self._links.update(dict.fromkeys(_changed(was, is_), version))
        self.report = report

    def since(self, base: int) -> MapChange:
        """Return all that has changed since a version.

        Raises
        ------
        ValueError
            If no map was recorded.
        """
        if self.report is None:
            raise ValueError("no map was recorded")
        places = {k for k, version in self._places.items() if version > base}
        links = {k for k, version in self._links.items() if version > base}
        here, ways = places_of(self.report.places), links_of(self.report.links)
        return MapChange(
            self.report.sender,
            base,
            self.report.version,
            tuple(here[k] for k in sorted(places & here.keys())),
            tuple(sorted(places - here.keys())),
            tuple(ways[k] for k in sorted(links & ways.keys())),
            tuple(sorted(links - ways.keys())),
            self.report.turns,
        )


def caught_up(report: MapReport, change: MapChange) -> MapReport | None:
    """Return a map with a change made in it.

    Parameters
    ----------
    report : MapReport
        As it was last heard.
    change : MapChange
        Of the same sender.

    Returns
    -------
    MapReport or None
        None where the change is no newer than the map, or tells of changes only since
        after it.
    """
    if not change.base <= report.version < change.version:
        return None
    places = places_of(report.places)
    links = links_of(report.links)
    for number in change.gone_places:
        places.pop(number, None)
    for ends in change.gone_links:
        links.pop(ends, None)
    places |= places_of(change.places)
    links |= links_of(change.links)
    return MapReport(
        report.sender,
        change.version,
        tuple(places[k] for k in sorted(places)),
        tuple(links[k] for k in sorted(links)),
        change.turns,
    )


def places_of(rows: Iterable[PlaceRow]) -> dict[int, PlaceRow]:
    """Return places by number."""
    return {row.number: row for row in rows}


def links_of(rows: Iterable[LinkRow]) -> dict[tuple[End, End], LinkRow]:
    """Return links by their two ends."""
    return {(row.source, row.target): row for row in rows}


def _changed(old: dict[Key, Row], new: dict[Key, Row]) -> set[Key]:
    """Return which rows are new, different, or taken out."""
    return {k for k in old.keys() | new.keys() if old.get(k) != new.get(k)}
