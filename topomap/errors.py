"""What can go wrong, by what it means for the one who asked."""

from __future__ import annotations

__all__ = ["InputError", "JobError"]


class InputError(ValueError):
    """Input that cannot be used: the command line ends with exit code 2.

    Examples
    --------
    >>> str(InputError("hall.json", "r0", -0.3, "a length above 0"))
    'hall.json: r0: expected a length above 0; got -0.3'
    >>> str(InputError("hall.json", "", None, "a JSON object"))
    'hall.json: expected a JSON object'
    """

    def __init__(self, source: str, field: str, value: object, expected: str) -> None:
        where = ": ".join(part for part in (source, field) if part)
        got = "" if value is None else f"; got {value!r}"
        super().__init__(f"{where}: expected {expected}{got}")
        self.source = source
        """The file, or the option, that holds the value."""
        self.field = field
        """The path of the fault inside the file, such as ``vertices[3].exits``."""
        self.value = value
        """What was found there, or None where nothing was."""
        self.expected = expected
        """What would have been accepted."""

    def __reduce__(self) -> tuple[type[InputError], tuple[str, str, object, str]]:
        """Let it come back from another process."""
        return type(self), (self.source, self.field, self.value, self.expected)


class JobError(RuntimeError):
    """A job that failed on good input: exit code 3, with the reason."""
