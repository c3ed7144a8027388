"""Where on a map of rooms and halls a robot is, by what it sees at each vertex."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from behaviours.ways import turned

if TYPE_CHECKING:
    from collections.abc import Iterator

    from topomap.chart import Place
    from topomap.routes.hall_places import HallPlaces

__all__ = ["Belief", "Standing", "begun", "landed", "moved", "surest"]

LOST = 1e-3
"""How often a way leads where nobody would expect."""
TURNED = 1e-2
"""How often a robot that is lost is turned other than it thinks."""
ASIDE = 1e-3
"""How often a way leads to a vertex that the map does not have."""
STRANGE = 0.05
"""How probable what it sees there is, of all that there may be."""
MISSED = 1e-2
"""How often a robot goes past a vertex and does not see it."""
MISSEEN = 1e-3
"""How often a vertex is taken for another kind, or its ways are seen wrong."""
SLIP = 0.15
"""Deviation of where a robot stops at a vertex, in metres."""
LONG = 3.0
"""Lengths of ways that nothing is known of are drawn with this mean, in metres."""


class Standing(NamedTuple):
    """Where a robot may stand, and how it is turned."""

    vertex: int
    """Id of the vertex."""
    turn: int
    """The map's direction less the robot's own, in quarter turns."""
    beyond: tuple[int, float] | None = None
    """Exit and metres from that vertex to a place that the map does not have, on which
    the robot stands; None if it stands on the vertex itself."""


Belief = dict[Standing, float]
"""Probabilities, summing to 1; what is left out is impossible."""


def begun(hall: HallPlaces, vertex: int, place: Place) -> Belief:
    """Return the belief of a robot that should stand at a vertex, and sees a place.

    Parameters
    ----------
    hall : HallPlaces
        The map.
    vertex : int
        Id of the vertex.
    place : Place
        What the robot sees, in its own directions, which should be the map's.
    """
    prior = _anywhere(hall, {Standing(vertex, 0): 1.0})
    prior[Standing(vertex, 0)] += 1.0 - LOST
    return _seen(hall, prior, place)


def moved(
    hall: HallPlaces,
    belief: Belief,
    quarters: int,
    length: float,
    place: Place,
    sigma: float,
) -> Belief:
    """Weigh what one more way says.

    Parameters
    ----------
    hall : HallPlaces
        The map.
    belief : Belief
        Before it.
    quarters : int
        The exit taken, in quarter turns in the robot's own directions.
    length : float
        As measured, in metres.
    place : Place
        What the robot sees where it came to, in its own directions.
    sigma : float
        Standard deviation of a length, as a part of the length.

    Returns
    -------
    Belief
        After it: the robot came to the next vertex; or missed that and came to the
        one straight on; or to a place that the map does not have, from which it may
        go back; or it is anywhere. O(V).

    Examples
    --------
    In a room, who came 2.4 m up along the wall on the right stands at its top:

    >>> from behaviours.parameters import Parameters
    >>> from topomap.routes.hall_places import places_of
    >>> from topomap.truth import true_map
    >>> chart = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], Parameters(r0=0.3))
    >>> room = places_of(chart)
    >>> anywhere = {Standing(k, 0): 0.25 for k in range(4)}
    >>> here = moved(room, anywhere, 1, 2.4, room.places[2], 0.02)
    >>> [k.vertex for k, p in here.items() if p > 0.1]
    [2]
    """
    nowhere = math.exp(-length / LONG) / LONG
    anywhere = _anywhere(hall, belief)
    prior = {standing: share * nowhere for standing, share in anywhere.items()}
    for standing, share in belief.items():
        if share < LOST * LOST:
            continue
        for there, density in _ends(hall, standing, quarters, length, sigma):
            prior[there] = prior.get(there, 0.0) + share * density
        if standing.beyond is None:
            aside = Standing(standing.vertex, standing.turn, (quarters, length))
            prior[aside] = share * ASIDE * nowhere
    return _seen(hall, prior, place)


def _ends(
    hall: HallPlaces, standing: Standing, quarters: int, length: float, sigma: float
) -> Iterator[tuple[Standing, float]]:
    """Yield where a way may lead by the map, and how likely its length then is."""
    vertex, turn, beyond = standing
    if beyond is not None:
        exit_, way_back = beyond
        if (quarters - exit_) % 4 == 2:
            off = math.hypot(2 * sigma * way_back, SLIP)
            yield Standing(vertex, turn), _normal(length - way_back, off)
        return
    exit_ = (quarters + turn) % 4
    way = hall.passages.get((vertex, exit_))
    if way is None:
        return
    off = math.hypot(sigma * way.length, way.sigma, SLIP)
    there = Standing(way.vertex, turn)
    yield there, (1 - MISSED) * _normal(length - way.length, off)
    on = hall.passages.get((way.vertex, exit_))
    if on is not None:
        total = way.length + on.length
        off = math.hypot(sigma * total, on.sigma, way.sigma, SLIP)
        yield Standing(on.vertex, turn), MISSED * _normal(length - total, off)


def landed(
    hall: HallPlaces, belief: Belief, shares: dict[int, float], turn: int
) -> Belief:
    """Return the belief of a robot that crossed open space.

    Parameters
    ----------
    hall : HallPlaces
        The map.
    belief : Belief
        Before it.
    shares : dict of int to float
        How probable each vertex is by what the robot reckoned and saw, if it stood
        where it thought; what is missing to 1 is a place that the map does not have.
    turn : int
        As it thinks that it is turned, in quarter turns.
    """
    found = _anywhere(hall, belief)
    _, sure = surest(belief)
    for vertex, share in shares.items():
        found[Standing(vertex, turn)] += sure * share
    total = sum(found.values())
    return {standing: weight / total for standing, weight in found.items()}


def surest(belief: Belief) -> tuple[Standing, float]:
    """Return where the robot most probably stands, and that probability."""
    best = max(belief, key=belief.__getitem__)
    return best, belief[best]


def _seen(hall: HallPlaces, prior: Belief, place: Place) -> Belief:
    """Weigh each hypothesis by what the robot sees."""
    weights = {}
    for standing, share in prior.items():
        if standing.beyond is not None:
            weights[standing] = share * STRANGE
            continue
        known = hall.places[standing.vertex]
        ways = turned(known.ways, standing.turn)
        fits = known.type is place.type and ways == place.ways
        weights[standing] = share * (1.0 - MISSEEN if fits else MISSEEN)
    total = sum(weights.values())
    return {standing: weight / total for standing, weight in weights.items()}


def _anywhere(hall: HallPlaces, belief: Belief) -> Belief:
    """Return where a robot may be that is lost; its heading is mostly right."""
    turns = [0.0] * 4
    for standing, share in belief.items():
        turns[standing.turn] += share
    each = LOST / len(hall.places)
    return {
        Standing(vertex, turn): each * ((1 - TURNED) * share + TURNED / 4)
        for vertex in hall.places
        for turn, share in enumerate(turns)
    }


def _normal(miss: float, spread: float) -> float:
    return math.exp(-0.5 * (miss / spread) ** 2) / (spread * math.sqrt(math.tau))
