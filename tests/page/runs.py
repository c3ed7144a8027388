"""Runs to show: a build, a merge, a team by hand, a map of many vertices."""

import math
from functools import cache

import numpy as np

import worlds
from behaviours.parameters import Parameters
from behaviours.vertices import VertexType
from merge.makers import cut, make_maze, overlapping, perturb, turn
from topomap.merging import KINDS, merge_maps
from topomap.page import (
    Assignment,
    MapState,
    MapTrack,
    Message,
    Recording,
    RobotTrack,
    record_build,
    recording_of_merge,
)
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex
from topomap.truth import true_maps

EVIL = '</script><img src=x onerror="window.hacked=1"><!--<script>\u2028\'"&${data}'
"""A name that runs if it is ever taken for markup or script."""


@cache
def build_run(body="ideal", kind="l", **options):
    """Return a build and its recording."""
    world = worlds.make(kind, np.random.default_rng(1), **options)
    return record_build(world, np.random.default_rng(7), body=body, sigma=0.05)


def chart_of(graph):
    """Return a plain graph as a map."""
    free = [[] for _ in range(len(graph))]
    for v, i in graph.unexplored().tolist():
        free[v].append(float(graph.exits_of(v)[i]))
    vertices = [
        Vertex(
            v, KINDS[int(graph.types[v])], tuple(graph.exits_of(v).tolist()), tuple(f)
        )
        for v, f in enumerate(free)
    ]
    edges = [
        Edge(
            u,
            v,
            float(graph.exits_of(u)[i]),
            float(graph.exits_of(v)[j]),
            (Length(float(length), float(sigma)),),
        )
        for (u, i, v, j), length, sigma in zip(
            graph.edges.tolist(), graph.lengths, np.sqrt(graph.variances), strict=True
        )
    ]
    return TopologicalMap(tuple(vertices), tuple(edges))


@cache
def merge_run(seed=3, overlap=0.4):
    """Return the merge of two overlapping parts of a maze, and its recording."""
    rng = np.random.default_rng(seed)
    maze = make_maze(14, 14, rng, spacing=(2.0, 8.0))
    one, two = overlapping(maze, 40, overlap, rng)
    a = perturb(cut(maze, one), 0.04, rng)
    b, _ = turn(perturb(cut(maze, two), 0.04, rng), math.pi / 2, rng)
    charts = [chart_of(a), chart_of(b)]
    found = merge_maps(charts)
    return found, recording_of_merge(found, charts, ["Ada", "Ben"])


def team_run():
    """Return a recording of two robots, made by hand, with all that a page can show."""
    world = worlds.make("random", np.random.default_rng(2), corners=30, islands=2)
    (chart, *_) = true_maps(world, Parameters())
    times = np.linspace(0.0, 60.0, 121)
    places = np.array([vertex.position for vertex in chart.vertices])
    names = "Ada", "Ben"
    robots = []
    for k, name in enumerate(names):
        ring = np.roll(places, -4 * k, axis=0)[:8]
        at = np.linspace(0, len(ring) - 1, len(times))
        xy = np.column_stack(
            [np.interp(at, np.arange(len(ring)), column) for column in ring.T]
        )
        way = np.gradient(xy, axis=0)
        heading = np.arctan2(way[:, 1], way[:, 0])
        ranges = np.full((len(times), 2), 0.4)
        ranges[::3, 1] = np.inf
        robots.append(
            RobotTrack(
                name,
                times,
                np.column_stack([xy, heading]),
                rangers=np.array([[0.0, 0.0, 0.0], [0.05, 0.0, -math.pi / 2]]),
                ranges=ranges,
            )
        )
    target = tuple(places[-1])
    return Recording(
        title="two robots",
        facts=(("robots", "2"),),
        walls=world.rings,
        robots=tuple(robots),
        maps=(MapTrack("map", (MapState(0.0, chart),)),),
        assignments=(
            Assignment(0.0, 0, target, "MinPos: rank 0, cost 12.3 m"),
            Assignment(0.0, 1, tuple(places[-4]), "MinPos: rank 1, cost 20.1 m"),
            Assignment(50.0, 1, None, "nothing left for it"),
        ),
        messages=(
            Message(0.0, "the run begins"),
            Message(20.0, "my map has 6 vertices", sender=0, receiver=1),
            Message(30.0, "nobody hears this", sender=1, receiver=0, lost=True),
            Message(59.8, "done", sender=1),
        ),
    )


def grid_map(side):
    """Return a map of side x side crossings, 2 m apart, with positions."""
    quarter = math.pi / 2
    vertices, edges = [], []
    for k in range(side * side):
        column, row = k % side, k // side
        exits = [
            way
            for way, is_there in enumerate(
                (column < side - 1, row < side - 1, column > 0, row > 0)
            )
            if is_there
        ]
        vertices.append(
            Vertex(
                k,
                tuple(VertexType)[k % 6],
                tuple(way * quarter for way in exits),
                position=(2.0 * column, 2.0 * row),
                covariance=((0.01, 0.0), (0.0, 0.02)),
            )
        )
        for way, step in ((0, 1), (1, side)):
            if way in exits:
                edges.append(
                    Edge(
                        *(k, k + step, way * quarter, (way + 2) * quarter),
                        (Length(2.0, 0.1),),
                    )
                )
    return TopologicalMap(tuple(vertices), tuple(edges))
