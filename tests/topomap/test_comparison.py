"""Comparison: the same map turned, moved or renumbered is the same map."""

import math
from dataclasses import replace

import numpy as np
import pytest

from behaviours import Parameters, VertexType
from topomap.comparison import compare_maps
from topomap.directions import same_direction
from topomap.truth import true_map

ROBOT = Parameters()
ROOM = [(0, 0), (5, 0), (5, 2), (2, 2), (2, 4), (0, 4)]


def turned(chart, angle):
    def turn(exits):
        return tuple(math.remainder(e + angle, math.tau) for e in exits)

    def place(position):
        x, y = position
        c, s = math.cos(angle), math.sin(angle)
        return c * x - s * y + 3, s * x + c * y - 1

    vertices = tuple(
        replace(v, id=100 - v.id, exits=turn(v.exits), position=place(v.position))
        for v in reversed(chart.vertices)
    )
    edges = tuple(
        replace(
            e,
            source=100 - e.source,
            target=100 - e.target,
            source_exit=e.source_exit + angle,
            target_exit=e.target_exit + angle,
        )
        for e in chart.edges
    )
    return replace(chart, vertices=vertices, edges=edges)


@pytest.mark.parametrize("degrees", [0, 33, 90, 180, 271])
def test_a_turned_and_renumbered_map_is_the_same(degrees):
    truth = true_map(ROOM, ROBOT)
    found = compare_maps(turned(truth, math.radians(degrees)), truth)
    assert found.correct
    assert found.position_rmse == pytest.approx(0, abs=1e-9)
    assert same_direction(found.rotation, -math.radians(degrees))
    assert dict(found.pairs) == {100 - v.id: v.id for v in truth.vertices}


def test_a_mirrored_map_is_another():
    mirrored = [(-x, y) for x, y in reversed(ROOM)]
    long_leg = true_map(
        [(0, 0), (9, 0), (9, 1), (2, 1), (2, 3), (5, 3), (5, 5), (0, 5)], ROBOT
    )
    other = true_map(
        [
            (-x, y)
            for x, y in reversed(
                [(0, 0), (9, 0), (9, 1), (2, 1), (2, 3), (5, 3), (5, 5), (0, 5)]
            )
        ],
        ROBOT,
    )
    # An L is its own mirror image as a graph; a C with unequal arms is as well,
    # since only types count: the sequence of turns read backwards must differ.
    assert compare_maps(true_map(mirrored, ROBOT), true_map(ROOM, ROBOT)).correct
    assert compare_maps(other, long_leg).correct
    zigzag = [
        (0, 0),
        (9, 0),
        (9, 4),
        (6, 4),
        (6, 2),
        (4, 2),
        (4, 6),
        (2, 6),
        (2, 8),
        (0, 8),
    ]
    flipped = [(-x, y) for x, y in reversed(zigzag)]
    assert not compare_maps(true_map(flipped, ROBOT), true_map(zigzag, ROBOT)).correct


def test_a_changed_type_is_found_and_counted():
    truth = true_map(ROOM, ROBOT)
    wrong = replace(
        truth,
        vertices=(
            replace(truth.vertices[0], type=VertexType.TERM),
            *truth.vertices[1:],
        ),
    )
    found = compare_maps(wrong, truth)
    assert not found.correct
    assert (found.missing_vertices, found.extra_vertices) == (1, 1)


def test_two_laps_taken_for_one_loop_have_a_lap_too_much():
    truth = true_map([(0, 0), (3, 0), (3, 2), (0, 2)], ROBOT)
    count = len(truth.vertices)
    again = tuple(replace(v, id=v.id + count) for v in truth.vertices)
    edges = tuple(
        replace(truth.edges[k % count], source=k, target=(k + 1) % (2 * count))
        for k in range(2 * count)
    )
    found = compare_maps(
        replace(truth, vertices=truth.vertices + again, edges=edges), truth
    )
    assert not found.correct
    assert found.extra_vertices == count


def test_of_several_references_the_best_counts():
    room, other = (
        true_map(ROOM, ROBOT),
        true_map([(0, 0), (3, 0), (3, 2), (0, 2)], ROBOT),
    )
    assert compare_maps(room, other, room).correct


def test_nothing_to_compare_with_is_refused():
    with pytest.raises(ValueError, match="at least one reference"):
        compare_maps(true_map(ROOM, ROBOT))


def test_position_error_is_measured_after_the_best_rigid_motion():
    truth = true_map(ROOM, ROBOT)
    rng = np.random.default_rng(5)
    shaken = replace(
        truth,
        vertices=tuple(
            replace(v, position=tuple(np.add(v.position, rng.normal(0, 0.1, 2))))
            for v in truth.vertices
        ),
    )
    far = turned(shaken, 1.0)
    near = compare_maps(shaken, truth).position_rmse
    assert compare_maps(far, truth).position_rmse == pytest.approx(near)
    assert 0.03 < near < 0.2
