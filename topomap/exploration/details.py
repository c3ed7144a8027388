"""What an allocator may know beside the costs."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Details"]


@dataclass(frozen=True, slots=True)
class Details:
    """What is known of n robots and m frontiers beside the table of costs.

    Every part may be missing; an allocator does without what it is not given
    and says how in its documentation.

    Raises
    ------
    InputError
        From `check`, if a part has another shape than stated, or holds a NaN
        or a negative number.
    """

    between: NDArray[np.float64] | None = None
    """Shape (m, m): distance from frontier to frontier, in the unit of the costs."""
    visible: NDArray[np.bool_] | None = None
    """Shape (m, m): whether one frontier is in sight from the other."""
    sizes: NDArray[np.float64] | None = None
    """Shape (m,): how large each frontier is, such as its number of cells."""
    turns: NDArray[np.float64] | None = None
    """Shape (n, m): angle, in [0, pi], from a robot's heading to the frontier."""
    beyond: NDArray[np.float64] | None = None
    """Shape (m, k): unknown cells behind each frontier; column b counts those from
    b to b + 1 times the reach, rounded down, away from it through the unknown."""
    previous: NDArray[np.int64] | None = None
    """Shape (n,): the frontier a robot was on its way to, or -1."""
    news: int | None = None
    """How many cells became known since the decision that `previous` tells of."""
    reach: float | None = None
    """How far a robot sees, in the unit of the costs."""

    def check(self, robots: int, frontiers: int) -> None:
        """Raise if a part does not fit so many robots and frontiers."""
        shapes = {
            "between": (frontiers, frontiers),
            "visible": (frontiers, frontiers),
            "sizes": (frontiers,),
            "turns": (robots, frontiers),
            "beyond": (frontiers, 1),
            "previous": (robots,),
            "news": (),
            "reach": (),
        }
        for field in fields(self):
            value = getattr(self, field.name)
            if value is None:
                continue
            array = np.asarray(value)
            if field.name == "beyond" and array.ndim == 2:
                shapes["beyond"] = (frontiers, array.shape[1])
            if array.shape != shapes[field.name]:
                raise InputError(
                    field.name, "", array.shape, f"the shape {shapes[field.name]}"
                )
            least = -1 if field.name == "previous" else 0
            if not (array >= least).all():
                raise InputError(
                    field.name, "", None, f"numbers of at least {least}, and no NaN"
                )
