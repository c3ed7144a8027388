"""The physical body against a bare Pymunk loop with the same steps and rays."""

import math
import time

import numpy as np
import pymunk

from behaviours.port import Align, Follow, Side
from worlds.arena import Arena
from worlds.physical import PhysicalBody
from worlds.pose import Pose
from worlds.profiles import GENERIC
from worlds.sensors import ray_table
from worlds.world import make_world

HALL = make_world([(0, 0), (30, 0), (30, 3), (0, 3)])


def bare_loop(ticks, dt, looks):
    """Step a robot along the hall and cast its rays `looks` times; no more."""
    space = pymunk.Space()
    ring = HALL.outer
    for a, b in zip(ring, ring[1:] + ring[:1], strict=True):
        space.add(pymunk.Segment(space.static_body, a, b, 0.0))
    body = pymunk.Body(1.0, 1.0)
    body.position, body.velocity = (1.0, 0.3), (0.2, 0.0)
    circle = pymunk.Circle(body, GENERIC.radius)
    circle.filter = own = pymunk.ShapeFilter(group=1)
    space.add(body, circle)
    rays = [
        (x, y, x + far * math.cos(yaw), y + far * math.sin(yaw))
        for _, x, y, yaw, far in ray_table(GENERIC.rangers).tolist()
    ]
    every = ticks / looks
    due = 0.0
    for tick in range(ticks):
        space.step(dt)
        if tick >= due:
            due += every
            px, py = body.position
            c, s = math.cos(body.angle), math.sin(body.angle)
            for x0, y0, x1, y1 in rays:
                start = (px + c * x0 - s * y0, py + s * x0 + c * y0)
                end = (px + c * x1 - s * y1, py + s * x1 + c * y1)
                space.segment_query_first(start, end, 0.0, own)


def test_physical_body_keeps_up_with_a_bare_loop(benchmark):
    def both():
        arena = Arena(HALL)
        body = PhysicalBody(arena, Pose(1, 0.3), GENERIC, np.random.default_rng(1))
        body.execute(Align(Side.RIGHT))
        begun, first = time.perf_counter(), arena.ticks
        body.execute(Follow())
        ours, ticks = time.perf_counter() - begun, arena.ticks - first
        begun = time.perf_counter()
        looks = round(ticks * arena.time_step / GENERIC.update_period)
        bare_loop(ticks, arena.time_step, looks)
        theirs = time.perf_counter() - begun
        return theirs / ours, ticks * arena.time_step / ours

    runs = []
    benchmark.pedantic(lambda: runs.append(both()), rounds=7, warmup_rounds=1)
    benchmark.extra_info["speed against bare loop"] = float(np.median(runs, axis=0)[0])
    benchmark.extra_info["times real time"] = float(np.median(runs, axis=0)[1])
