"""How a world is shown by itself, as in a notebook: small SVG, made by hand."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

__all__ = ["html_of_rings", "svg_of_rings"]

SIDE = 420
"""Length of the longer side, in pixels."""
RIM = 0.04
"""Around the world, as a part of its longer side."""


def svg_of_rings(rings: Sequence[Sequence[tuple[float, float]]], name: str = "") -> str:
    """Return rings of walls as an SVG element, y up.

    Parameters
    ----------
    rings : sequence of rings
        The outer one first; corners in metres.
    name : str
        What to say to those who cannot see it.

    Examples
    --------
    >>> "M0,0 2,0 2,-1 0,-1Z" in svg_of_rings([[(0, 0), (2, 0), (2, 1), (0, 1)]])
    True
    """
    low_x, low_y = (min(corner[axis] for corner in rings[0]) for axis in (0, 1))
    high_x, high_y = (max(corner[axis] for corner in rings[0]) for axis in (0, 1))
    side = max(high_x - low_x, high_y - low_y)
    rim = RIM * side
    wide, high = high_x - low_x + 2 * rim, high_y - low_y + 2 * rim
    scale = SIDE / max(wide, high)
    outline = "".join(
        f"M{' '.join(f'{x:.6g},{0.0 - y:.6g}' for x, y in ring)}Z" for ring in rings
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" role="img" '
        f'aria-label="{escape(name or "a world")}" '
        f'width="{wide * scale:.0f}" height="{high * scale:.0f}" '
        f'viewBox="{low_x - rim:.6g} {-high_y - rim:.6g} {wide:.6g} {high:.6g}">'
        f'<path fill="#e3e6ea" d="M{low_x - rim:.6g},{-high_y - rim:.6g}'
        f'h{wide:.6g}v{high:.6g}h{-wide:.6g}Z"/>'
        f'<path fill="#fff" fill-rule="evenodd" stroke="#3a424d" '
        f'stroke-width="{side / 250:.3g}" d="{outline}"/></svg>'
    )


def html_of_rings(
    rings: Sequence[Sequence[tuple[float, float]]], name: str = ""
) -> str:
    """Return rings of walls with a line about them, as an HTML element.

    Parameters
    ----------
    rings : sequence of rings
        The outer one first; corners in metres.
    name : str
        Shown as text, whatever is in it.
    """
    corners, islands = sum(map(len, rings)), len(rings) - 1
    says = f"{escape(name or 'world')}: {corners} corners, {islands} islands"
    picture = svg_of_rings(rings, name)
    return f"<figure>{picture}<figcaption>{says}</figcaption></figure>"
