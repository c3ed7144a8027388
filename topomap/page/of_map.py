"""A single map as a recording: one state, with nothing to play."""

from __future__ import annotations

from typing import TYPE_CHECKING

from topomap.page.recording import Recording
from topomap.page.tracks import MapState, MapTrack

if TYPE_CHECKING:
    from topomap.topological_map import TopologicalMap

__all__ = ["recording_of_map"]


def recording_of_map(chart: TopologicalMap, name: str = "map") -> Recording:
    """Return a recording that shows a map, in its own frame.

    Parameters
    ----------
    chart : TopologicalMap
        Embedded first if it has no positions.
    name : str
        What to call it.

    Returns
    -------
    Recording
        Without time.
    """
    lengths = sum(edge.fused.value for edge in chart.edges)
    facts = (
        ("vertices", str(len(chart.vertices))),
        ("edges", str(len(chart.edges))),
        ("unexplored exits", str(chart.unexplored_exits)),
        ("length of all edges", f"{lengths:.1f} m"),
    )
    return Recording(
        title=name, facts=facts, maps=(MapTrack(name, (MapState(0.0, chart),)),)
    )
