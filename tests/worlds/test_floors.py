"""Worlds with halls: in their class, and what their options say."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import worlds
from tests.strategies import seeds
from tests.worlds.hall_class import census, check_space
from worlds.floors.floor import nodes_of, runs, step
from worlds.floors.lengths import PITCH
from worlds.floors.weaving import lattice, woven
from worlds.world import make_world

FLOORS = ("rooms", "halls", "maze", "office", "hospital")
PLAIN = {"cuts": 0, "islands": 0, "pillars": 0}
shares = st.sampled_from([0.0, 0.3, 1.0])
styles = st.fixed_dictionaries(
    {
        "room": st.floats(1.5, 5),
        "hall": st.floats(0, 2),
        "variation": st.floats(0, 0.9),
        **dict.fromkeys(("changes", "corners", "cuts", "islands", "pillars"), shares),
    }
)


def made(kind, seed, **options):
    return worlds.make(kind, np.random.default_rng(seed), **options)


@pytest.mark.parametrize("kind", FLOORS)
@given(seeds)
@settings(max_examples=12, deadline=None)
def test_floors_are_in_their_class(kind, seed):
    world = made(kind, seed)
    census(world)
    check_space(world)


@pytest.mark.parametrize("kind", FLOORS)
@given(seeds, styles)
@settings(max_examples=12, deadline=None)
def test_floors_of_any_style_are_in_their_class(kind, seed, style):
    world = made(kind, seed, **style)
    census(world)
    check_space(world)


@given(seeds, st.integers(1, 12), st.integers(0, 4))
@settings(max_examples=20, deadline=None)
def test_rooms_are_as_many_as_asked_for(seed, rooms, loops):
    for kind in ("rooms", "office"):
        assert len(census(made(kind, seed, rooms=rooms, **PLAIN)).rooms) == rooms
    network = made("halls", seed, rooms=min(rooms, 4), loops=loops, **PLAIN)
    assert len(census(network).rooms) == min(rooms, 4)


@given(seeds, st.integers(0, 6))
@settings(max_examples=20, deadline=None)
def test_each_loop_goes_round_one_solid(seed, loops):
    maze = made("maze", seed, loops=loops, **PLAIN)
    assert len(maze.islands) == loops
    assert len(census(maze).rooms) == 1
    network = made("halls", seed, loops=loops, dead_ends=0.0, **PLAIN)
    assert len(network.islands) == loops


@given(seeds)
@settings(max_examples=10, deadline=None)
def test_dead_ends_are_filled_in_on_request(seed):
    for share, some in ((0.0, False), (1.0, True)):
        floor = census(made("halls", seed, columns=8, rows=8, dead_ends=share))
        assert (
            any(end.kind is None for hall in floor.halls for end in hall.ends) is some
        )


@given(seeds)
@settings(max_examples=10, deadline=None)
def test_halls_change_width_as_often_as_asked(seed):
    for share, fewest, most in ((0.0, 0, 0), (1.0, 1, 99)):
        floor = census(made("office", seed, changes=share))
        changes = [len(set(hall.widths)) - 1 for hall in floor.halls]
        assert fewest <= sum(changes) <= most


@given(seeds)
@settings(max_examples=10, deadline=None)
def test_halls_begin_at_corners_as_often_as_asked(seed):
    ends = [
        [
            end
            for hall in census(made("office", seed, corners=share, **PLAIN)).halls
            for end in hall.ends
        ]
        for share in (0, 1)
    ]
    at_corners = [sum(len(end.corners) for end in some) for some in ends]
    assert at_corners[0] == 0
    assert at_corners[1] > 0


@given(seeds)
@settings(max_examples=10, deadline=None)
def test_an_island_by_a_wall_leaves_a_hall_that_joins_the_room_with_itself(seed):
    room = {"rooms": 1, "dead_ends": 0, "loops": 0, "room": 4.0, "variation": 0.2}
    world = made("rooms", seed, **room, islands=1, cuts=0, pillars=0)
    floor = census(world)
    assert len(world.islands) == len(floor.halls) == len(floor.rooms) == 1
    assert [end.kind for end in floor.halls[0].ends] == ["room", "room"]
    world = made("rooms", seed, **room, islands=0, cuts=0, pillars=1)
    assert len(world.islands) == 1
    assert not census(world).halls
    world = made("rooms", seed, **room, islands=0, cuts=1, pillars=0)
    assert len(world.outer) == 6


@given(seeds, st.integers(1, 20))
@settings(max_examples=10, deadline=None)
def test_an_equal_office_repeats_itself(seed, rooms):
    floor = census(made("office", seed, rooms=rooms, equal=1, cuts=1, variation=0.5))
    sizes = {tuple(np.round(room.high - room.low, 6)) for room in floor.rooms}
    assert len(sizes) == 1
    assert len({width for hall in floor.halls for width in hall.widths}) <= 1


@given(seeds, st.sampled_from(FLOORS))
@settings(max_examples=20, deadline=None)
def test_walls_lie_on_the_lines_of_a_fine_grid(seed, kind):
    corners = np.concatenate(made(kind, seed).rings) / PITCH
    np.testing.assert_allclose(corners, np.rint(corners), atol=1e-6)


def test_a_floor_with_two_hundred_vertices():
    floor = census(made("rooms", 1, rooms=22, loops=12))
    mouths = [end.kind for hall in floor.halls for end in hall.ends].count("room")
    assert 4 * len(floor.rooms) + 2 * mouths + len(floor.junctions) > 200


@given(seeds, st.integers(1, 6), st.integers(1, 6), st.integers(0, 9))
@settings(max_examples=30, deadline=None)
def test_a_woven_floor_is_a_tree_and_its_loops(seed, columns, rows, loops):
    rng = np.random.default_rng(seed)
    edges = list(lattice(columns, rows))
    floor = woven(rng, [((0, 0), (0, 0))], edges, loops, dead_ends=1.0)
    tree = columns * rows - 1
    assert len(floor.halls) == min(tree + loops, len(edges))
    reached, fresh = {(0, 0)}, [(0, 0)]
    while fresh:
        node = fresh.pop()
        for axis in (0, 1):
            down, up = floor.leads(node, axis)
            near = [step(node, axis, -1)] * down + [step(node, axis)] * up
            fresh += [other for other in near if other not in reached]
            reached.update(near)
    assert reached == set(nodes_of(((0, 0), (columns - 1, rows - 1))))


@given(seeds, st.integers(1, 6), st.integers(1, 6))
@settings(max_examples=30, deadline=None)
def test_runs_take_every_edge_once(seed, columns, rows):
    rng = np.random.default_rng(seed)
    rooms = [((0, 0), (0, 0)), ((columns - 1, rows - 1),) * 2][: 1 + (columns > 1)]
    floor = woven(rng, rooms, lattice(columns, rows), 5, 0.5)
    taken = [edge for run in runs(floor) for edge in run.edges]
    assert len(taken) == len(set(taken))
    assert set(taken) == floor.halls
    for run in runs(floor):
        assert not any(run.node(stop) in floor.room_at for stop in run.stops[1:-1])


def space(*boxes, out=()):
    """Return the world of a union of boxes without some others."""
    free = shapely.union_all([shapely.box(*box) for box in boxes])
    for box in out:
        free = free.difference(shapely.box(*box))
    return make_world(
        free.exterior.coords[:-1], [i.coords[:-1] for i in free.interiors]
    )


ROOM = (0, 0, 3, 3)


@pytest.mark.parametrize(
    ("world", "message"),
    [
        (space(ROOM, (3, 1, 5, 1.42)), "too narrow"),
        (space(ROOM, (3, 1, 5, 1.58)), "too wide"),
        (space(ROOM, (3, 1, 3.4, 1.5)), "too short"),
        (space(ROOM, (3, 1, 5, 1.5), (4, 1.1, 5, 1.55)), "leaves its middle"),
        (space(ROOM, (3, 1, 5, 1.5), (3.7, 0.98, 4, 1.52)), "no longer than wide"),
        (space(ROOM, (3, 1, 5, 1.5), (3, 0.98, 3.35, 1.52)), "changes too soon"),
        (space(ROOM, (3, 0.3, 5, 0.8)), "near a corner"),
        (space(ROOM, (3, 0, 5, 0.5), (2.5, -2, 3, 0)), "mouth beside a hall"),
        (space(ROOM, (3, 1, 5, 1.5), (4.2, 1.5, 4.7, 1.7)), "too short"),
        (space(ROOM, (3, 1, 5, 1.5), (4, -1, 4.5, 1), (4.05, 1.5, 4.5, 3)), "in line"),
        (space(ROOM, (3, 1, 5, 1.5), (5, 1.0005, 6, 1.4995)), "nearly in line"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_what_is_no_hall_is_seen(world, message):
    with pytest.raises(AssertionError, match=message):
        census(world)


@pytest.mark.parametrize(
    ("world", "message"),
    [
        (space(ROOM, out=[(0, 1, 2.35, 1.5)]), "between 0.6 and 0.7"),
        (space(ROOM, (3, 1, 5, 1.5), (3, 1.55, 5, 2)), "thin wall"),
        (space((0, 0, 1.1, 3)), "small room"),
    ],
    ids=["passage", "wall", "room"],
)
def test_what_is_no_room_is_seen(world, message):
    with pytest.raises(AssertionError, match=message):
        check_space(world)
