"""Which robots' beacons a robot sees: those near it that no wall hides, compiled."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

__all__ = ["visible"]

RIM = 0.9
"""The rims of a body are looked for so far from its centre, in parts of its radius."""


@njit("b1[::1](f8[:,::1],f8[:,::1],i8,f8)", cache=True)
def visible(
    discs: NDArray[np.float64], walls: NDArray[np.float64], own: int, reach: float
) -> NDArray[np.bool_]:
    """Return which robots one of them sees.

    Parameters
    ----------
    discs : array, shape (K, 3)
        Centre x, y and radius of each robot, in metres; none sees one whose radius is
        below 0.
    walls : array, shape (W, 4)
        Ends x0, y0, x1, y1 of each wall.
    own : int
        The row of the robot that looks, which does not see itself.
    reach : float
        How far it sees, in metres, from centre to centre.

    Returns
    -------
    array, shape (K,)
        True where no wall crosses the line from its centre to the other's centre, or
        to one of its rims.

    Notes
    -----
    O(K W) where all are near.
    """
    found = np.zeros(discs.shape[0], dtype=np.bool_)
    x, y = discs[own, 0], discs[own, 1]
    for k in range(discs.shape[0]):
        dx, dy, radius = discs[k, 0] - x, discs[k, 1] - y, discs[k, 2]
        far = math.sqrt(dx * dx + dy * dy)
        if k == own or radius < 0.0 or far > reach or far == 0.0:
            continue
        for side in range(-1, 2):
            ex = dx - side * RIM * radius * dy / far
            ey = dy + side * RIM * radius * dx / far
            hidden = False
            for w in range(walls.shape[0]):
                ax, ay = walls[w, 0] - x, walls[w, 1] - y
                ux, uy = walls[w, 2] - walls[w, 0], walls[w, 3] - walls[w, 1]
                slant = ex * uy - ey * ux
                if slant != 0.0:
                    t = (ax * uy - ay * ux) / slant
                    u = (ax * ey - ay * ex) / slant
                    if 0.0 <= t <= 1.0 and 0.0 <= u <= 1.0:
                        hidden = True
                        break
            if not hidden:
                found[k] = True
                break
    return found
