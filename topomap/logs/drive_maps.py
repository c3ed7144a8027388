"""How a map is made of a drive that somebody's robot made along walls."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from evidence.walls import Wall
from topomap.boundary import TURN, Walk
from topomap.closers import make_closer
from topomap.errors import JobError
from topomap.folding import fold
from topomap.logs.drive_walls import Stretch, parameters_of, walls_of
from topomap.logs.replaying import Replay

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from evidence.walls import LoopCloser
    from topomap.logs.drives import Drive

__all__ = ["map_drive"]


LAST = 0.01
"""Most that a closure may be in doubt when the log is over. A robot that drives can
find out more at little cost, and closes at a hundredth of that; a log cannot."""
SLIP = 1e-4
"""How often a corner is taken to be missed. It lies between two lines of many ranges
each; a log that ends when the robot is sure has no second lap to tell by."""


def map_drive(
    drive: Drive,
    *,
    closing: str = "likelihood",
    sigma: float = 0.06,
    parameters: Parameters | None = None,
    watch: Callable[[LoopCloser], LoopCloser] | None = None,
) -> Replay:
    """Make a map of a drive along walls: of its turns, corners and walls.

    Parameters
    ----------
    drive : Drive
        Of a robot that kept a wall beside it, on either side, in a place whose
        walls stand at right angles.
    closing : str
        Decides whether it has come round; names as in `topomap.closers.CLOSINGS`.
    sigma : float
        Standard deviation of a length by this odometry, as a part of the length.
    parameters : Parameters, optional
        The lengths the robot kept; as the drive shows them where None.
    watch : callable, optional
        Gets the closer, and returns one that does the same and looks on.

    Returns
    -------
    Replay
        The map of the longest walk that closes, or of the longest one; how sure the
        closure is stands in its last decision.

    Raises
    ------
    JobError
        If the robot nowhere went along a wall from one corner to the next.

    Notes
    -----
    The whole drive is heard before the closer has its last word, unlike a robot that
    stops when it is sure; a closure counts if at most 1 % of doubt is left then. A wall
    on the left is walked backwards, and so is on the right: corners and lengths are
    the same.
    """
    is_left = _seen(drive.left) > _seen(drive.right)
    beside = drive.mirrored() if is_left else drive
    lengths = parameters or parameters_of(beside)
    stretches = walls_of(beside, lengths)
    if not stretches:
        raise JobError("nowhere a wall that was driven along from corner to corner")
    walks = []
    for stretch in stretches:
        closer = make_closer(closing, sigma, lengths, epsilon=LAST, slip=SLIP)
        told = _backwards(stretch) if is_left else stretch
        walks.append(_walk(told, closer if watch is None else watch(closer)))
    best = max(walks, key=lambda walk: (walk.period is not None, len(walk.legs)))
    chart = fold(best, lengths, sigma)
    simulated = float(drive.times[-1] - drive.times[0])
    return Replay(
        *(chart, best.period is not None, (best,), (), len(best.legs), ()),
        float(drive.way[-1]),
        simulated,
    )


def _seen(ranges: np.ndarray) -> int:
    return int(np.isfinite(ranges).sum())


def _walk(stretch: Stretch, closer: LoopCloser) -> Walk:
    """Tell a closer of all walls."""
    closer.begin(stretch.first.value, TURN[stretch.first])
    decisions = [
        closer.observe(Wall(leg.length, leg.corner.value, TURN[leg.corner], leg.shift))
        for leg in stretch.legs
    ]
    last = decisions[-1]
    if last.error_probability > LAST:
        decisions[-1] = replace(last, period=None)
    return Walk(stretch.first, stretch.legs, tuple(decisions))


def _backwards(stretch: Stretch) -> Stretch:
    """Return the walls as met by one who comes the other way."""
    corners = [stretch.first, *(leg.corner for leg in stretch.legs)]
    legs = tuple(
        replace(leg, corner=corner, shift=-leg.shift)
        for leg, corner in zip(reversed(stretch.legs), corners[-2::-1], strict=True)
    )
    return Stretch(corners[-1], legs)
