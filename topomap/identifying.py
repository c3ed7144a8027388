"""How an exploring robot finds out whether a place is one that it met before."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from topomap.base_loops import close_loop, is_open_loop
from topomap.recognition import expected_evidence, recognise
from topomap.walking import goto, step_out

if TYPE_CHECKING:
    from behaviours.port import Behaviour
    from topomap.explored import Exploration

__all__ = ["identify"]


def identify(found: Exploration, vertex: int) -> Behaviour[bool]:
    """Find out whether a vertex is one met before; return whether that is known.

    Where the evidence is too weak, the base loop is closed first, if there is one;
    then the robot takes ways that it knows, if the vertex is what it may be.
    """
    chart = found.chart
    unsure = [vertex]
    while unsure:
        if found.walls >= found.max_walls:
            found.closed = False
        if not found.closed:
            return False
        vertex = unsure[-1]
        if vertex not in chart.places:
            unsure.pop()
            continue
        recognition = recognise(chart, found.parameters, found.sigma, vertex)
        found.recognitions.append(replace(recognition, walls=found.walls))
        if not recognition.is_sure(found.error):
            best, _ = recognition.candidates[0]
            telling = _telling_way(found, vertex, best)
            if is_open_loop(chart, vertex):
                yield from goto(found, vertex)
                yield from close_loop(found)
                continue
            if telling is not None:
                yield from goto(found, telling[0])
                unsure.insert(-1, (yield from step_out(found, telling[1])))
                continue
        unsure.pop()
        if recognition.known is not None:
            pairs = chart.pairs(vertex, recognition.known) or {}
            chart.join(pairs)
            found.here = pairs.get(found.here, found.here)
        elif is_open_loop(chart, vertex):
            yield from goto(found, vertex)
            yield from close_loop(found)
    return found.closed


def _telling_way(found: Exploration, vertex: int, other: int) -> tuple[int, int] | None:
    """Return the exit not taken yet that would tell most of whether two are one.

    The map knows where it would lead. Of those at the first junction that has any, it
    is the one whose length is expected to yield the most evidence ([K] 3.3.3).
    """
    links = found.chart.links
    lengths = np.array([link.length for link in found.chart.each_link()])
    for a, b in (found.chart.pairs(vertex, other) or {}).items():
        ways = [q for q in range(4) if (b, q) in links and (a, q) not in links]
        if ways:
            evidence = [
                expected_evidence(links[b, q], found.sigma, lengths) for q in ways
            ]
            return a, ways[int(np.argmax(evidence))]
    return None
