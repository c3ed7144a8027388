"""EXPLORE maps worlds of rooms and halls as they are, and to the end."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import worlds
from behaviours import Parameters
from behaviours.opposite import opposite
from behaviours.port import Approach, Move, Outcome, Readings, Reason, Side, run
from behaviours.probe import probe
from behaviours.travel import travel
from behaviours.vertices import VertexType
from tests.worlds.hall_class import census
from topomap import base_loops, build_map, compare_maps, walking
from topomap.closers import make_closer
from topomap.errors import InputError, JobError
from topomap.hall_loops import _without_straight
from topomap.hall_truth import true_hall_maps
from topomap.truth import true_map, true_maps
from worlds.errors import WorldError
from worlds.ideal import IdealBody
from worlds.pose import Pose
from worlds.world import make_world

ROBOT = Parameters()
SEEDS = st.integers(0, 2**32 - 1)
KINDS = st.sampled_from(["rooms", "halls", "maze", "office", "hospital"])
SETTINGS = settings(max_examples=8, deadline=None)


def union(*boxes):
    """Return the world inside of all these boxes."""
    area = shapely.union_all([shapely.box(*box) for box in boxes]).normalize()
    rings = [list(ring.coords)[:-1] for ring in (area.exterior, *area.interiors)]
    return make_world(rings[0], rings[1:])


TWO_ROOMS = union(
    (0, 0, 4, 3),
    (4, 1, 7, 1.5),
    (5, 1.5, 5.5, 3),
    (7, 0, 10, 4),
    (1, 3, 1.5, 4.5),
    (1, 4.5, 9, 5),
    (8.5, 4, 9, 5),
    (3.5, -1, 4, 0),
)
"""Rooms joined by two halls, one with a dead end; one opens at a corner of a room."""


def a_world(kind, seed):
    return worlds.make(kind, np.random.default_rng(seed))


@SETTINGS
@given(kind=KINDS, seed=SEEDS)
def test_without_noise_the_map_is_the_truth_to_the_last_exit(kind, seed):
    world = a_world(kind, seed)
    built = build_map(world, np.random.default_rng(seed), sigma=0.0)
    assert built.correct
    assert built.map.unexplored_exits == 0
    assert built.comparison.position_rmse < 0.05
    assert built.collisions == 0


@settings(max_examples=4, deadline=None)
@given(seed=SEEDS)
def test_with_noise_places_are_recognised(seed):
    world = a_world("rooms", seed)
    built = build_map(world, np.random.default_rng(seed), sigma=0.06)
    assert built.correct
    assert all(0 <= p <= 1 for r in built.recognitions for _, p in r.candidates)


@settings(max_examples=4, deadline=None)
@given(kind=KINDS, seed=SEEDS)
def test_the_same_seed_gives_the_same_bits(kind, seed):
    one, other = (
        build_map(a_world(kind, seed), np.random.default_rng(seed), sigma=0.1)
        for _ in range(2)
    )
    assert one.map == other.map
    assert one.travelled == other.travelled
    assert one.recognitions == other.recognitions


def test_a_wall_walked_backwards_before_its_loop_is_not_put_in_twice():
    built = build_map(a_world("maze", 1), np.random.default_rng(1), sigma=0.1)
    assert built.correct


@SETTINGS
@given(kind=KINDS, seed=SEEDS)
def test_each_opening_has_one_split_on_each_side(kind, seed):
    world = a_world(kind, seed)
    mouths = sum(
        end.kind == "room" for hall in census(world).halls for end in hall.ends
    )
    truth = true_maps(world, ROBOT)
    vertices = [vertex for chart in truth for vertex in chart.vertices]
    enters = [e for chart in truth for e in chart.edges if e.behaviour == "ENTER"]
    assert sum(vertex.type is VertexType.PORTAL for vertex in vertices) == mouths
    assert len({edge.target for edge in enters}) == len(enters) == mouths


@SETTINGS
@given(kind=KINDS, seed=SEEDS)
def test_no_vertex_is_nearer_than_r_min_to_a_wall(kind, seed):
    world = a_world(kind, seed)
    walls = world.free_space.boundary
    for chart in true_maps(world, ROBOT):
        places = shapely.points([vertex.position for vertex in chart.vertices])
        assert shapely.distance(places, walls).min() >= ROBOT.r_min - 1e-6


@SETTINGS
@given(kind=KINDS, seed=SEEDS)
def test_turns_around_each_loop_sum_to_a_full_turn(kind, seed):
    built = build_map(a_world(kind, seed), np.random.default_rng(seed), sigma=0.0)
    for walk in built.loops:
        graph = built.map.graph
        assert graph.number_of_nodes() >= walk.period
    wall_edges = [e for e in built.map.edges if e.behaviour == "WF"]
    for start in {e.source for e in wall_edges}:
        turned, edge = 0.0, next(e for e in wall_edges if e.source == start)
        first = edge
        while True:
            after = next(e for e in wall_edges if e.source == edge.target)
            turned += math.remainder(after.source_exit - edge.source_exit, math.tau)
            edge = after
            if edge is first:
                break
        assert abs(turned) == pytest.approx(math.tau)


@SETTINGS
@given(kind=KINDS, seed=SEEDS, turn=st.integers(0, 3), mirror=st.booleans())
def test_a_turned_or_mirrored_world_has_the_turned_or_mirrored_truth(
    kind, seed, turn, mirror
):
    world = a_world(kind, seed)
    c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[turn]
    sign = -1 if mirror else 1

    def moved(point):
        x, y = point[0], sign * point[1]
        return c * x - s * y, s * x + c * y

    other = make_world(*(moved_rings(world, moved)))
    there = {
        (v.type, *(round(a, 4) + 0.0 for a in moved(v.position)))
        for chart in true_maps(world, ROBOT)
        for v in chart.vertices
    }
    here = {
        (v.type, *(round(a, 4) + 0.0 for a in v.position))
        for chart in true_maps(other, ROBOT)
        for v in chart.vertices
    }
    assert here == there
    built = build_map(other, np.random.default_rng(seed), sigma=0.0)
    assert built.correct


def moved_rings(world, move):
    outer, *islands = [[move(point) for point in ring] for ring in world.rings]
    return outer, islands


def test_a_known_world_of_halls():
    (truth,) = true_maps(TWO_ROOMS, ROBOT)
    kinds = [vertex.type for vertex in truth.vertices]
    assert {kind.name: kinds.count(kind) for kind in set(kinds)} == {
        "INT": 7,
        "SPLIT": 8,
        "PORTAL": 5,
        "TERM": 2,
    }
    built = build_map(TWO_ROOMS, np.random.default_rng(1), sigma=0.0)
    assert built.correct
    assert {edge.behaviour for edge in built.map.edges} == {"WF", "HF", "ENTER"}


@pytest.mark.parametrize("widths", [(0.57, 0.43), (0.43, 0.57)])
def test_two_openings_side_by_side_are_two_splits(widths):
    first, second = widths
    middle = 1 + first / 2 + 0.85
    world = union(
        (0, 0, 4, 3),
        (1, -2, 1 + first, 0),
        (middle - second / 2, -2, middle + second / 2, 0),
    )
    assert build_map(world, np.random.default_rng(1), sigma=0.0).correct


def test_an_open_world_has_the_same_truth_from_both_constructions():
    room = make_world([(0, 0), (5, 0), (5, 2), (2, 2), (2, 4), (0, 4)])
    (halls,) = true_hall_maps(room, ROBOT)
    found = compare_maps(halls, true_map(room.outer, ROBOT))
    assert found.correct
    assert found.position_rmse < 1e-6


def test_small_openings_in_corners_are_found():
    robot = Parameters(r0=0.3, r_min=0.08, r_max=0.5, r_w=0.1)
    world = union((0, 0, 3, 3), (3, 0, 5, 0.25), (5, 0, 5.25, 2), (2.75, 3, 3, 4))
    built = build_map(world, np.random.default_rng(2), sigma=0.0, parameters=robot)
    assert built.correct
    types = [vertex.type.name for vertex in built.map.vertices]
    assert types.count("PORTAL") == 2


def test_a_robot_set_down_before_a_mouth_begins_in_the_hall():
    built = build_map(
        TWO_ROOMS, np.random.default_rng(1), sigma=0.0, start=Pose(2.0, 1.25, 0.0)
    )
    assert built.correct
    assert built.map.vertices[0].type is not VertexType.INT


@settings(max_examples=20, deadline=None)
@given(sigma=st.floats(0, 0.2), seed=SEEDS, x=st.floats(0.4, 1.2))
def test_probing_returns_to_where_it_began(sigma, seed, x):
    body = IdealBody(
        union((0, 0, 6, 3), (2, -2, 2.5, 0), (3.2, -2, 3.5, 0)),
        Pose(x, 0.3, 0.0),
        ROBOT,
        np.random.default_rng(seed),
        sigma,
    )
    found = run(probe(ROBOT, Side.RIGHT, 4.0), body)
    assert body.pose == pytest.approx((x, 0.3, 0.0))
    assert [opening.type.name for _, opening in found] == ["SPLIT", "ILL"]


def test_the_wall_opposite_is_examined_and_left_again():
    world = union((0, 0, 6, 0.5), (2, -2, 2.5, 0), (2, 0.5, 2.5, 2), (6, -1, 8, 2))
    body = IdealBody(world, Pose(2.25, 0.25, 0.0), ROBOT, np.random.default_rng(1))
    found = run(opposite(ROBOT, Side.RIGHT, 0.5), body)
    assert body.pose == pytest.approx((2.25, 0.25, 0.0))
    ((begin, opening),) = found
    assert (begin, opening.width) == pytest.approx((0.0, 0.5))


@pytest.mark.parametrize(
    ("boxes", "says"),
    [
        # An opening that begins 10 cm from a corner of the room.
        (((0, 0, 3, 3), (3, 0.1, 5, 0.6)), "from the corner beside it"),
        # A crossing whose halls are shifted against each other.
        (
            ((0, 0, 2, 2), (2, 0.8, 6, 1.3), (4, 1.3, 4.5, 3), (4.3, -1, 4.8, 0.8)),
            "junction at .* 0.8 m wide; expected at most 0.6 m",
        ),
    ],
)
def test_what_is_too_intricate_is_refused_with_its_place(boxes, says):
    with pytest.raises(WorldError, match=says):
        true_maps(union(*boxes), ROBOT)


def test_a_point_where_a_wall_goes_straight_on_is_no_corner():
    square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]
    assert _without_straight([square[0], (1.0, 1e-8), *square[1:]]) == square
    assert _without_straight([(0.0, 1.0), *square]) == square


def test_walls_run_out_is_no_closed_map():
    built = build_map(TWO_ROOMS, np.random.default_rng(1), sigma=0.0, max_walls=9)
    assert not built.closed
    assert not built.correct


def test_sigma_is_checked_before_anything_else():
    with pytest.raises(InputError, match="sigma"):
        build_map(TWO_ROOMS, np.random.default_rng(1), sigma=math.nan)


class Hasty:
    """A loop closer that takes its first loop for one of so many walls."""

    def __init__(self, period):
        self.period = period
        self.closer = make_closer("likelihood", 0.0, ROBOT, slip=0.0)

    def begin(self, kind, turn):
        self.closer.begin(kind, turn)
        self.walls = 0

    def observe(self, wall):
        decision = self.closer.observe(wall)
        self.walls += 1
        if decision.period:
            self.period = None
        if self.period and self.walls >= self.period:
            return replace(decision, period=self.period)
        return decision


@pytest.mark.parametrize("period", [2, 4, 6])
def test_a_closure_that_does_not_fit_the_place_is_not_acted_on(period):
    built = build_map(
        TWO_ROOMS, np.random.default_rng(1), sigma=0.0, closing=Hasty(period)
    )
    assert built.correct
    assert built.refuted == ()


class Bumping:
    """A body that now and then touches something on its way, and draws back."""

    def __init__(self, body, every):
        self.body = body
        self.every = every
        self.asked = 0
        self.bumps = 0

    def __getattr__(self, name):
        return getattr(self.body, name)

    def execute(self, primitive):
        self.asked += 1
        if self.asked % self.every:
            return self.body.execute(primitive)
        self.bumps += 1
        part = Outcome(0.0, Reason.DONE, Readings())
        if isinstance(primitive, Move):
            part = replace(primitive, distance=primitive.distance / 3)
            part = self.body.execute(part)
        elif isinstance(primitive, Approach):
            limit = min(primitive.limit / 3, 0.1)
            part = self.body.execute(replace(primitive, limit=limit))
        return (
            replace(part, reason=Reason.BUMPED) if part.reason is Reason.DONE else part
        )


@pytest.mark.parametrize(("kind", "every"), [("halls", 3), ("rooms", 5), ("maze", 2)])
def test_a_robot_that_bumps_builds_the_map_of_one_that_does_not(kind, every):
    world = worlds.make(kind, np.random.default_rng(3))
    bodies = []

    def watch(body):
        bodies.append(Bumping(body, every))
        return bodies[0]

    smooth, bumpy = (
        build_map(world, np.random.default_rng(7), sigma=0.0, watch=how)
        for how in (None, watch)
    )
    assert bodies[0].bumps > 50
    assert bumpy.correct
    assert compare_maps(bumpy.map, smooth.map).correct
    assert bumpy.travelled == pytest.approx(smooth.travelled)


def test_a_robot_that_is_stuck_while_it_looks_round_says_so():
    class Stuck:
        def __init__(self, body):
            self.parameters = body.parameters

        def execute(self, _):
            return Outcome(0.0, Reason.STUCK, Readings())

    world = worlds.make("halls", np.random.default_rng(3))
    with pytest.raises(JobError, match=r"State.LOOK has no arrow for stuck"):
        build_map(world, np.random.default_rng(0), watch=Stuck)


@pytest.mark.parametrize("slips_at", [25, 29, 31])
def test_a_map_that_is_refuted_is_unfolded_and_the_robot_goes_on(monkeypatch, slips_at):
    """One edge is measured 3 m too long; another walk along it tells."""
    walked = 0

    def travelled(*args):
        nonlocal walked
        walked += 1
        off = 3.0 if walked == slips_at else 0.0
        arrival = yield from travel(*args)
        return replace(arrival, length=arrival.length + off)

    monkeypatch.setattr(walking, "travel", travelled)
    built = build_map(TWO_ROOMS, np.random.default_rng(1), sigma=0.0, max_walls=150)
    assert len(built.refuted) == 1
    assert "was expected" in built.refuted[0]
    assert built.correct
    assert built.map.unexplored_exits == 0


class Late(Hasty):
    """A loop closer that says of one loop that it begins at v_3."""

    def __init__(self, loop):
        super().__init__(None)
        self.loop = loop

    def begin(self, kind, turn):
        super().begin(kind, turn)
        self.loop -= 1
        self.laps = 4 if self.loop == 0 else 0

    def observe(self, wall):
        decision = self.closer.observe(wall)
        if decision.period and self.laps > 0:
            self.laps -= 1
            if self.laps == 0:
                return replace(decision, start=3, reason="it slipped")
            return replace(decision, period=None)
        return decision


@pytest.mark.parametrize("loop", [1, 2, 3])
def test_a_loop_that_begins_later_is_joined_where_the_robot_came_to_it(loop):
    built = build_map(
        TWO_ROOMS, np.random.default_rng(1), sigma=0.0, closing=Late(loop)
    )
    assert built.refuted == ()
    assert built.correct


@pytest.mark.parametrize("loop", [1, 2])
def test_where_that_cannot_be_told_the_map_is_begun_anew(monkeypatch, loop):
    monkeypatch.setattr(base_loops, "find_entry", lambda *_: None)
    built = build_map(
        TWO_ROOMS, np.random.default_rng(1), sigma=0.0, closing=Late(loop)
    )
    assert built.refuted == ("it slipped",)
    assert built.correct
