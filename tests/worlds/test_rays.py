"""The compiled rays go exactly as far as Pymunk's segment queries say."""

import math

import numpy as np
import pymunk
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.worlds.rooms import random_room
from worlds.rays import cast

FAR = 1.5


def pymunk_range(space, x, y, yaw, group):
    end = (x + FAR * math.cos(yaw), y + FAR * math.sin(yaw))
    hit = space.segment_query_first((x, y), end, 0.0, pymunk.ShapeFilter(group=group))
    return math.inf if hit is None else hit.alpha * FAR


@given(st.integers(0, 10**6))
def test_rays_equal_pymunk(seed):
    rng = np.random.default_rng(seed)
    room = random_room(rng, 6)
    ring = room.outer
    walls = np.array([(*a, *b) for a, b in zip(ring, ring[1:] + ring[:1], strict=True)])
    low, high = walls[:, :2].min(axis=0), walls[:, :2].max(axis=0)
    discs = np.column_stack([rng.uniform(low, high, (5, 2)), np.full(5, 0.1)])
    space = pymunk.Space()
    for x0, y0, x1, y1 in walls.tolist():
        space.add(pymunk.Segment(space.static_body, (x0, y0), (x1, y1), 0.0))
    for k, (x, y, radius) in enumerate(discs.tolist()):
        body = pymunk.Body(1, 1)
        body.position = x, y
        circle = pymunk.Circle(body, radius)
        circle.filter = pymunk.ShapeFilter(group=k + 1)
        space.add(body, circle)
    space.step(1e-12)
    x, y, heading = *discs[0, :2], rng.uniform(-4, 4)
    yaws = np.linspace(-3, 3, 16)
    table = np.array([(k, 0.0, 0.0, yaw, FAR) for k, yaw in enumerate(yaws)])
    ranges = np.empty(16)
    cast(x, y, heading, table, walls, discs, 0, ranges)
    expected = [pymunk_range(space, x, y, heading + yaw, 1) for yaw in yaws]
    near = np.hypot(*(discs[1:, :2] - discs[0, :2]).T) > 0.1
    if near.all():  # from within a disc Pymunk sees its inside
        np.testing.assert_allclose(ranges, expected, atol=1e-9)


def test_a_ranger_sees_the_harmonic_mean_of_its_lit_rays():
    walls = np.array([[1.0, -1.0, 1.0, 0.0]])
    rays = np.array([(0, 0.0, 0.0, yaw, 5.0) for yaw in (-0.5, -0.1, 0.5)])
    ranges = np.empty(1)
    cast(0.0, 0.0, 0.0, rays, walls, np.zeros((0, 3)), 0, ranges)
    assert ranges[0] == pytest.approx(2 / (math.cos(0.5) + math.cos(0.1)))


def test_a_robot_does_not_see_itself_but_another():
    discs = np.array([[0.0, 0.0, 0.1], [1.0, 0.0, 0.1]])
    rays = np.array([(0, 0.0, 0.0, 0.0, 5.0)])
    ranges = np.empty(1)
    cast(0.0, 0.0, 0.0, rays, np.zeros((0, 4)), discs, 0, ranges)
    assert ranges[0] == pytest.approx(0.9)
