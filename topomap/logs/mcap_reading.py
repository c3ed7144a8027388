"""Which messages an MCAP file holds, however broken it may be.

One pass over the file. A chunk is only unpacked if its index, which follows it, names
a topic that is wanted or not known yet.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Callable, Iterator
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, NamedTuple

from topomap.errors import InputError

if TYPE_CHECKING:
    from mcap.records import Chunk, McapRecord

__all__ = ["CDR", "Message", "scan_mcap"]

CDR = "cdr"
LIMIT = 1 << 27
"""Most bytes of one record, packed or unpacked."""
MAGIC = b"\x89MCAP0\r\n"
FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK = 0x02, 0x03, 0x04, 0x05, 0x06
MESSAGE_INDEX, DATA_END = 0x07, 0x0F
HEAD, LENGTH = struct.Struct("<HIQQ"), struct.Struct("<Q")
WHOLE = "a whole MCAP file"


class Message(NamedTuple):
    """One message of a log."""

    topic: str
    type: str
    stamp: int
    """When it was logged, in nanoseconds."""
    data: bytes


class DamageError(ValueError):
    """What is wrong with a file."""


def scan_mcap(
    path: Path, wanted: Callable[[str, str], bool], topics: dict[str, str]
) -> Iterator[Message]:
    """Yield the wanted messages of an MCAP file in the order in which they stand.

    Parameters
    ----------
    path : Path
        The file.
    wanted : callable
        Chooses by topic and type.
    topics : dict
        Is filled with the topics met and their types.

    Raises
    ------
    InputError
        If the file is no MCAP file, truncated or corrupt, or a wanted topic is not
        in CDR.
    """
    import zstandard

    try:
        with path.open("rb") as file:
            stream = _Checked(file, path.stat().st_size)
            yield from _Scan(str(path), wanted, topics).of(_records(stream))
    except InputError:
        raise
    except EOFError:
        fault = "it ends too soon (`mcap recover` may save what is there)"
        raise InputError(str(path), "", None, f"{WHOLE}: {fault}") from None
    except (ValueError, struct.error, zstandard.ZstdError) as error:
        raise InputError(str(path), "", None, f"{WHOLE}: {error}") from None
    except RuntimeError as error:  # what lz4 raises
        raise InputError(str(path), "", None, f"{WHOLE}: {error}") from None


class _Checked:
    """A file that is never asked for more than it has."""

    def __init__(self, file: BinaryIO, size: int) -> None:
        self._file = file
        self._left = size

    def read(self, length: int) -> bytes:
        """Return exactly so many bytes."""
        if length > self._left:
            raise EOFError
        self._left -= length
        return self._file.read(length)


class _Scan:
    """What is known of a file while it is read."""

    def __init__(
        self, name: str, wanted: Callable[[str, str], bool], topics: dict[str, str]
    ) -> None:
        self._name = name
        self._wanted = wanted
        self._topics = topics
        self._schemas: dict[int, str] = {}
        self._channels: dict[int, tuple[str, str] | None] = {}
        """Topic and type by number; None where nobody wants it."""

    def of(self, records: Iterator[tuple[int, bytes]]) -> Iterator[Message]:
        """Yield the wanted messages."""
        chunk: bytes | None = None
        indexed: set[int] = set()
        for code, body in records:
            if code == MESSAGE_INDEX:
                indexed.add(struct.unpack_from("<H", body)[0])
                continue
            if chunk is not None:
                yield from self._unpacked(chunk, indexed)
                chunk = None
            if code == CHUNK:
                chunk, indexed = body, set()
            elif (message := self._record(code, body)) is not None:
                yield message

    def _record(self, code: int, body: bytes) -> Message | None:
        """Take in one record, and return it if it is a wanted message."""
        if code == MESSAGE:
            number, _, stamp, _ = HEAD.unpack_from(body)
            channel = self._channel(number)
            return channel and Message(*channel, stamp, body[HEAD.size :])
        if code in (SCHEMA, CHANNEL):
            from mcap.data_stream import ReadDataStream
            from mcap.records import Channel, Schema

            kind = Schema if code == SCHEMA else Channel
            stream = _Checked(BytesIO(body), len(body))
            self._learn(kind.read(ReadDataStream(stream)))
        return None

    def _learn(self, record: McapRecord) -> None:
        """Take note of a schema or a channel."""
        from mcap import records as kinds

        if isinstance(record, kinds.Schema):
            self._schemas[record.id] = record.name
        elif isinstance(record, kinds.Channel):
            kind = self._schemas.get(record.schema_id, "")
            self._topics[record.topic] = kind
            is_wanted = self._wanted(record.topic, kind)
            if is_wanted and record.message_encoding != CDR:
                encoding = record.message_encoding
                raise InputError(self._name, record.topic, encoding, "messages in cdr")
            self._channels[record.id] = (record.topic, kind) if is_wanted else None

    def _channel(self, number: int) -> tuple[str, str] | None:
        if number not in self._channels:
            raise DamageError(f"a message of channel {number}, which is not announced")
        return self._channels[number]

    def _unpacked(self, body: bytes, indexed: set[int]) -> Iterator[Message]:
        """Yield the wanted messages of a chunk."""
        from mcap.data_stream import ReadDataStream
        from mcap.records import Chunk

        if indexed and not any(self._channels.get(k, True) for k in indexed):
            return
        stream = _Checked(BytesIO(body), len(body))
        data, place = _plain(Chunk.read(ReadDataStream(stream))), 0
        while place < len(data):
            start = place + 9
            end = start + LENGTH.unpack_from(data, place + 1)[0]
            if end > len(data):
                raise DamageError("a record that goes beyond its chunk")
            message = self._record(data[place], data[start:end])
            if message is not None:
                yield message
            place = end


def _records(stream: _Checked) -> Iterator[tuple[int, bytes]]:
    """Yield opcode and content of each record of a file, up to its end."""
    magic = stream.read(len(MAGIC))
    if magic != MAGIC:
        raise DamageError(f"invalid magic {magic!r}")
    check = zlib.crc32(magic)
    code = 0
    while code != FOOTER:
        head = stream.read(9)
        code, length = head[0], LENGTH.unpack_from(head, 1)[0]
        if length > LIMIT:
            raise DamageError(f"a record of {length} bytes that exceeds limit {LIMIT}")
        body = stream.read(length)
        if code == DATA_END and struct.unpack("<I", body)[0] not in (0, check):
            raise DamageError("data whose checksum is wrong")
        check = zlib.crc32(body, zlib.crc32(head, check))
        yield code, body
    if stream.read(len(MAGIC)) != MAGIC:
        raise DamageError("invalid magic at its end")


def _plain(chunk: Chunk) -> bytes:
    """Return a chunk's records, unpacked to no more than it says."""
    import lz4.frame
    import zstandard

    size = chunk.uncompressed_size
    if size > LIMIT:
        raise DamageError(f"a chunk of {size} bytes; at most {LIMIT} are read")
    if chunk.compression == "zstd":
        unpacker = zstandard.ZstdDecompressor(max_window_size=LIMIT)
        with unpacker.stream_reader(chunk.data) as packed:
            data = packed.read(size + 1)
    elif chunk.compression == "lz4":
        data = lz4.frame.LZ4FrameDecompressor().decompress(chunk.data, size + 1)
    elif chunk.compression == "":
        data = chunk.data
    else:
        raise DamageError(f"chunks packed by {chunk.compression!r}")
    if len(data) != size:
        raise DamageError(f"a chunk of {len(data)} bytes that should have {size}")
    if chunk.uncompressed_crc and zlib.crc32(data) != chunk.uncompressed_crc:
        raise DamageError("a chunk whose checksum is wrong")
    return bytes(data)
