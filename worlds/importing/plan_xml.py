"""What a floor plan in XML says: the outlines of its rooms, and where doors are."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree import ElementTree
from xml.parsers import expat

import numpy as np

from worlds.errors import WorldError

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Plan", "read_plan"]

MOST_METRES = 10_000.0
"""No building is wider: a plan that is has a wrong scale or a stray corner."""


@dataclass(frozen=True, slots=True)
class Plan:
    """A floor plan in metres, y up."""

    rooms: tuple[NDArray[np.float64], ...]
    """Corners of each room's outline, shape (K, 2), K >= 3; walls are drawn once,
    as lines without thickness, so neighbours share them."""
    doors: NDArray[np.float64]
    """A point in each door, on a wall; shape (D, 2)."""


def read_plan(path: Path) -> Plan:
    """Read a floor plan.

    Parameters
    ----------
    path : Path
        XML whose root ``building`` has a ``scale`` and ``space`` elements with a
        ``bounding_polygon`` each; line segments of class PORTAL are doors.

    Returns
    -------
    Plan
        In metres, with the lowest corner at the origin. Spaces without an
        outline are left out.

    Raises
    ------
    WorldError
        If the file is no XML, declares a document type or entities, has no
        scale or no room, or a number in it is none; names file and element.
    """
    root = _parse(path)
    scale = _length(path, root, "real_distance") / 100
    scale /= _length(path, root, "represented_distance")
    rooms, doors = [], []
    for k, space in enumerate(root.iter("space")):
        outline = space.findall("bounding_polygon/point")
        if len(outline) >= 3:
            rooms.append(_points(path, f"space[{k}]/bounding_polygon", outline))
        for segment in space.iterfind("space_representation/linesegment"):
            if segment.findtext("class", "").strip() == "PORTAL":
                field = f"space[{k}]/space_representation"
                doors += list(_points(path, field, segment.findall("point")[:1]))
    if not rooms:
        raise WorldError(
            f"{path}: space",
            "expected a bounding_polygon of 3 points or more; got none",
        )
    # Pictures have y down.
    turn = np.array([scale, -scale])
    corners = np.concatenate(rooms) * turn
    low, width = corners.min(axis=0), float(np.ptp(corners, axis=0).max())
    if width > MOST_METRES:
        raise WorldError(
            f"{path}: scale",
            f"expected at most {MOST_METRES:g} m of width; got {width:g}",
        )
    return Plan(
        tuple(room * turn - low for room in rooms),
        np.reshape(np.array(doors), (-1, 2)) * turn - low,
    )


def _parse(path: Path) -> ElementTree.Element:
    """Parse XML that declares nothing, so that no entity can be expanded."""
    builder = ElementTree.TreeBuilder()
    parser = expat.ParserCreate()

    def refuse(*_: object) -> None:
        raise WorldError(f"{path}: DOCTYPE", "expected XML without declarations")

    parser.StartDoctypeDeclHandler = refuse
    parser.StartElementHandler = builder.start
    parser.EndElementHandler = builder.end
    parser.CharacterDataHandler = builder.data
    try:
        parser.Parse(path.read_bytes(), True)
    except expat.ExpatError as error:
        raise WorldError(f"{path}: line {error.lineno}", f"no XML: {error}") from None
    return builder.close()


def _length(path: Path, root: ElementTree.Element, name: str) -> float:
    text = root.findtext(f"scale/{name}/value")
    try:
        value = float(text or "")
    except ValueError:
        value = math.nan
    if not 0 < value < math.inf:
        raise WorldError(
            f"{path}: scale/{name}/value", f"expected a length above 0; got {text!r}"
        )
    return value


def _points(
    path: Path, field: str, elements: list[ElementTree.Element]
) -> NDArray[np.float64]:
    corners = []
    for element in elements:
        texts = element.get("x", ""), element.get("y", "")
        try:
            corner = float(texts[0]), float(texts[1])
        except ValueError:
            corner = math.nan, math.nan
        if not (math.isfinite(corner[0]) and math.isfinite(corner[1])):
            raise WorldError(
                f"{path}: {field}/point", f"expected numbers x and y; got {texts}"
            )
        corners.append(corner)
    return np.reshape(np.array(corners, dtype=float), (-1, 2))
