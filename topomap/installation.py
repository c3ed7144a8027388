"""What is installed, which version, and which parts of topomap work with it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from importlib import import_module, metadata

from topomap.errors import JobError

__all__ = ["CORE", "Part", "Requirement", "check_parts", "installed_version"]

NAME = "topomap-robots"
"""Of the distribution: what pip calls it."""
CORE = "core"
"""The part that is always installed."""
TOOLS = "dev", "docs"
"""Parts of which topomap imports nothing: what is there is not tried."""
NEED = re.compile(
    r"(?P<name>[\w.-]+)(?:\[[\w,-]+\])?\s*(?:>=\s*(?P<least>[\d.]+))?\s*"
    r"(?:;\s*extra\s*==\s*['\"](?P<extra>\w+)['\"])?"
)


@dataclass(frozen=True, slots=True)
class Requirement:
    """A distribution that a part needs."""

    name: str
    least: str | None
    """The least version that will do; None if any will."""
    found: str | None
    """The version that is installed; None if it is not."""
    fault: str
    """Why it does not do; empty if it does."""


@dataclass(frozen=True, slots=True)
class Part:
    """A part of topomap: its core, or what an extra adds."""

    name: str
    needs: tuple[Requirement, ...]

    @property
    def works(self) -> bool:
        """Whether all that it needs is there and can be imported."""
        return not self.faults

    @property
    def faults(self) -> tuple[str, ...]:
        """What keeps it from working, a sentence part each."""
        return tuple(f"{need.name} {need.fault}" for need in self.needs if need.fault)


def installed_version() -> str:
    """Return the version of topomap that is installed.

    Returns
    -------
    str
        ``unknown`` if it runs from a folder and was never installed.
    """
    try:
        return metadata.version(NAME)
    except metadata.PackageNotFoundError:
        return "unknown"


def check_parts() -> tuple[Part, ...]:
    """Find out which parts of topomap work here.

    Returns
    -------
    tuple of Part
        The core first, then the extras. All that they need is imported, but for
        the tools of those who develop topomap.

    Raises
    ------
    JobError
        If topomap runs from a folder and was never installed: then nobody says
        what it needs.
    """
    try:
        lines = metadata.requires(NAME) or []
    except metadata.PackageNotFoundError:
        raise JobError(
            "topomap was not installed, so its needs are unknown: pip install -e ."
        ) from None
    return parts_of(lines, metadata.packages_distributions())


def parts_of(
    lines: Iterable[str], distributions: Mapping[str, Iterable[str]]
) -> tuple[Part, ...]:
    """Return the parts that need what a distribution says it needs.

    Parameters
    ----------
    lines : iterable of str
        Needs, as ``importlib.metadata.requires`` gives them.
    distributions : mapping of str to iterable of str
        Which distributions have a module, as
        ``importlib.metadata.packages_distributions`` gives it.

    Examples
    --------
    >>> parts = parts_of(["numpy>=1.26", "warp>=9; extra == 'space'"], {})
    >>> [(part.name, part.works) for part in parts]
    [('core', True), ('space', False)]
    >>> parts[1].faults
    ('warp is missing',)
    """
    modules: dict[str, list[str]] = {}
    for module, names in distributions.items():
        for name in names:
            modules.setdefault(_normal(name), []).append(module)
    parts: dict[str, list[Requirement]] = {CORE: []}
    for line in lines:
        match = NEED.match(line)
        if match is None:
            continue
        part = match["extra"] or CORE
        tried = [] if part in TOOLS else modules.get(_normal(match["name"]), [])
        parts.setdefault(part, []).append(
            _checked(match["name"], match["least"], tried)
        )
    return tuple(Part(name, tuple(needs)) for name, needs in parts.items())


def _checked(name: str, least: str | None, modules: list[str]) -> Requirement:
    """Look for a distribution, and import its public modules."""
    try:
        found = metadata.version(name)
    except metadata.PackageNotFoundError:
        return Requirement(name, least, None, "is missing")
    if least is not None and _release(found) < _release(least):
        return Requirement(name, least, found, f"{found} is older than {least}")
    for module in modules:
        if module.isidentifier() and not module.startswith("_"):
            try:
                import_module(module)
            except Exception as error:  # whatever a broken installation raises
                reason = " ".join(str(error).split())[:100]
                return Requirement(name, least, found, f"cannot be imported: {reason}")
    return Requirement(name, least, found, "")


def _release(version: str) -> tuple[int, ...]:
    """Return the numbers of a version, up to what is no number."""
    match = re.match(r"\d+(\.\d+)*", version)
    numbers = [int(part) for part in match[0].split(".")] if match else []
    while numbers and not numbers[-1]:
        numbers.pop()
    return tuple(numbers)


def _normal(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()
