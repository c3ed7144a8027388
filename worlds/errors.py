"""What can be wrong with a world."""

from __future__ import annotations

__all__ = ["WorldError"]


class WorldError(ValueError):
    """A world that no robot can stand in.

    Examples
    --------
    >>> str(WorldError("islands[0]", "crosses itself at (1, 2)"))
    'islands[0]: crosses itself at (1, 2)'
    """

    def __init__(self, field: str, fault: str) -> None:
        super().__init__(f"{field}: {fault}")
        self.field = field
        """Which part of the world is at fault, such as ``outer[3]``."""
        self.fault = fault
        """What is wrong with it, with the value and what was expected."""

    def __reduce__(self) -> tuple[type[WorldError], tuple[str, str]]:
        """Let it come back from another process."""
        return type(self), (self.field, self.fault)
