"""Teams of physical robots against a bare Pymunk loop with the same steps and rays."""

import math
import time

import numpy as np
import pymunk
import pytest

from behaviours.port import Align, Follow, Side
from worlds.arena import Arena
from worlds.crew_body import CrewBody
from worlds.pose import Pose
from worlds.profiles import GENERIC
from worlds.sensors import ray_table
from worlds.world import make_world

LONG = make_world([(0, 0), (60, 0), (60, 3), (0, 3)])
SPACING = 3.5
TICKS = 500


def bare_loop(robots, dt, every):
    """Step robots along the wall and cast their rays; no more."""
    space = pymunk.Space()
    ring = LONG.outer
    for a, b in zip(ring, ring[1:] + ring[:1], strict=True):
        space.add(pymunk.Segment(space.static_body, a, b, 0.0))
    bodies = []
    for k in range(robots):
        body = pymunk.Body(1.0, 1.0)
        body.position, body.velocity = (1.0 + SPACING * k, 0.3), (0.2, 0.0)
        circle = pymunk.Circle(body, GENERIC.radius)
        circle.filter = pymunk.ShapeFilter(group=k + 1)
        space.add(body, circle)
        bodies.append((body, circle.filter))
    rays = [
        (x, y, x + far * math.cos(yaw), y + far * math.sin(yaw))
        for _, x, y, yaw, far in ray_table(GENERIC.rangers).tolist()
    ]
    due = 0.0
    for tick in range(TICKS):
        space.step(dt)
        if tick < due:
            continue
        due += every
        for body, own in bodies:
            px, py = body.position
            c, s = math.cos(body.angle), math.sin(body.angle)
            for x0, y0, x1, y1 in rays:
                start = (px + c * x0 - s * y0, py + s * x0 + c * y0)
                end = (px + c * x1 - s * y1, py + s * x1 + c * y1)
                space.segment_query_first(start, end, 0.0, own)


def crew(robots):
    """Return an arena and robots in it that follow its long wall."""
    arena, signals = Arena(LONG), []
    bodies = []
    for k in range(robots):
        rng = np.random.default_rng(k)
        start = Pose(1.0 + SPACING * k, 0.3)
        bodies.append(CrewBody(arena, signals, start, GENERIC, rng))
    for primitive in (Align(Side.RIGHT), Follow()):
        for body in bodies:
            body.begin(primitive)
        rest = set(bodies)
        while rest and isinstance(primitive, Align):
            rest -= {body for body in rest if body.poll() is not None}
            arena.step()
    return arena, bodies


@pytest.mark.parametrize("robots", [1, 4, 16])
def test_crew_keeps_up_with_a_bare_loop(benchmark, robots):
    def both():
        arena, bodies = crew(robots)
        begun = time.process_time()
        for _ in range(TICKS):
            for body in bodies:
                body.poll()
            arena.step()
        ours = time.process_time() - begun
        begun = time.process_time()
        bare_loop(robots, arena.time_step, GENERIC.update_period / arena.time_step)
        theirs = time.process_time() - begun
        return theirs / ours, TICKS * arena.time_step / ours

    runs = []
    benchmark.pedantic(lambda: runs.append(both()), rounds=7, warmup_rounds=1)
    ratio, pace = np.median(runs, axis=0)
    benchmark.extra_info["speed against bare loop"] = float(ratio)
    benchmark.extra_info["times real time"] = float(pace)
