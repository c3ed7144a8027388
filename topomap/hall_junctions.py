"""Which halls leave a junction, and to which sides."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from topomap.hall_cells import Junction
from worlds.errors import WorldError

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from topomap.hall_cells import HallParts, Stretch

__all__ = ["Terminal", "junction_sides"]

ROUNDING = 1e-6
"""Lengths that differ by less, in metres, are one length."""
OFF = 0.1
"""Halls that face each other may be off each other's middle by this part of r0. Found
by experiment: beyond, ever more junctions have jambs in the robot's way."""


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


def junction_sides(
    parts: HallParts, parameters: Parameters
) -> list[dict[int, tuple[int, int]]]:
    """Return for each junction the stretch, and which end of it, on each side.

    Parameters
    ----------
    parts : HallParts
        Of a world.
    parameters : Parameters
        Decide how wide a junction can be, and what is in a robot's way.

    Returns
    -------
    list of dict
        By the direction out of the junction, in quarter turns.

    Raises
    ------
    WorldError
        If a junction is wider than 2 r0, two halls leave it to the same side, or two
        that face each other are off each other's middle by more than a tenth of r0.
    """
    for box in parts.junctions:
        _check_size(box, 2 * parameters.r0)
    sides = _sides(parts)
    for box, ends in zip(parts.junctions, sides, strict=True):
        for side in (0, 1):
            if side in ends and side + 2 in ends:
                halls = [
                    Terminal(parts.stretches[n], end)
                    for n, end in (ends[side], ends[side + 2])
                ]
                _check_facing(box, halls[0], halls[1], OFF * parameters.r0)
    return sides


def _check_size(box: tuple[float, float, float, float], most: float) -> None:
    size = max(box[2] - box[0], box[3] - box[1])
    if size > most + ROUNDING:
        raise WorldError(
            _name(box),
            f"{size:.4g} m wide; expected at most {most:.4g} m, twice r0",
        )


def _check_facing(
    box: tuple[float, float, float, float], one: Terminal, other: Terminal, most: float
) -> None:
    across = 1 - one.stretch.axis
    off = abs(one.place()[across] - other.place()[across])
    if off > most + ROUNDING:
        raise WorldError(
            _name(box),
            f"halls that face each other are {off:.4g} m off each other's middle; "
            f"expected at most {most:.4g} m, a tenth of r0",
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
