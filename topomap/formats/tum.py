"""How a trajectory is kept as a TUM file, which evo and others read."""

from __future__ import annotations

from os import PathLike

import numpy as np
from numpy.typing import ArrayLike

from topomap.errors import InputError
from topomap.files.atomic import write_atomically

__all__ = ["save_tum"]


def save_tum(times: ArrayLike, poses: ArrayLike, path: str | PathLike[str]) -> None:
    r"""Write a trajectory in the plane as a TUM file, whole or not at all.

    Parameters
    ----------
    times : array_like, shape (N,)
        In seconds.
    poses : array_like, shape (N, 3)
        Rows x, y in metres and heading in radians.
    path : path-like
        Replaced if it is there. Lines are time, position x y z and quaternion
        x y z w, with z = 0 and a rotation about z.

    Raises
    ------
    InputError
        If the shapes do not fit, a number is not finite, or the file cannot be
        written.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_tum([0.5], [(1.0, 2.0, np.pi)], Path(folder, "run.tum"))
    ...     Path(folder, "run.tum").read_text()
    '0.5 1.0 2.0 0.0 0.0 0.0 1.0 6.123233995736766e-17\n'
    """
    when = np.asarray(times, dtype=float)
    where = np.asarray(poses, dtype=float).reshape(-1, 3)
    if when.shape != (len(where),):
        raise InputError("", "times", when.shape, f"an array of shape {(len(where),)}")
    if not (np.isfinite(when).all() and np.isfinite(where).all()):
        raise InputError("", "poses", None, "finite numbers")
    rows = np.zeros((len(where), 8))
    rows[:, 0] = when
    rows[:, 1:3] = where[:, :2]
    rows[:, 6], rows[:, 7] = np.sin(where[:, 2] / 2), np.cos(where[:, 2] / 2)
    lines = [" ".join(map(repr, row)) for row in rows.tolist()]
    write_atomically(path, "".join(line + "\n" for line in lines))
