"""The ideal body and the mapper beside the ray casts alone, made by shapely."""

import numpy as np
import pytest
import shapely

import worlds
from behaviours import Parameters, run
from topomap.boundary import map_boundary
from topomap.closers import make_closer
from topomap.folding import fold
from worlds.ideal import IdealBody
from worlds.starts import choose_start

ROBOT = Parameters()
COUNT = 50


def scenes():
    for seed in range(COUNT):
        rng = np.random.default_rng(seed)
        world = worlds.make("random", rng, corners=20)
        yield world, choose_start(world, ROBOT, rng)


SCENES = list(scenes())


class Counting(IdealBody):
    """An ideal body that counts what it is asked to do."""

    count = 0

    def execute(self, primitive):
        Counting.count += 1
        return super().execute(primitive)


def build_all(body):
    for world, start in SCENES:
        robot = body(world, start, ROBOT, np.random.default_rng(1), 0.0)
        walk = run(
            map_boundary(ROBOT, make_closer("likelihood", 0.0, ROBOT, slip=0.0), 500),
            robot,
        )
        fold(walk, ROBOT, 0.0)


@pytest.mark.benchmark(group="50 maps of 20 corners, exact lengths")
def test_ideal_body_and_mapper(benchmark):
    build_all(IdealBody)
    benchmark.pedantic(build_all, (IdealBody,), rounds=7)
    benchmark.extra_info["maps_per_second"] = COUNT / benchmark.stats["median"]


@pytest.mark.benchmark(group="50 maps of 20 corners, exact lengths")
def test_rival_three_rays_a_primitive_by_shapely(benchmark):
    build_all(Counting)
    world, start = SCENES[0]
    walls = shapely.LinearRing(world.outer)
    origin = shapely.Point(start.x, start.y)
    rays = [
        shapely.LineString([(start.x, start.y), (start.x + 99 * c, start.y + 99 * s)])
        for c, s in ((1, 0), (0, 1), (0, -1))
    ]

    def cast_all():
        for _ in range(Counting.count):
            for ray in rays:
                shapely.distance(origin, shapely.intersection(ray, walls))

    benchmark.pedantic(cast_all, rounds=7)
