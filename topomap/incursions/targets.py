"""Where a robot should drive next: incursions worth proving, and hidden space."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from topomap.incursions.candidates import (
    Candidate,
    Options,
    candidates,
    landing_limits,
)
from topomap.incursions.passive import is_swept
from topomap.incursions.search import Ray, hidden_space, rays_through, spots_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import shapely
    from numpy.typing import NDArray

    from topomap.incursions.layout import Layout

__all__ = ["may_return", "proofs_wanted", "savings", "search_targets", "worth_proving"]

SIGHT = 0.9
"""Part of the sensors' range to the side within which a spot counts as swept."""
TURNING = 2.0
"""What a ray costs besides its length, in metres."""
RAYS_A_SPOT = 12
LEAST_SHARE = 1e-3
"""Least part of all ways together that an incursion must save to be driven."""


def savings(
    found: Sequence[Candidate], distances: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Find what each incursion would save over all pairs of vertices.

    Parameters
    ----------
    found : sequence of Candidate
        Each weighed alone.
    distances : ndarray, shape (V, V)
        Ways known, in metres; pairs with none count as twice the farthest.

    Returns
    -------
    ndarray, shape (N,)
        Metres, summed over all ordered pairs. O(V^2) each.
    """
    far = 2.0 * float(distances[np.isfinite(distances)].max(initial=1.0))
    known = np.where(np.isfinite(distances), distances, far)
    result = np.empty(len(found))
    for k, c in enumerate(found):
        through = known[:, c.source, None] + c.length + known[None, c.target]
        result[k] = np.maximum(known - through, 0.0).sum()
    return result


def worth_proving(
    found: Sequence[Candidate], distances: NDArray[np.float64], options: Options
) -> list[Candidate]:
    """Return the incursions to drive: those that save most, each beyond those before.

    Parameters
    ----------
    found : sequence of Candidate
        Not known to be free.
    distances : ndarray, shape (V, V)
        Ways known, in metres.
    options : Options
        Their `gain` is asked of each incursion alone.

    Returns
    -------
    list of Candidate
        The best first. What is left out saves less than a thousandth of all ways.
    """
    far = 2.0 * float(distances[np.isfinite(distances)].max(initial=1.0))
    known = np.where(np.isfinite(distances), distances, far)
    total = float(known.sum())
    chosen = []
    saved = savings(found, known)
    for k in np.argsort(-saved, kind="stable").tolist():
        if saved[k] < LEAST_SHARE * total:
            break
        c = found[k]
        if c.length > (1 - options.gain) * known[c.source, c.target]:
            continue
        through = known[:, c.source, None] + c.length + known[None, c.target]
        if np.maximum(known - through, 0.0).sum() >= LEAST_SHARE * total:
            chosen.append(c)
            np.minimum(known, through, out=known)
    return chosen


def proofs_wanted(
    layout: Layout,
    space: shapely.Geometry,
    distances: NDArray[np.float64],
    options: Options,
    tried: set[tuple[int, int]],
) -> list[Candidate]:
    """Return the incursions that are worth proving and not known to be free.

    Parameters
    ----------
    layout : Layout
        Of the map.
    space : shapely.Geometry
        Known space.
    distances : ndarray, shape (V, V)
        Ways known, in metres.
    options : Options
        How sure and how useful they must be.
    tried : set of (vertex id, degrees)
        Ways that were driven before.

    Returns
    -------
    list of Candidate
        As from `worth_proving`.
    """
    ids = [vertex.id for vertex in layout.chart.vertices]
    found = [
        c
        for c in candidates(layout, distances, options)
        if (ids[c.source], round(math.degrees(c.direction))) not in tried
    ]
    proven = is_swept(found, layout, space, options)
    unsure = [c for c, ok in zip(found, proven, strict=True) if not ok]
    return worth_proving(unsure, distances, options)


def may_return(layout: Layout, candidate: Candidate, options: Options) -> bool:
    """Tell whether a robot that must turn back would find known ground again.

    It goes back twice the way by dead reckoning, and must not miss the walls of the
    loop that it came from: [K] 3.6.3 drops incursions that are too long for it.
    """
    own = options.drift.aside(2 * candidate.reach, math.pi)
    return options.confidence * own <= float(layout.lengths.max())


def search_targets(
    layout: Layout,
    space: shapely.Geometry,
    distances: NDArray[np.float64],
    here: int,
    farthest: float,
    tried: set[tuple[int, int]],
) -> list[Candidate]:
    """Return the straight ways that together would sweep all hidden space.

    Parameters
    ----------
    layout : Layout
        Of the map.
    space : shapely.Geometry
        Known space.
    distances : ndarray, shape (V, V)
        Ways known, in metres.
    here : int
        Row of the vertex at which the robot stands; what it cannot reach is left out.
    farthest : float
        How far the sensors see to the side, in metres.
    tried : set of (vertex id, degrees)
        Ways that were driven before.

    Returns
    -------
    list of Candidate
        Chosen greedily by spots swept a metre.
    """
    robot = layout.parameters
    spots = spots_of(hidden_space(layout, space, robot.r_min))
    ids = [vertex.id for vertex in layout.chart.vertices]
    rays = []
    for through in rays_through(layout, spots, robot.r0 - 0.02):
        able = [
            ray
            for ray in through
            if math.isfinite(distances[here, ray.source])
            and (ids[ray.source], round(math.degrees(ray.direction))) not in tried
        ]
        rays += sorted(able, key=lambda ray: ray.reach)[:RAYS_A_SPOT]
    if not rays:
        return []
    covers = _covers(layout, spots, rays, SIGHT * farthest)
    price = np.array([ray.reach + TURNING for ray in rays])
    left = np.ones(len(spots), dtype=bool)
    chosen = []
    while True:
        worth = (covers & left).sum(axis=1) / price
        best = int(worth.argmax())
        if worth[best] <= 0:
            break
        left &= ~covers[best]
        chosen.append(_as_candidate(layout, rays[best]))
    return chosen


def _covers(
    layout: Layout, spots: NDArray[np.float64], rays: Sequence[Ray], sight: float
) -> NDArray[np.bool_]:
    """Return which spots (R, N) each ray passes within sight."""
    start = layout.positions[[ray.source for ray in rays]]
    phi = np.array([ray.direction for ray in rays])
    ahead = np.column_stack([np.cos(phi), np.sin(phi)])
    reach = np.array([ray.reach for ray in rays])
    way = spots[None] - start[:, None]
    along = (way * ahead[:, None]).sum(axis=2)
    aside = way[..., 1] * ahead[:, None, 0] - way[..., 0] * ahead[:, None, 1]
    return np.asarray(
        (abs(aside) <= sight) & (along >= 0) & (along <= reach[:, None]), dtype=np.bool_
    )


def _as_candidate(layout: Layout, ray: Ray) -> Candidate:
    """Return a ray as an incursion to the nearer end of its wall."""
    a, b = layout.ends[ray.wall].tolist()
    ahead = np.array([math.cos(ray.direction), math.sin(ray.direction)])
    landing = layout.positions[ray.source] + ray.reach * ahead
    place = float((landing - layout.positions[a]) @ layout.along[ray.wall])
    length = float(layout.lengths[ray.wall])
    end = int(place > length / 2)
    rest = max(abs((length if end else 0.0) - place), 1e-3)
    low, high = landing_limits(layout)[ray.wall].tolist()
    sureness = 1.0 if low <= place <= high else 0.5
    target = b if end else a
    return Candidate(
        ray.source,
        ray.wall,
        end,
        target,
        place,
        ray.direction,
        ray.reach,
        rest,
        sureness,
    )
