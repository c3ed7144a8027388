"""Buildings for the tests of teams: small, with rooms and halls."""

from functools import cache

import numpy as np

import worlds


@cache
def building(seed=1):
    """Return a building of about 55 vertices."""
    return worlds.make("rooms", np.random.default_rng(seed))
