"""Grids, robots and frontiers to draw from."""

import numpy as np
from hypothesis import strategies as st


@st.composite
def scenes(draw, max_side=12, max_robots=5, max_frontiers=6):
    """Return a grid, robot cells, and frontiers of one to three cells."""
    rows = draw(st.integers(1, max_side))
    columns = draw(st.integers(1, max_side))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
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
