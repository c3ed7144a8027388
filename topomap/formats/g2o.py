"""How a pose graph is kept in a g2o file."""

from __future__ import annotations

import math
from os import PathLike, fspath

import numpy as np

from topomap.errors import InputError
from topomap.files.atomic import write_atomically
from topomap.formats.text_files import read_text
from topomap.pose_graph import PoseGraph, not_information

__all__ = ["load_g2o", "save_g2o"]

UPPER = np.triu_indices(3)
"""A file has the upper triangle of an information matrix, row by row."""
FIELDS = {"VERTEX_SE2": 4, "EDGE_SE2": 11}
"""How many numbers follow a tag."""
GREATEST = 1e30
"""No number is greater: sums of their squares stay finite."""
MOST_ID = 2**53
"""Ids above could not be told apart by those who read numbers as floats."""


def load_g2o(path: str | PathLike[str]) -> PoseGraph:
    """Read the poses in the plane that a g2o file has.

    Parameters
    ----------
    path : path-like
        Lines ``VERTEX_SE2 id x y heading``, ``EDGE_SE2 id id x y heading`` with
        the upper triangle of the information matrix, ``FIX id``, and comments.

    Returns
    -------
    PoseGraph
        In the order of the file.

    Raises
    ------
    InputError
        If the file cannot be read, a line is of another kind, has too few or too
        many numbers or one that is not finite, an id is no vertex's or is used
        twice, or an information matrix is not positive semidefinite. Names the
        line.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> poses = ["VERTEX_SE2 7 0 0 0", "VERTEX_SE2 9 1 0 0"]
    >>> lines = [*poses, "EDGE_SE2 7 9 1 0 0 4 0 0 4 0 9"]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "way.g2o")
    ...     _ = path.write_text(chr(10).join(lines))
    ...     graph = load_g2o(path)
    >>> graph.ids.tolist(), graph.ends.tolist(), graph.information[0].diagonal()
    ([7, 9], [[0, 1]], array([4., 4., 9.]))
    """
    source = fspath(path)
    vertices: list[list[float]] = []
    edges: list[list[float]] = []
    rows: dict[int, int] = {}
    named: list[tuple[int, int, int]] = []
    fixed: list[tuple[int, int]] = []
    for number, line in enumerate(read_text(path).splitlines(), 1):
        tag, *words = line.split() or ("#",)
        if tag.startswith("#"):
            continue
        where = f"line {number}"
        if tag == "FIX":
            fixed += [(number, _id(source, where, word)) for word in words]
            continue
        if tag not in FIELDS:
            raise InputError(
                source, where, tag[:40], "VERTEX_SE2, EDGE_SE2, FIX or a comment"
            )
        if len(words) != FIELDS[tag]:
            raise InputError(
                source, where, len(words), f"{FIELDS[tag]} numbers after {tag}"
            )
        if tag == "VERTEX_SE2":
            name = _id(source, where, words[0])
            if name in rows:
                raise InputError(source, where, name, "an id not used before")
            rows[name] = len(vertices)
            vertices.append(_numbers(source, where, words[1:]))
        else:
            first, second = (_id(source, where, word) for word in words[:2])
            if first == second:
                raise InputError(source, where, first, "the ids of two vertices")
            edges.append(_numbers(source, where, words[2:]))
            named.append((number, first, second))
    ends = [
        [_row(source, number, name, rows) for name in names] for number, *names in named
    ]
    measured = np.array(edges).reshape(-1, 9)
    information = np.empty((len(edges), 3, 3))
    information[:, UPPER[0], UPPER[1]] = measured[:, 3:]
    information[:, UPPER[1], UPPER[0]] = measured[:, 3:]
    for k in not_information(information)[:1]:
        where = f"line {named[k][0]}"
        expected = "an information matrix that is positive semidefinite"
        raise InputError(source, where, None, expected)
    return PoseGraph(
        np.array(list(rows), dtype=np.int64),
        np.array(vertices, dtype=float).reshape(-1, 3),
        np.array(ends, dtype=np.int64).reshape(-1, 2),
        measured[:, :3].copy(),
        information,
        tuple(dict.fromkeys(_row(source, n, name, rows) for n, name in fixed)),
    )


def save_g2o(graph: PoseGraph, path: str | PathLike[str]) -> None:
    """Write a pose graph to a g2o file, whole or not at all.

    Parameters
    ----------
    graph : PoseGraph
        Comes back from `load_g2o` bit for bit.
    path : path-like
        Replaced if it is there.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    ids = graph.ids.tolist()
    lines = [
        f"VERTEX_SE2 {name} {x!r} {y!r} {heading!r}"
        for name, (x, y, heading) in zip(ids, graph.poses.tolist(), strict=True)
    ]
    lines += [f"FIX {ids[row]}" for row in graph.fixed]
    numbers = np.hstack([graph.measurements, graph.information[:, *UPPER]])
    lines += [
        f"EDGE_SE2 {ids[a]} {ids[b]} {' '.join(map(repr, values))}"
        for (a, b), values in zip(graph.ends.tolist(), numbers.tolist(), strict=True)
    ]
    write_atomically(path, "\n".join(lines) + "\n")


def _id(source: str, where: str, word: str) -> int:
    if word.removeprefix("-").isdecimal() and len(word) < 20:
        name = int(word)
        if abs(name) <= MOST_ID:
            return name
    raise InputError(source, where, word[:40], "an id, a whole number")


def _row(source: str, number: int, name: int, rows: dict[int, int]) -> int:
    if name not in rows:
        raise InputError(source, f"line {number}", name, "the id of a VERTEX_SE2")
    return rows[name]


def _numbers(source: str, where: str, words: list[str]) -> list[float]:
    numbers = []
    for word in words:
        try:
            number = float(word)
        except ValueError:
            number = math.nan
        if not abs(number) <= GREATEST:
            raise InputError(
                source, where, word[:40], f"a number of at most {GREATEST:g}"
            )
        numbers.append(number)
    return numbers
