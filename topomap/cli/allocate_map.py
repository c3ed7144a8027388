"""What `topomap allocate MAP --robots` finds, and how it says so."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from topomap.exploration.allocation import Allocation
    from topomap.team.frontiers import TopologicalFrontier
    from topomap.team.sending import Sending

__all__ = ["Sent", "read_vertices", "send_in_map"]


@dataclass(frozen=True, slots=True)
class Sent:
    """Robots sent to the frontiers of a map."""

    robots: list[int]
    sending: Sending

    @property
    def allocation(self) -> Allocation:
        """Who goes where."""
        return self.sending.allocation

    @property
    def summary(self) -> dict[str, Any]:
        """The frontiers of the map, and what ways to them cost, as JSON."""
        ways = self.sending.costs.T.tolist()
        return {
            "robots": self.robots,
            "frontiers": [
                {
                    "kind": one.kind,
                    "vertex": one.vertex,
                    "direction_deg": round(math.degrees(one.direction), 4),
                    "promise": one.promise,
                    "target": one.target,
                    "length_m": round(one.length, 4),
                    "saves_m": round(one.saves, 3),
                    "sweeps_m2": round(one.sweeps, 3),
                    "sureness": round(one.sureness, 6),
                    "ways_m": [round(m, 4) if math.isfinite(m) else None for m in row],
                }
                for one, row in zip(self.sending.frontiers, ways, strict=True)
            ],
        }

    @property
    def lines(self) -> list[str]:
        """What is open, and who goes where, in words."""
        found = self.sending.frontiers
        incursions = sum(one.kind == "incursion" for one in found)
        exits = len(found) - incursions
        lines = [f"{exits} unexplored exits, {incursions} unverified incursions"]
        plan = self.allocation
        for k, (one, here) in enumerate(
            zip(self.sending.targets, self.robots, strict=True)
        ):
            where = "stays: no frontier can be reached" if found else "stays"
            if one is not None:
                where = f"goes {plan.costs[k]:.1f} {self._unit} to {_words(one)}"
            wait = ", after a wait" if plan.waits[k] else ""
            lines.append(f"robot {k} at vertex {here} {where}{wait}")
        return lines

    @property
    def _unit(self) -> str:
        """Metres, or seconds where speeds were given."""
        ways = self.sending.costs
        pairs = zip(self.allocation.assignment, self.allocation.costs, strict=True)
        same = all(j is None or ways[i, j] == c for i, (j, c) in enumerate(pairs))
        return "m" if same else "s"


def send_in_map(
    path: Path,
    robots: str,
    allocator: str,
    target: str,
    sigma: float,
    speeds: list[float] | None,
    exchange: bool,
) -> Sent:
    """Send robots, given by their vertices with commas between, in a map file."""
    from topomap.bodies import body_drift
    from topomap.errors import InputError
    from topomap.files.map_files import load_map
    from topomap.found import MAX_SIGMA
    from topomap.incursions.candidates import Options
    from topomap.team.sending import send_robots

    places = read_vertices(robots)
    if not 0 <= sigma <= MAX_SIGMA:
        raise InputError("--sigma", "", sigma, f"a part between 0 and {MAX_SIGMA}")
    sending = send_robots(
        load_map(path),
        places,
        allocator,
        target=target,
        options=Options(body_drift("ideal", sigma)),
        speeds=speeds,
        exchange=exchange,
    )
    return Sent(places, sending)


def read_vertices(text: str) -> list[int]:
    """Return the ids of a list with commas, or say which is none."""
    from topomap.errors import InputError

    ids = []
    for i, word in enumerate(text.split(",")):
        try:
            ids.append(int(word))
        except ValueError:
            expected = "the id of a vertex"
            raise InputError("--robots", f"robot {i}", word, expected) from None
    return ids


def _words(one: TopologicalFrontier) -> str:
    """Say what a frontier is."""
    way = f"vertex {one.vertex}, then {math.degrees(one.direction):.0f} deg"
    if one.kind == "exit":
        return f"{way}: {one.promise}"
    good = [f"saves {one.saves:.0f} m over all pairs"] if one.saves else []
    good += [f"sweeps {one.sweeps:.1f} m2"] if one.sweeps else []
    return f"{way} across to vertex {one.target}: {', '.join(good)}"
