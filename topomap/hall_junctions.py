"""Which halls leave a junction, and to which sides."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import shapely

from topomap.hall_cells import Junction
from worlds.errors import WorldError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from behaviours.parameters import Parameters
    from topomap.hall_cells import HallParts, Stretch

__all__ = ["Terminal", "junction_sides"]

ROUNDING = 1e-6
"""Lengths that differ by less, in metres, are one length."""
OFF = 0.1
"""Halls that face each other may be off each other's middle by this part of r0, and a
hall may be off its own beside the junction. Found by experiment: beyond, ever more
junctions have jambs in the robot's way."""

NEAR = 1.0
"""So near to a junction, in parts of r0, a hall's middle must not shift by more: the
robot has no room left to regain it."""


@dataclass(frozen=True, slots=True)
class Terminal:
    """One end of a stretch."""

    stretch: Stretch
    end: int

    @property
    def outward(self) -> int:
        """The direction out of the stretch at this end, in quarter turns."""
        return self.stretch.axis + (0 if self.end else 2)

    @property
    def width(self) -> float:
        """Of the hall here, in metres."""
        _, low, high = self.stretch.high if self.end else self.stretch.low
        return high - low

    def place(self, inside: float = 0.0) -> tuple[float, float]:
        """Return a point on the middle line, so far from the end."""
        along, low, high = self.stretch.high if self.end else self.stretch.low
        along += -inside if self.end else inside
        across = (low + high) / 2
        return (along, across) if self.stretch.axis == 0 else (across, along)

    def middles(self, within: float) -> Iterator[float]:
        """Yield where the middle line is, across, so near to the end."""
        rim = (self.stretch.high if self.end else self.stretch.low)[0]
        for begin, finish, low, high in self.stretch.pieces:
            way = rim - finish if self.end else begin - rim
            if way < within - ROUNDING:
                yield (low + high) / 2


def junction_sides(
    parts: HallParts, free: shapely.Geometry, parameters: Parameters
) -> list[dict[int, tuple[int, int]]]:
    """Return for each junction the stretch, and which end of it, on each side.

    Parameters
    ----------
    parts : HallParts
        Of a world.
    free : Polygon or MultiPolygon
        Where the robot can be.
    parameters : Parameters
        Decide how wide a junction can be, and what is in a robot's way.

    Returns
    -------
    list of dict
        By the direction out of the junction, in quarter turns.

    Raises
    ------
    WorldError
        If a junction is wider than 2 r0, two halls leave it to the same side, the
        middle of a hall, or of two that face each other, shifts by more than a tenth
        of r0 within r0 of the junction, or a wall of the junction reaches into the
        way of a hall's middle.
    """
    for box in parts.junctions:
        _check_size(box, 2 * parameters.r0)
    sides = _sides(parts)
    for box, ends in zip(parts.junctions, sides, strict=True):
        for side in (0, 1):
            halls = [
                Terminal(parts.stretches[n], end)
                for n, end in (ends[q] for q in (side, side + 2) if q in ends)
            ]
            _check_middles(box, halls, parameters)
            for hall in halls:
                _check_way(box, hall, free, parameters.r_min)
    return sides


def _check_size(box: tuple[float, float, float, float], most: float) -> None:
    size = max(box[2] - box[0], box[3] - box[1])
    if size > most + ROUNDING:
        raise WorldError(
            _name(box),
            f"{size:.4g} m wide; expected at most {most:.4g} m, twice r0",
        )


def _check_middles(
    box: tuple[float, float, float, float],
    halls: list[Terminal],
    parameters: Parameters,
) -> None:
    """Check that a robot in the middle of a hall, at a junction, goes straight on."""
    near, most = NEAR * parameters.r0, OFF * parameters.r0
    middles = [middle for hall in halls for middle in hall.middles(near)]
    off = max(middles, default=0.0) - min(middles, default=0.0)
    if off > most + ROUNDING:
        raise WorldError(
            _name(box),
            f"the middle of the halls along {'xy'[halls[0].stretch.axis]} shifts by "
            f"{off:.4g} m within {near:.4g} m of it; expected at most {most:.4g} m, "
            "a tenth of r0",
        )


def _check_way(
    box: tuple[float, float, float, float],
    hall: Terminal,
    free: shapely.Geometry,
    r_min: float,
) -> None:
    """Check that the way through a junction is free, r_min to both sides."""
    axis = hall.stretch.axis
    across = hall.place()[1 - axis]
    sides = across - r_min + ROUNDING, across + r_min - ROUNDING
    x0, y0, x1, y1 = box
    way = (
        shapely.box(x0, sides[0], x1, sides[1])
        if axis == 0
        else shapely.box(sides[0], y0, sides[1], y1)
    )
    if not free.buffer(ROUNDING / 10).covers(way):
        raise WorldError(
            _name(box),
            f"a wall reaches into the way along {'xy'[axis]}; expected none nearer "
            f"than {r_min:g} m, r_min, to the hall's middle",
        )


def _name(box: tuple[float, float, float, float]) -> str:
    return f"junction at ({(box[0] + box[2]) / 2:.4g}, {(box[1] + box[3]) / 2:.4g})"


def _sides(parts: HallParts) -> list[dict[int, tuple[int, int]]]:
    """Return for each junction the stretch, and which end of it, on each side."""
    sides: list[dict[int, tuple[int, int]]] = [{} for _ in parts.junctions]
    for n, stretch in enumerate(parts.stretches):
        for end in (0, 1):
            at = stretch.ends[end]
            if isinstance(at, Junction):
                side = (Terminal(stretch, end).outward + 2) % 4
                if side in sides[at.number]:
                    x, y = Terminal(stretch, end).place()
                    raise WorldError(
                        f"hall at ({x:.4g}, {y:.4g})",
                        "two halls leave a junction to the same side",
                    )
                sides[at.number][side] = n, end
    return sides
