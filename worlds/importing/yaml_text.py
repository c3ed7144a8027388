"""Which plain values YAML text stands for: no tags, no bombs, within bounds."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any

import yaml

__all__ = ["YamlFaultError", "read_yaml"]

WHOLE = re.compile(r"[-+]?(0|[1-9][0-9]*)")
DECIMAL = re.compile(r"[-+]?[0-9]+\.[0-9]+(e[-+][0-9]+)?")
MOST_DEPTH = 100
PREFIX = "tag:yaml.org,2002:"


class YamlFaultError(ValueError):
    """Text that is not YAML, or YAML that is not taken here; says the line."""


def read_yaml(text: str, most_values: int) -> Any:
    """Read one YAML document.

    Parameters
    ----------
    text : str
        YAML 1.1. Aliases may be used; what they stand for is shared.
    most_values : int
        So many lists, objects and scalars there may be, those that an alias
        stands for counted each time.

    Returns
    -------
    object
        Lists, dicts, texts, numbers, truth values, dates and None, as
        ``yaml.safe_load`` gives them.

    Raises
    ------
    YamlFaultError
        If it is not one YAML document, has a tag, a merge key, a key that is no
        scalar or an alias of a part that it is in, is nested too deeply, or has
        more values.

    Notes
    -----
    Built from the parser's events, without recursion: memory is bounded by the
    text, and nothing that walks the result meets more than `most_values`. Takes
    half the time of ``yaml.load`` with its C parser.

    Examples
    --------
    >>> read_yaml("corners: [&a {x: 1.5}, *a]", 10)
    {'corners': [{'x': 1.5}, {'x': 1.5}]}
    >>> read_yaml("[&a [0, 0], &b [*a, *a, *a], [*b, *b, *b]]", 20)
    Traceback (most recent call last):
    worlds.importing.yaml_text.YamlFaultError: line 1: more than 20 values
    """
    builder = _Builder(most_values)
    try:
        for event in _events(text):
            builder.take(event)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        where = f"line {mark.line + 1}: " if mark else ""
        raise YamlFaultError(f"{where}{error.problem or 'not YAML'}") from None
    except yaml.YAMLError as error:
        raise YamlFaultError(str(error).partition("\n")[0]) from None
    return builder.value


def _events(text: str) -> Iterator[yaml.Event]:
    loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    return yaml.parse(text, Loader=loader)


class _Builder:
    """Makes values of events."""

    def __init__(self, most_values: int) -> None:
        self.value: Any = None
        self._most = most_values
        self._count = 0
        self._documents = 0
        self._open: list[tuple[Any, str | None, int]] = []
        self._keys: list[Any] = []
        self._anchors: dict[str, tuple[Any, int]] = {}
        self._plain: dict[str, Any] = {}
        self._resolver = yaml.SafeLoader("")
        self._steps: dict[type, Callable[[Any], None]] = {
            yaml.ScalarEvent: self._scalar,
            yaml.AliasEvent: self._alias,
            yaml.MappingStartEvent: lambda event: self._begin(event, {}),
            yaml.SequenceStartEvent: lambda event: self._begin(event, []),
            yaml.MappingEndEvent: self._end,
            yaml.SequenceEndEvent: self._end,
            yaml.DocumentStartEvent: self._document,
        }

    def take(self, event: yaml.Event) -> None:
        """Go on by one event."""
        step = self._steps.get(type(event))
        if step is not None:
            step(event)

    def _document(self, event: yaml.Event) -> None:
        self._documents += 1
        if self._documents > 1:
            raise _fault(event, "a second document")

    def _scalar(self, event: yaml.ScalarEvent) -> None:
        self._add(event, 1)
        text = event.value
        if event.tag is not None and event.tag != "!":
            raise _fault(event, f"a tag, {event.tag[:40]}")
        value = self._resolved(event, text) if event.implicit[0] else text
        if event.anchor:
            self._anchors[event.anchor] = value, 1
        self._put(event, value)

    def _resolved(self, event: yaml.Event, text: str) -> Any:
        """Return what a plain scalar stands for."""
        if text in self._plain:
            return self._plain[text]
        if DECIMAL.fullmatch(text):
            return float(text)
        try:
            if WHOLE.fullmatch(text):
                return int(text)
            tag = self._resolver.resolve(yaml.ScalarNode, text, (True, False))  # type: ignore[no-untyped-call]
            if tag == PREFIX + "merge":
                raise _fault(event, "a merge key")
            node = yaml.ScalarNode(tag, text)
            value = self._resolver.construct_object(node)
        except (ValueError, OverflowError) as error:
            if isinstance(error, YamlFaultError):
                raise
            raise _fault(event, f"{text[:40]!r} is no value") from None
        self._plain[text] = value
        return value

    def _alias(self, event: yaml.AliasEvent) -> None:
        name = event.anchor or ""
        value, size = self._anchors.get(name, (None, 0))
        if not size:
            raise _fault(event, f"an alias of no part before it, {name[:40]}")
        self._add(event, size)
        self._put(event, value)

    def _begin(self, event: Any, empty: Any) -> None:
        if event.tag is not None and event.tag != "!":
            raise _fault(event, f"a tag, {event.tag[:40]}")
        if len(self._open) == MOST_DEPTH:
            raise _fault(event, f"more than {MOST_DEPTH} levels")
        self._open.append((empty, event.anchor, self._count))
        self._keys.append(_NO_KEY)
        self._add(event, 1)
        # What is inside it cannot be an alias of it, nor of one of that name before.
        self._anchors.pop(event.anchor, None)

    def _end(self, event: yaml.Event) -> None:
        value, anchor, before = self._open.pop()
        self._keys.pop()
        if anchor:
            self._anchors[anchor] = value, self._count - before
        self._put(event, value)

    def _put(self, event: yaml.Event, value: Any) -> None:
        """Add a value to what is open."""
        if not self._open:
            self.value = value
            return
        parent = self._open[-1][0]
        if type(parent) is list:
            parent.append(value)
        elif self._keys[-1] is _NO_KEY:
            if isinstance(value, list | dict):
                raise _fault(event, "a key that is no scalar")
            self._keys[-1] = value
        else:
            parent[self._keys[-1]] = value
            self._keys[-1] = _NO_KEY

    def _add(self, event: yaml.Event, count: int) -> None:
        self._count += count
        if self._count > self._most:
            raise _fault(event, f"more than {self._most} values")


_NO_KEY = object()


def _fault(event: yaml.Event, what: str) -> YamlFaultError:
    mark = event.start_mark
    return YamlFaultError(f"line {mark.line + 1}: {what}" if mark else what)
