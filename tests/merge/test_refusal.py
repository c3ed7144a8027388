"""Where the maps fit in several ways, or only by chance, the merge is refused."""

import math

import numpy as np
import pytest

from merge.chance import false_merge_probability
from merge.graph import Graph
from merge.hypotheses import grow_hypotheses
from merge.layout import lay_out
from merge.makers import breadth_first, cut, perturb, turn
from merge.mazes import make_maze
from merge.options import Options
from merge.pairwise import match
from merge.repeating import double, repeat
from merge.repeats import Copies, find_copies, told_by_copies

E, N, W, S = 0.0, math.pi / 2, math.pi, 3 * math.pi / 2
BACK = {E: W, N: S, W: E, S: N}


def drawn(points, edges):
    """Make a map of named points and [(name, way, name)]."""
    names = list(points)
    exits = {name: [] for name in names}
    for u, way, v in edges:
        exits[u].append(way)
        if v is not None:
            exits[v].append(BACK[way])
    exits = {name: sorted(ways) for name, ways in exits.items()}
    edges = [edge for edge in edges if edge[2] is not None]
    rows = [
        (names.index(u), exits[u].index(w), names.index(v), exits[v].index(BACK[w]))
        for u, w, v in edges
    ]
    lengths = [math.dist(points[u], points[v]) for u, _, v in edges]
    return Graph.of(
        types=[len(exits[name]) for name in names],
        exits=list(exits.values()),
        edges=rows,
        lengths=lengths,
        sigmas=[0.03 * length for length in lengths],
    )


def corridor(first, last, rooms=12):
    """Return rooms first to last of a corridor of equal rooms along the x axis."""
    points, edges = {}, []
    for k in range(first, last):
        x = 4.0 * k
        points |= {
            ("door", k): (x, 0.0),
            ("room", k): (x, 3.0),
            ("corner", k): (x + 2.5, 3.0),
        }
        edges += [
            (("door", k), N, ("room", k)),
            (("room", k), E, ("corner", k)),
        ]
        if k + 1 < last:
            edges.append((("door", k), E, ("door", k + 1)))
        elif k + 1 < rooms:
            edges.append((("door", k), E, None))
        if k == first and k > 0:
            edges.append((("door", k), W, None))
    return drawn(points, edges)


def test_equal_rooms_along_a_corridor_are_refused_however_many_match():
    rng = np.random.default_rng(1)
    a, b = corridor(1, 7), corridor(3, 9)
    found = match(perturb(a, 0.02, rng), perturb(b, 0.02, rng))
    assert not found.accepted
    assert found.reason


def test_a_maze_of_unequal_cells_lies_on_itself_in_one_way():
    rng = np.random.default_rng(1)
    whole = make_maze(5, 5, np.random.default_rng(3))
    a, b = perturb(whole, 0.02, rng), perturb(whole, 0.02, rng)
    found = match(a, b)
    assert found.accepted
    assert (found.pairs[:, 0] == found.pairs[:, 1]).all()


def rotunda():
    """Return a building that looks the same after half a turn."""
    return double(make_maze(4, 6, np.random.default_rng(8)))


def test_a_symmetric_building_is_refused_and_both_ways_are_returned():
    rng = np.random.default_rng(0)
    whole = rotunda()
    found = match(perturb(whole, 0.03, rng), perturb(whole, 0.03, rng))
    assert not found.accepted
    assert "more than one way" in found.reason
    assert found.false_merge_probability > 0.01
    best, other = found.best, found.alternatives[0]
    assert len(best.pairs) == len(other.pairs) == len(whole)
    off = math.remainder(best.transform.angle - other.transform.angle, math.tau)
    assert abs(abs(off) - math.pi) < 0.05


def test_one_half_of_a_symmetric_building_is_refused_too():
    rng = np.random.default_rng(0)
    whole = rotunda()
    half = cut(whole, np.arange(len(whole) // 2))
    found = match(perturb(whole, 0.03, rng), perturb(half, 0.03, rng))
    assert not found.accepted


def test_luck_in_the_lengths_does_not_decide_between_equal_halves():
    whole = double(make_maze(6, 8, np.random.default_rng(1)))
    half = cut(whole, np.arange(len(whole) // 2))
    for seed in range(40):
        rng = np.random.default_rng(seed)
        found = match(perturb(whole, 0.03, rng), perturb(half, 0.03, rng))
        assert not found.accepted, seed


def with_door(graph, vertex):
    """Return the map after an exit was opened at a vertex."""
    exits = [graph.exits_of(v).tolist() for v in range(len(graph))]
    free = next(way for way in (E, N, W, S) if not np.isclose(exits[vertex], way).any())
    exits[vertex].append(free)
    return Graph.of(
        types=graph.types,
        exits=exits,
        edges=graph.edges,
        lengths=graph.lengths,
        sigmas=np.sqrt(graph.variances),
    )


def test_an_opened_door_is_forgiven_only_on_request():
    rng = np.random.default_rng(5)
    maze = make_maze(6, 6, rng)
    three = int(np.flatnonzero(np.diff(maze.first_exit) == 3)[0])
    a = perturb(maze, 0.02, rng)
    b, order = turn(perturb(with_door(maze, three), 0.02, rng), 0.5, rng)
    assert not match(a, b).accepted
    found = match(a, b, Options(doors=True))
    assert found.accepted
    assert len(found.pairs) == len(maze)
    np.testing.assert_array_equal(order[found.pairs[:, 1]], found.pairs[:, 0])


def test_a_contradiction_at_the_rim_is_tolerated_only_on_request():
    rng = np.random.default_rng(5)
    maze = make_maze(6, 6, rng)
    a, b = perturb(maze, 0.02, rng), perturb(maze, 0.02, rng)
    lengths = b.lengths.copy()
    end = int(np.argmin(np.diff(maze.first_exit)[maze.edges[:, 2]]))
    lengths[end] *= 3
    spoilt = Graph(
        **{
            name: getattr(b, name)
            for name in ("types", "first_exit", "exits", "edges", "shifts", "complete")
        },
        lengths=lengths,
        variances=b.variances,
    )
    assert match(a, spoilt).best is None
    found = match(a, spoilt, Options(tolerate_rim=True))
    assert found.accepted
    assert (found.pairs[:, 0] == found.pairs[:, 1]).all()
    assert len(found.pairs) >= len(maze) - 2
    assert found.hypotheses.contradictions.max() > 0


def test_probability_falls_with_the_score_and_grows_with_rivals_and_trials():
    alone = [false_merge_probability(s, [], 1e4) for s in (0.0, 10.0, 20.0, 900.0)]
    assert alone == sorted(alone, reverse=True)
    assert alone[0] > 0.99
    assert false_merge_probability(30, [29], 1e4) > false_merge_probability(30, [], 1e4)
    assert false_merge_probability(30, [], 1e5) > false_merge_probability(30, [], 1e4)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("threshold", 0.0, "threshold must lie between 0.0 and 1.0; got 0.0"),
        ("angle", 1.0, "angle must lie between 0.0 and 0.78539"),
        ("reach", 0.0, "reach must lie between 0.0 and inf; got 0.0"),
        ("false_merge", 1.0, "false_merge must lie between 0.0 and 1.0; got 1.0"),
        ("twins", 1.0, "twins must lie in \\[0, 1\\); got 1.0"),
        ("least", 1, "least must be at least 2 vertices; got 1"),
    ],
)
def test_options_out_of_range(name, value, message):
    with pytest.raises(ValueError, match=message):
        Options(**{name: value})


def test_where_twins_are_likely_a_match_is_told_and_refused():
    rng = np.random.default_rng(5)
    maze = perturb(make_maze(6, 6, rng), 0.02, rng)
    sure = match(maze, maze)
    assert sure.accepted
    doubted = match(maze, maze, Options(twins=0.05))
    assert not doubted.accepted
    assert "may have another part like them" in doubted.reason
    assert doubted.false_merge_probability == pytest.approx(0.05, abs=1e-6)
    assert (doubted.pairs == sure.pairs).all()
    assert match(maze, maze, Options(twins=5e-4)).accepted


def told_share(graph, vertices):
    """Return how much of a map's match with a part of itself copies explain."""
    vertices = np.array(vertices)
    part = lay_out(cut(graph, vertices))
    score = grow_hypotheses(part, lay_out(graph), Options()).score.max()
    copies = find_copies(lay_out(graph), vertices, Options())
    return told_by_copies([copies], len(vertices), score) / score


def test_parts_repeated_in_large_are_found_and_unequal_ones_are_not():
    rng = np.random.default_rng(2)
    equal = perturb(corridor(1, 7), 0.01, rng)
    assert told_share(equal, range(len(equal) - 6)) > 0.5
    unequal = perturb(make_maze(6, 6, rng), 0.01, rng)
    assert told_share(unequal, range(len(unequal))) == 0


def test_half_a_symmetric_building_is_the_other_half_again():
    whole = perturb(rotunda(), 0.01, np.random.default_rng(0))
    half = len(whole) // 2
    assert told_share(whole, range(half)) > 0.7


def test_copies_explain_each_vertex_once_and_no_more_than_its_score():
    def told(*parts):
        first = np.arange(len(parts) + 1) * 6
        rows = [np.arange(6) + start for start, _ in parts]
        copies = Copies(
            first, np.concatenate(rows), np.array([gain for _, gain in parts])
        )
        return told_by_copies([copies], 12, 30.0)

    assert told_by_copies([], 12, 30.0) == 0
    assert told((0, 9.0)) == 9.0
    assert told((0, 9.0), (0, 8.0)) == 9.0
    assert told((0, 9.0), (3, 8.0)) == 13.0
    assert told((0, 99.0), (6, 9.0)) == 24.0


@pytest.mark.parametrize("seed", range(4))
def test_one_of_equal_wings_is_refused_and_every_wing_is_returned(seed):
    rng = np.random.default_rng(seed)
    hotel = repeat(make_maze(4, 5, rng), 3)
    size = (len(hotel) - 3) // 3
    part = cut(hotel, size + breadth_first(cut(hotel, np.arange(size)), 0, size))
    found = match(perturb(hotel, 0.02, rng), perturb(part, 0.02, rng))
    assert not found.accepted
    assert "more than one way" in found.reason
    assert len(found.alternatives) >= 2
    assert found.false_merge_probability > 0.01


def test_equal_wings_are_told_apart_where_the_end_of_the_corridor_is_seen():
    rng = np.random.default_rng(0)
    hotel = repeat(make_maze(4, 5, rng), 3)
    found = match(perturb(hotel, 0.01, rng), perturb(hotel, 0.01, rng))
    assert (found.pairs[:, 0] == found.pairs[:, 1]).all()
    assert len(found.pairs) == len(hotel)


@pytest.mark.parametrize(
    ("copies", "kept", "message"),
    [(1, True, "copies: expected at least 2; got 1"), (2, False, "with positions")],
)
def test_repeating_refuses(copies, kept, message):
    wing = make_maze(3, 3, np.random.default_rng(0))
    wing = wing if kept else perturb(wing, 0.02, np.random.default_rng(0))
    with pytest.raises(ValueError, match=message):
        repeat(wing, copies)
