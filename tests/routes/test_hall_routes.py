"""Routes through rooms and halls: what a robot sees, where it is, that it arrives."""

import dataclasses
import json
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import worlds
from behaviours import Parameters, VertexType
from behaviours.port import run as run_on
from behaviours.ways import Way
from topomap import InputError, JobError, build_map, save_map
from topomap.cli import main
from topomap.closers import make_closer
from topomap.exploring import explore_halls
from topomap.files.world_files import save_world
from topomap.routes.driving import drive_route
from topomap.routes.hall_belief import Standing, begun, moved, surest
from topomap.routes.hall_places import has_halls, places_of
from topomap.routes.limits import true_lengths
from topomap.routes.matching import match_world
from topomap.routes.planning import Router, plan_route
from topomap.routes.steps import walk_wall
from topomap.truth import true_map, true_maps
from worlds.ideal import IdealBody
from worlds.starts import choose_start
from worlds.world import make_world

ROBOT = Parameters()


def two_rooms(upper_is_open=True):
    """Two rooms, and a lower and an upper hall between them; or the upper one shut."""
    low, high = (1.0, 1.5), (3.5, 4.0)
    wall = 3.9 if upper_is_open else 4.4
    outer = [
        *[(0, 0), (3, 0), (3, low[0]), (6, low[0]), (6, 0), (9, 0), (9, 5), (6, 5)],
        *[(6, high[1]), (3, high[1]), (3, 5), (0, 5)],
    ]
    pillar = [(3, low[1]), (6, low[1]), (6, high[0]), (3, high[0])]
    if upper_is_open:
        return make_world(outer, [pillar])
    shut = [
        *outer[:8],
        *[(6, high[1]), (wall, high[1]), (wall, high[0]), (6, high[0])],
        *[(6, low[1]), (3, low[1]), (3, high[0]), (3.7, high[0]), (3.7, high[1])],
        *outer[9:],
    ]
    return make_world(shut)


@settings(max_examples=5, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_a_map_tells_what_the_robot_that_made_it_saw(seed):
    rng = np.random.default_rng(seed)
    world = worlds.make("rooms", rng)
    body = IdealBody(world, choose_start(world, ROBOT, rng), ROBOT, rng, 0.0)
    closer = make_closer("likelihood", 0.0, ROBOT, slip=0.0)
    found = run_on(explore_halls(ROBOT, closer, 0.0, 5000), body)
    hall = places_of(found.chart.as_map(ROBOT, 0.0))
    assert hall.places == found.chart.places
    ends = {end: link.beyond(end)[0] for end, link in found.chart.links.items()}
    assert {end: way.vertex for end, way in hall.passages.items()} == ends


def test_a_map_that_is_turned_tells_the_same():
    room = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], ROBOT)
    tilted = dataclasses.replace(
        room,
        vertices=tuple(
            dataclasses.replace(v, exits=tuple(e + 0.3 for e in v.exits))
            for v in room.vertices
        ),
        edges=tuple(
            dataclasses.replace(
                e, source_exit=e.source_exit + 0.3, target_exit=e.target_exit + 0.3
            )
            for e in room.edges
        ),
    )
    assert places_of(tilted).places == places_of(room).places
    assert places_of(tilted).tilt == pytest.approx(0.3)


def test_open_rooms_have_no_halls_and_rooms_with_openings_do():
    room = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], ROBOT)
    assert not has_halls(room)
    (halls,) = true_maps(two_rooms(), ROBOT)
    assert has_halls(halls)
    ways = {way for place in places_of(halls).places.values() for way in place.ways}
    assert ways == {None, Way.WALL_LEFT, Way.WALL_RIGHT, Way.HALL, Way.OUT}


def test_belief_follows_the_robot_and_stays_a_probability():
    (chart,) = true_maps(two_rooms(), ROBOT)
    hall = places_of(chart)
    here = next(v.id for v in chart.vertices if v.type is VertexType.INT)
    belief = begun(hall, here, hall.places[here])
    assert surest(belief)[0] == Standing(here, 0)
    for _ in range(12):
        q = hall.places[here].ways.index(Way.WALL_RIGHT)
        way = hall.passages[here, q]
        here = way.vertex
        belief = moved(hall, belief, q, way.length, hall.places[here], 0.05)
        assert sum(belief.values()) == pytest.approx(1.0)
        standing, probability = surest(belief)
        assert standing == Standing(here, 0)
        assert probability > 0.99


def test_a_vertex_that_was_missed_is_bridged():
    (chart,) = true_maps(two_rooms(), ROBOT)
    hall = places_of(chart)
    for (here, q), way in hall.passages.items():
        on = hall.passages.get((way.vertex, q))
        if on is not None and on.vertex != here:
            belief = begun(hall, here, hall.places[here])
            length = way.length + on.length
            belief = moved(hall, belief, q, length, hall.places[on.vertex], 0.01)
            assert belief[Standing(on.vertex, 0)] > 0.5


@settings(max_examples=4, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), kind=st.sampled_from(["rooms", "office"]))
def test_the_ideal_robot_arrives_through_halls(seed, kind):
    rng = np.random.default_rng(seed)
    world = worlds.make(kind, rng)
    built = build_map(world, rng, sigma=0.0)
    assert built.correct
    matched = match_world(built.map, world)
    ids = [vertex.id for vertex in built.map.vertices]
    for _ in range(5):
        a, b = rng.choice(ids, 2, replace=False).tolist()
        drive = drive_route(matched, a, b, rng, sigma=0.05)
        assert (drive.failure, drive.arrived) == ("", True)
        assert drive.collisions == 0


def test_the_physical_robot_arrives_through_a_hall():
    world = two_rooms()
    rng = np.random.default_rng(2)
    matched = match_world(build_map(world, rng, sigma=0.02).map, world)
    ids = [v.id for v in matched.chart.vertices]
    for a, b in ((ids[0], ids[-1]), (ids[5], ids[1])):
        drive = drive_route(matched, a, b, rng, body="physical")
        assert (drive.failure, drive.arrived) == ("", True)


def corners(matched):
    """Return the map's vertices next to two points, one in either room."""
    places = {v.id: v.position for v in matched.truth.vertices}
    back = {j: i for i, j in matched.pairs.items()}
    near = [
        back[min(places, key=lambda k, p=point: math.dist(places[k], p))]
        for point in ((0.3, 4.7), (8.7, 4.7))
    ]
    return near[0], near[1]


def test_a_shut_hall_is_noticed_and_another_way_taken():
    world = two_rooms()
    matched = match_world(
        build_map(world, np.random.default_rng(1), sigma=0.0).map, world
    )
    a, b = corners(matched)
    assert any(s.edge.behaviour == "HF" for s in plan_route(matched.chart, a, b).steps)
    shut = dataclasses.replace(matched, world=two_rooms(upper_is_open=False))
    drive = drive_route(shut, a, b, np.random.default_rng(1), sigma=0.02)
    assert (drive.failure, drive.arrived) == ("", True)
    assert len(drive.routes) > 1
    assert drive.events[0].what == "elsewhere"


def test_a_robot_in_another_world_does_not_say_that_it_has_arrived():
    world = two_rooms()
    matched = match_world(
        build_map(world, np.random.default_rng(1), sigma=0.0).map, world
    )
    other = dataclasses.replace(
        matched, world=make_world([(0, 0), (3, 0), (3, 7), (0, 7)])
    )
    a, b = corners(matched)
    drive = drive_route(other, a, b, np.random.default_rng(1), sigma=0.02)
    assert not drive.claims
    assert drive.failure


def test_a_hall_is_no_wall_in_open_space():
    room = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], ROBOT)
    hall = dataclasses.replace(room.edges[0], behaviour="HF")
    corner = room.vertices[0].type
    walk = walk_wall(ROBOT, corner, 0.0, hall, corner, True, 0.05)
    with pytest.raises(
        JobError, match="from vertex 0 to vertex 1 is HF at INT: only w"
    ):
        next(walk)


def test_the_command_drives_through_halls(tmp_path, capsys):
    world = two_rooms()
    built = build_map(world, np.random.default_rng(1), sigma=0.0)
    save_world(world, tmp_path / "world.json")
    save_map(built.map, tmp_path / "map.json")
    a, b = (str(k) for k in corners(match_world(built.map, world)))
    command = ["route", str(tmp_path / "map.json"), a, b]
    assert main(command) == 0
    said = capsys.readouterr().out
    assert "HF 3.0" in said
    assert "ENTER" in said
    drive = [*command, "--world", str(tmp_path / "world.json")]
    assert main(drive) == 0
    assert f"arrived at vertex {b}" in capsys.readouterr().out
    assert main([*drive, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["arrived"] is True


@settings(max_examples=3, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), kind=st.sampled_from(["rooms", "office"]))
def test_incursions_inside_rooms_lead_where_they_say(seed, kind):
    rng = np.random.default_rng(seed)
    world = worlds.make(kind, rng)
    built = build_map(world, rng, sigma=0.02, improve="passive")
    assert built.correct
    matched = match_world(built.map, world)
    for edge, length in zip(built.map.edges, true_lengths(matched), strict=True):
        assert edge.kind in ("base", "passive")
        assert length is not None


@pytest.fixture(scope="module")
def house():
    """Return the rooms of a house, with incursions in them."""
    world = worlds.make("rooms", np.random.default_rng([3, 0]))
    built = build_map(world, np.random.default_rng(3), sigma=0.02, improve="passive")
    assert any(edge.is_incursion for edge in built.map.edges)
    return match_world(built.map, world)


@pytest.mark.parametrize("body", ["ideal", "physical"])
def test_a_robot_crosses_rooms_on_its_way_through_halls(house, body):
    ids = [v.id for v in house.chart.vertices]
    router = Router(house.chart)
    routes = [
        route
        for route in (router.route(a, b) for a in ids for b in ids)
        if {"INCURSION", "HF"} <= {step.edge.behaviour for step in route.steps}
    ]
    assert routes
    for route in sorted(routes, key=lambda r: r.length)[:3]:
        rng = np.random.default_rng(1)
        drive = drive_route(house, route.source, route.target, rng, body=body)
        assert (drive.failure, drive.arrived, drive.events) == ("", True, ())


def test_an_incursion_that_leads_elsewhere_is_noticed(house):
    way = next(e for e in house.chart.edges if e.is_incursion)
    # It says another direction than leads there.
    wrong = dataclasses.replace(way, source_exit=way.source_exit + math.pi / 3)
    edges = tuple(wrong if e is way else e for e in house.chart.edges)
    chart = dataclasses.replace(house.chart, edges=edges)
    astray = dataclasses.replace(house, chart=chart)
    rng = np.random.default_rng(1)
    drive = drive_route(astray, way.source, way.target, rng, sigma=0.02)
    assert drive.failure or (drive.arrived and drive.events)


def test_driven_incursions_are_for_worlds_without_halls():
    with pytest.raises(InputError, match="improve: expected none or passive: ways are"):
        build_map(two_rooms(), np.random.default_rng(1), improve="active")
