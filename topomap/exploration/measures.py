"""What the figures of a run are."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from topomap.exploration.exploring import Run

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.exploration.team import Team

    Ints = NDArray[np.int64]

__all__ = ["measure"]


def measure(
    team: Team,
    complete: bool,
    times: list[float] | list[int],
    known: list[int],
    lengths: NDArray[np.float64],
    trace: list[Ints],
) -> Run:
    """Return the figures of a run."""
    enough = next(k for k, cells in enumerate(known) if cells >= 0.9 * known[-1])
    border = np.pad(np.zeros(team.shape, dtype=bool), 1, constant_values=True).ravel()
    own = team.own[:, ~border].sum(axis=1, dtype=np.int64)
    cells = np.array(trace)
    seen = team.together.reshape(-1, team.width)[1:-1, 1:-1].astype(bool)
    return Run(
        complete,
        times[-1],
        times[enough],
        tuple(lengths.tolist()),
        float(own.sum() / max(known[-1], 1) - 1),
        float((own / max(known[-1], 1)).std()),
        seen,
        np.stack([cells // team.width - 1, cells % team.width - 1], axis=-1),
    )
