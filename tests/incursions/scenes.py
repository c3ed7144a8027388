"""Worlds, their maps, and what geometry says of an incursion in the true world."""

import math

import numpy as np
import shapely

import worlds
from topomap.incursions.candidates import Options
from topomap.incursions.errors import Drift

__all__ = ["EXACT", "NOISY", "random_world", "straight_way", "true_landing"]

EXACT = Options()
NOISY = Options(Drift(0.06, turn=0.02, heading=0.02, bend=0.01, stand=0.03))


def random_world(seed, corners=12, islands=0):
    rng = np.random.default_rng(seed)
    return worlds.make("random", rng, corners=corners, islands=islands)


def straight_way(chart, edge, comparison):
    """Return the straight part of an incursion in the world, by the map's own places."""
    places = {v.id: np.array(v.position) for v in chart.vertices}
    c, s = math.cos(comparison.rotation), math.sin(comparison.rotation)
    turn = np.array([[c, -s], [s, c]])
    start = turn @ places[edge.source] + comparison.offset
    phi = edge.source_exit + comparison.rotation
    end = start + edge.reach * np.array([math.cos(phi), math.sin(phi)])
    return shapely.LineString([start, end])


def true_landing(world, place, phi):
    """Return where a point that goes straight from a place meets a wall."""
    far = np.array(place) + 1e3 * np.array([math.cos(phi), math.sin(phi)])
    walls = shapely.MultiLineString([[*ring, ring[0]] for ring in world.rings])
    hit = shapely.LineString([place, far]).intersection(walls)
    points = shapely.get_coordinates(hit)
    return min(points.tolist(), key=lambda p: math.dist(p, place))
