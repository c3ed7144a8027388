"""Which passages are neither surely halls, nor surely something else."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import shapely

from worlds.errors import WorldError

if TYPE_CHECKING:
    from behaviours.parameters import Parameters

__all__ = ["check_widths", "moved"]

GRID = 1e-8
"""Coordinates that agree to this, in metres, are equal."""
ROUNDING = 1e-6
"""Lengths that differ by less, in metres, are one length."""
SLIVER = 0.005
"""Half of what is too thin to be anything, in metres: shapely moves a wall whose pieces
are off each other by up to a hundredth of the way as if they were one."""


def check_widths(area: shapely.Geometry, parameters: Parameters) -> None:
    """Check that odometry tells what every passage and every recess is.

    Parameters
    ----------
    area : Polygon or MultiPolygon
        Free space, rectilinear.
    parameters : Parameters
        Halls are 2 r_w to 2 r0 wide; odometry is sure of that to a part `doubt`.

    Raises
    ------
    WorldError
        If a passage, or a recess so deep that its wall is lost, is by less than that
        part narrower than 2 r_w or wider than 2 r0: names the place and the width.

    Notes
    -----
    What squares of one size can sweep and those of another cannot is as wide as the
    one, and narrower than the other.
    """
    r_w, r0, doubt = parameters.r_w, parameters.r0, parameters.doubt
    for least, most in ((r_w * (1 - doubt), r_w), (r0, r0 * (1 + doubt))):
        sizes = least + ROUNDING, most - ROUNDING
        wide, wider = (moved(moved(area, -half), half) for half in sizes)
        for part in shapely.get_parts(wide.difference(wider.buffer(ROUNDING))):
            is_sliver = part.area <= SLIVER * part.length
            if is_sliver or _is_shallow(part, area, parameters):
                continue
            x, y = part.centroid.coords[0]
            x0, y0, x1, y1 = part.bounds
            within = [w for w in (x1 - x0, y1 - y0) if w < 2 * most + ROUNDING]
            width = max(within, default=2 * most)
            raise WorldError(
                f"passage at ({x:.4g}, {y:.4g})",
                f"{width:.4g} m wide, which odometry cannot tell from a hall; "
                f"expected at most {2 * r_w * (1 - doubt):.4g}, {2 * r_w:.4g} to "
                f"{2 * r0:.4g}, or more than {2 * r0 * (1 + doubt):.4g}",
            )


def _is_shallow(
    part: shapely.Geometry, area: shapely.Geometry, parameters: Parameters
) -> bool:
    """Return whether it is a recess in which the wall that recedes stays in sight."""
    rim = part.boundary.difference(area.boundary.buffer(10 * ROUNDING))
    openings = shapely.get_parts(shapely.line_merge(rim))
    if len(openings) != 1:
        return False
    return bool(part.area / rim.length <= parameters.least_recess + ROUNDING)


def moved(area: shapely.Geometry, way: float) -> shapely.Geometry:
    """Return an area grown, or eroded, by a square of half-width `way`."""
    # GEOS may raise the processor's flags where two corners meet in a point; what it
    # returns is right.
    with np.errstate(invalid="ignore", divide="ignore"):
        found = area.buffer(way, join_style="mitre", mitre_limit=10)
    # Walls that sums of decimals put on either side of one line are one wall.
    return shapely.set_precision(found, GRID)
