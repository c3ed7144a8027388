"""What hypothesis draws: robots, worlds, grids, costs, and spoilt JSON values."""

import json
import math

import numpy as np
from hypothesis import strategies as st

import worlds
from behaviours.parameters import Parameters
from behaviours.vertices import VertexType
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex

__all__ = [
    "charts",
    "parameters",
    "random_worlds",
    "rectilinear_rings",
    "scenes",
    "seeds",
    "spoilt",
    "tables",
]

seeds = st.integers(0, 2**32 - 1)


@st.composite
def parameters(draw):
    """Draw a robot's lengths, r0 from 10 to 40 cm."""
    r0 = draw(st.floats(0.1, 0.4))
    return Parameters(
        r0=r0,
        r_min=r0 * draw(st.floats(0.2, 0.9)),
        r_max=r0 * draw(st.floats(1.1, 2.0)),
        r_w=r0 * draw(st.floats(0.3, 1.0)),
    )


@st.composite
def random_worlds(draw, most_corners=40, most_islands=4, passage=None, spread=0.8):
    """Draw a random rectilinear world."""
    rng = np.random.default_rng(draw(seeds))
    return worlds.make(
        "random",
        rng,
        corners=2 * draw(st.integers(2, most_corners // 2)),
        islands=draw(st.integers(0, most_islands)),
        passage=draw(st.floats(0.05, 2.0)) if passage is None else passage,
        spread=spread,
    )


metres = st.floats(-1e6, 1e6)
lengths = st.builds(Length, st.floats(1e-3, 1e6), st.just(0.0) | st.floats(1e-6, 1e3))


@st.composite
def charts(draw, most=8, placed=None, straight=False):
    """Draw a map that does not contradict itself; few are maps of a building.

    With `straight`, the two ends of an edge leave in opposite directions, as they
    do in a map that can be embedded.
    """
    count = draw(st.integers(0, most))
    ids = draw(
        st.lists(st.integers(-5, 10**9), min_size=count, max_size=count, unique=True)
    )
    exits = [draw(st.lists(st.integers(-5, 6), max_size=5, unique=True)) for _ in ids]
    free = [(row, step) for row, steps in enumerate(exits) for step in steps]
    edges = []
    while len(free) > 1 and draw(st.booleans()):
        row, step = free.pop(draw(st.integers(0, len(free) - 1)))
        fit = [
            (other, back)
            for other, back in free
            if not straight or (other != row and (back - step) % 12 == 6)
        ]
        if not fit:
            break
        other = draw(st.sampled_from(fit))
        free.remove(other)
        edges.append(
            Edge(
                ids[row],
                ids[other[0]],
                math.radians(30 * step),
                math.radians(30 * other[1]),
                tuple(draw(st.lists(lengths, min_size=1, max_size=3))),
                draw(st.sampled_from(["WF", "HF", 'walk <on> & "on"', "été", " "])),
                draw(st.just(0.0) | st.floats(-1, 1)),
                draw(st.none() | st.floats(0, 5)),
            )
        )
    used = {(e.source, e.source_exit) for e in edges} | {
        (e.target, e.target_exit) for e in edges
    }
    vertices = []
    for name, steps in zip(ids, exits, strict=True):
        angles = tuple(math.radians(30 * step) for step in steps)
        has_place = draw(st.booleans()) if placed is None else placed
        vertices.append(
            Vertex(
                name,
                draw(st.sampled_from(VertexType)),
                angles,
                tuple(
                    a for a in angles if (name, a) not in used and draw(st.booleans())
                ),
                draw(st.tuples(metres, metres)) if has_place else None,
                ((1.0, 0.5), (0.5, 2.0)) if draw(st.booleans()) else None,
            )
        )
    robot = Parameters() if draw(st.booleans()) else None
    return TopologicalMap(tuple(vertices), tuple(edges), robot)


@st.composite
def rectilinear_rings(draw, most_corners=30):
    """Draw an outer ring with walls from 5 cm up, among them ill-defined jogs."""
    return draw(random_worlds(most_corners, 0, passage=0.05, spread=0.5)).outer


@st.composite
def scenes(draw, max_side=12, max_robots=5, max_frontiers=6):
    """Draw a grid, robot cells, and frontiers of one to three cells."""
    rows = draw(st.integers(1, max_side))
    columns = draw(st.integers(1, max_side))
    rng = np.random.default_rng(draw(seeds))
    free = rng.random((rows, columns)) > draw(st.sampled_from([0.0, 0.2, 0.4]))
    n = draw(st.integers(1, max_robots))
    m = draw(st.integers(1, max_frontiers))
    robots = np.stack([rng.integers(0, rows, n), rng.integers(0, columns, n)], axis=1)
    frontiers = [
        np.stack([rng.integers(0, rows, k), rng.integers(0, columns, k)], axis=1)
        for k in rng.integers(1, 4, m)
    ]
    return free, robots, frontiers


def tables(max_robots=6, max_frontiers=6, values=None):
    """Return a strategy of tables of costs, with ties and places out of reach."""
    costs = (
        values
        if values is not None
        else st.one_of(
            st.integers(0, 6).map(float), st.just(float("inf")), st.floats(0, 1e6)
        )
    )
    return st.tuples(st.integers(1, max_robots), st.integers(1, max_frontiers)).flatmap(
        lambda shape: st.lists(
            st.lists(costs, min_size=shape[1], max_size=shape[1]),
            min_size=shape[0],
            max_size=shape[0],
        )
    )


@st.composite
def spoilt(draw, text):
    """Draw what is left of a valid JSON text after something has gone wrong."""
    if draw(st.booleans()):
        cut = draw(st.integers(0, len(text) - 1))
        junk = draw(st.binary(max_size=4))
        return (
            text[:cut].encode() + junk + text[cut + draw(st.integers(0, 9)) :].encode()
        )
    value = json.loads(text)
    here, key = value, draw(st.sampled_from(sorted(value)))
    while isinstance(here[key], list | dict) and here[key] and draw(st.booleans()):
        here = here[key]
        keys = sorted(here) if isinstance(here, dict) else range(len(here))
        key = draw(st.sampled_from(list(keys)))
    if draw(st.booleans()):
        del here[key]
    else:
        here[key] = draw(
            st.none()
            | st.booleans()
            | st.integers(-(10**30), 10**30)
            | st.floats()
            | st.text(max_size=3)
            | st.lists(st.floats(), max_size=3)
            | st.dictionaries(st.text(max_size=3), st.integers(), max_size=2)
        )
    return json.dumps(value).encode()
