"""Whether a body keeps the contract of the robot port.

Any body, exact, simulated or real, is put into standard situations and asked to
carry out primitives there; what it answers is held against what the port says.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from behaviours.parameters import Parameters
from behaviours.port import Body, Outcome
from behaviours.situation import Situation, Step
from behaviours.situations import situations

__all__ = ["ContractError", "Failure", "MakeBody", "check_body"]

MakeBody = Callable[[tuple[tuple[float, float], ...], float, float, float], Body]
"""Builds a body in a world whose only wall is a ring of corners, free space to
the left of the walls: corners, then x, y in metres and heading in radians."""


@dataclass(frozen=True, slots=True)
class Failure:
    """One answer that the port does not allow."""

    situation: str
    """In what situation, and at which primitive."""
    what: str
    """Which part of the answer."""
    expected: str
    got: str

    def __str__(self) -> str:
        """Say it in one line."""
        return (
            f"{self.situation}: {self.what}: expected {self.expected}; got {self.got}"
        )


class ContractError(AssertionError):
    """A body that does not do what the robot port says.

    Examples
    --------
    >>> error = ContractError((Failure("move free, 1", "reason", "DONE", "STUCK"),))
    >>> print(error)
    1 answer breaks the contract of the robot port:
    move free, 1: reason: expected DONE; got STUCK
    """

    def __init__(self, failures: tuple[Failure, ...]) -> None:
        count = (
            "1 answer breaks"
            if len(failures) == 1
            else f"{len(failures)} answers break"
        )
        lines = [f"{count} the contract of the robot port:", *map(str, failures)]
        super().__init__("\n".join(lines))
        self.failures = failures
        """All that was wrong, in the order of the situations."""


def check_body(
    make_body: MakeBody,
    parameters: Parameters | None = None,
    tolerance: float = 1e-5,
) -> None:
    """Put a body into all standard situations and check what it answers.

    Parameters
    ----------
    make_body : callable
        ``make_body(ring, x, y, heading)`` returns the body, new, in a world that
        is the inside of a ring of (x, y), counter-clockwise, in metres; it
        stands at (x, y), its heading in radians. Its odometry should be exact:
        lengths are compared.
    parameters : Parameters, optional
        Those that the body keeps; the situations are built to their scale.
    tolerance : float
        By how much a length may differ, in metres.

    Raises
    ------
    ContractError
        If any answer differs; it holds all `Failure` values.
    ValueError
        If the tolerance is negative or not a number.

    Notes
    -----
    A situation ends at its first wrong reason: what follows would be asked of a
    robot that stands elsewhere.
    """
    if not tolerance >= 0:
        raise ValueError(f"tolerance must be at least 0; got {tolerance}")
    parameters = Parameters() if parameters is None else parameters
    failures: list[Failure] = []
    for situation in situations(parameters):
        body = make_body(situation.ring, situation.x, situation.y, situation.heading)
        failures += _play(situation, body, parameters, tolerance)
    if failures:
        raise ContractError(tuple(failures))


def _play(
    situation: Situation, body: Body, parameters: Parameters, tolerance: float
) -> list[Failure]:
    """Return what a body answers wrongly in one situation."""
    name = situation.name
    if body.parameters != parameters:
        return [Failure(name, "parameters", str(parameters), str(body.parameters))]
    failures: list[Failure] = []
    travelled, clock = body.travelled, body.clock
    for k, step in enumerate(situation.steps, 1):
        where = f"{name}, primitive {k} ({type(step.primitive).__name__})"
        outcome = body.execute(step.primitive)
        failures += _differences(where, step, outcome, tolerance)
        if body.clock < clock or body.travelled < travelled:
            was = f"at least {clock:g} s and {travelled:g} m"
            now = f"{body.clock:g} s and {body.travelled:g} m"
            failures.append(Failure(where, "clock and travelled", was, now))
        travelled, clock = body.travelled, body.clock
        if outcome.reason is not step.reason:
            break
    if body.collisions:
        failures.append(Failure(name, "collisions", "0", str(body.collisions)))
    return failures


def _differences(
    where: str, step: Step, outcome: Outcome, tolerance: float
) -> list[Failure]:
    """Return in what an outcome differs from what is expected."""
    if outcome.reason is not step.reason:
        ended = f"{outcome.reason.name} after {outcome.distance:.4f} m"
        return [Failure(where, "reason", step.reason.name, ended)]
    failures = []
    for what, wanted, got in (
        ("distance", step.distance, outcome.distance),
        ("shift", step.shift, outcome.shift),
        ("clearance", step.clearance, outcome.clearance),
        ("front", step.front, outcome.readings.front),
        ("left", step.left, outcome.readings.left),
        ("right", step.right, outcome.readings.right),
    ):
        if wanted is not None and not abs(got - wanted) <= tolerance:
            expected = f"{wanted:.4f} m within {tolerance:g} m"
            failures.append(Failure(where, what, expected, f"{got:.4f} m"))
    return failures
