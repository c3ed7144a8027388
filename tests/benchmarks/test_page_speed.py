"""How large a page is, and how soon it is drawn in a headless browser."""

import statistics
from functools import cache

import numpy as np
import pytest

import worlds
from tests.page.conftest import Browser, driver  # noqa: F401 - a fixture
from tests.page.runs import grid_map
from topomap.mapping import build_map
from topomap.page import record_build, recording_of_map, render_page, save_page

ROUNDS = 7
PAINTS = (
    "return [performance.getEntriesByName('first-contentful-paint')[0].startTime,"
    "performance.getEntriesByName('drawn')[0].startTime]"
)


@cache
def hall():
    return worlds.make("random", np.random.default_rng(7), corners=200)


@cache
def runs():
    """Return what is shown, by name."""
    rng = np.random.default_rng(1)
    return {
        "200-vertex run, physical": record_build(hall(), rng, body="physical")[1],
        "10,000-vertex map": recording_of_map(grid_map(100)),
    }


@pytest.mark.parametrize("name", ["200-vertex run, physical", "10,000-vertex map"])
def test_time_to_first_paint(benchmark, driver, tmp_path, name):  # noqa: F811
    page = tmp_path / "run.html"
    save_page(runs()[name], page)
    browser = Browser(driver)

    def load():
        assert browser.open(page) == []
        return browser.run(PAINTS)

    paints = [load() for _ in range(ROUNDS)]
    first, drawn = (statistics.median(times) for times in zip(*paints, strict=True))
    benchmark.extra_info |= {
        "KB": page.stat().st_size // 1024,
        "first paint, ms": round(first),
        "drawn, ms": round(drawn),
    }
    benchmark.pedantic(load, rounds=1)
    print(name, benchmark.extra_info)


def test_what_looking_on_costs(benchmark):
    def alone():
        return build_map(hall(), np.random.default_rng(1), body="physical")

    def watched():
        return record_build(hall(), np.random.default_rng(1), body="physical")[1]

    alone(), watched()
    benchmark.pedantic(watched, rounds=3)
    recorded = benchmark.stats.stats.median
    import time

    times = []
    for _ in range(3):
        began = time.perf_counter()
        alone()
        times.append(time.perf_counter() - began)
    benchmark.extra_info["times the build alone"] = round(
        recorded / statistics.median(times), 2
    )
    run = watched()
    began = time.perf_counter()
    text = render_page(run)
    benchmark.extra_info["page, s"] = round(time.perf_counter() - began, 3)
    benchmark.extra_info["KB"] = len(text) // 1024
    print(benchmark.extra_info)
