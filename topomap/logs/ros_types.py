"""How values become ROS 2 messages, and what the messages' definitions are."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from topomap.errors import InputError

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

__all__ = ["definition_of", "encoded", "header", "message", "type_store"]

NEEDED = "the packages that logs need: pip install 'topomap-robots[ros]'"


@cache
def type_store() -> Typestore:
    """Return the message types of ROS 2 Jazzy.

    Raises
    ------
    InputError
        If the packages for logs are not installed.
    """
    try:
        import mcap.records  # noqa: F401
        from rosbags.typesys import Stores, get_typestore
    except ImportError as error:
        raise InputError(f"no module {error.name}", "", None, NEEDED) from None
    return get_typestore(Stores.ROS2_JAZZY)


@cache
def definition_of(kind: str) -> str:
    """Return a type's definition with those that it uses, as ``ros2msg``."""
    definition, _ = type_store().generate_msgdef(kind, ros_version=2)
    return str(definition)


def message(kind: str, *values: Any) -> Any:
    """Make a message of a type such as ``geometry_msgs/msg/Point``."""
    return type_store().types[kind](*values)


def header(stamp: int, frame: str) -> Any:
    """Make a header of a time in nanoseconds."""
    seconds, nanoseconds = divmod(stamp, 10**9)
    time = message("builtin_interfaces/msg/Time", seconds, nanoseconds)
    return message("std_msgs/msg/Header", time, frame)


def encoded(kind: str, value: Any) -> bytes:
    """Return a message as CDR, little end first."""
    return bytes(type_store().serialize_cdr(value, kind))
