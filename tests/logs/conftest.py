"""Runs that were logged, made once."""

import numpy as np
import pytest

import worlds
from topomap.logs.building import build_logged


@pytest.fixture(scope="session")
def logged(tmp_path_factory):
    """Return a world, a log of each body's run in it, and what was built."""
    folder = tmp_path_factory.mktemp("logs")
    world = worlds.make("l", np.random.default_rng(1))
    runs = {}
    for body in ("ideal", "physical"):
        path = folder / f"{body}.mcap"
        closing = "likelihood-full-lap"
        runs[body] = (
            path,
            build_logged(
                world, np.random.default_rng(7), path, body=body, closing=closing
            ),
        )
    return world, runs
