"""Graphs that contradict themselves are refused, with the path of the fault."""

import math

import numpy as np
import pytest

from merge.graph import Graph, GraphError

GOOD = {
    "types": [0, 1],
    "exits": [[0.0], [math.pi, 1.0]],
    "edges": [(0, 0, 1, 0)],
    "lengths": [4.0],
    "sigmas": [0.2],
}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"types": [], "exits": [], "edges": [], "lengths": [], "sigmas": []},
            "types: expected at least one vertex; got none",
        ),
        (
            {"edges": [(0, 0, 2, 0)]},
            "edges[0]: expected a vertex below 2; got vertex 2",
        ),
        (
            {"edges": [(-1, 0, 1, 0)]},
            "edges[0]: expected a vertex below 2; got vertex -1",
        ),
        (
            {"edges": [(0, 1, 1, 0)]},
            "edges[0]: expected an exit below 1; got exit 1 of vertex 0",
        ),
        (
            {
                "edges": [(0, 0, 1, 0), (1, 1, 1, 0)],
                "lengths": [4, 1],
                "sigmas": [1] * 2,
            },
            "edges[1]: expected each exit to be used by one edge; "
            "got exit 0 of vertex 1 once more",
        ),
        ({"lengths": [0.0]}, "lengths[0]: expected a length above 0; got 0.0"),
        ({"lengths": [-2.0]}, "lengths[0]: expected a length above 0; got -2.0"),
        ({"lengths": [math.nan]}, "lengths[0]: expected a finite number; got nan"),
        ({"sigmas": [0.0]}, "variances[0]: expected a variance above 0; got 0.0"),
        (
            {"exits": [[math.inf], [1.0, 2.0]]},
            "exits[0]: expected a finite number; got inf",
        ),
        ({"types": [0, -2]}, "types[1]: expected a type from -1 (unknown) up; got -2"),
        ({"types": [0, 1, 2]}, "first_exit: expected shape (4,); got shape (3,)"),
        (
            {"positions": [(0.0, 0.0)]},
            "positions: expected shape (2, 2); got shape (1, 2)",
        ),
    ],
)
def test_contradictions_are_named(change, message):
    with pytest.raises(GraphError) as error:
        Graph.of(**{**GOOD, **change})
    assert str(error.value) == message


def test_exits_fall_to_their_vertices():
    graph = Graph.of(**GOOD)
    with pytest.raises(GraphError, match="first_exit: expected 0 first"):
        Graph(
            types=graph.types,
            first_exit=np.array([0, 4, 3]),
            exits=graph.exits,
            edges=graph.edges,
            lengths=graph.lengths,
            variances=graph.variances,
            shifts=graph.shifts,
            complete=graph.complete,
        )


def test_the_arrays_are_the_graphs_own_and_cannot_be_written_to():
    lengths = np.array([4.0])
    graph = Graph.of(**{**GOOD, "lengths": lengths})
    lengths[0] = 7.0
    assert graph.lengths[0] == 4.0
    with pytest.raises(ValueError, match="read-only"):
        graph.lengths[0] = 7.0
