"""What a kind of world is: a maker with named, bounded options."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from worlds.errors import WorldError
from worlds.world import World

__all__ = ["Kind", "Option", "checked"]


@dataclass(frozen=True, slots=True)
class Option:
    """One number that a maker can be told.

    Its type is the type of its default: whole numbers where that is an int.
    """

    name: str
    default: int | float
    least: float
    most: float
    meaning: str
    """One line, with the unit."""
    step: int = 1
    """Whole numbers must be `least` plus a multiple of this."""

    def check(self, kind: str, value: object) -> int | float:
        """Return the value in the option's own type.

        Raises
        ------
        WorldError
            If it is no number, not finite, not whole where it must be, or out
            of range; names the kind, the option, the value and the range.
        """
        whole = isinstance(self.default, int)
        if isinstance(value, int | float | np.integer | np.floating) and (
            not isinstance(value, bool)
            and math.isfinite(value)
            and self.least <= value <= self.most
            and not (whole and (value - self.least) % self.step)
        ):
            return int(value) if whole else float(value)
        raise WorldError(
            f"{kind}: {self.name}", f"expected {self.expected}; got {value!r}"
        )

    @property
    def expected(self) -> str:
        """What the option accepts, in words."""
        number = "a number"
        if isinstance(self.default, int):
            number = "an even whole number" if self.step == 2 else "a whole number"
        return f"{number} from {self.least:g} to {self.most:g}"


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of world that can be asked for by name."""

    name: str
    summary: str
    """What the world looks like, in one line."""
    options: tuple[Option, ...]
    build: Callable[..., World]
    """Called with the generator and every option by name."""

    def make(self, rng: np.random.Generator, given: Mapping[str, object]) -> World:
        """Check the options that are given, fill in the others, and build.

        Raises
        ------
        WorldError
            If an option is unknown or its value cannot be used.
        """
        return self.build(rng, **checked(self.name, self.options, given))


def checked(
    owner: str, options: tuple[Option, ...], given: Mapping[str, object]
) -> dict[str, int | float]:
    """Return a value for every option: what is given, else the default.

    Raises
    ------
    WorldError
        If an option is unknown or its value cannot be used; names the owner.
    """
    known = {option.name: option for option in options}
    for name, value in given.items():
        if name not in known:
            raise WorldError(
                f"{owner}: {name}",
                f"unknown option; expected one of {', '.join(known)}; got {value!r}",
            )
    return {
        name: option.check(owner, given.get(name, option.default))
        for name, option in known.items()
    }
