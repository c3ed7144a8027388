"""How messages are laid into an MCAP file, thousands at a time.

The `mcap` library's own writer takes several microseconds a message, more than a
simulated robot takes for a look around. Here messages come as whole blocks of records;
the library writes the records around them.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable
from typing import TYPE_CHECKING, BinaryIO

from topomap.logs.ros_types import definition_of

if TYPE_CHECKING:
    import numpy as np
    from mcap.records import ChunkIndex, McapRecord
    from numpy.typing import NDArray

__all__ = ["Block", "McapWriter", "message_record"]

MAGIC = b"\x89MCAP0\r\n"
RECORD = struct.Struct("<BQHIQQ")
"""Opcode, length, channel, sequence, log time, publish time: before each message."""
MESSAGE, MESSAGE_INDEX = 0x05, 0x07
LATCHED = """- history: 1
  depth: 1
  reliability: 1
  durability: 1
  deadline:
    sec: 9223372036
    nsec: 854775807
  lifespan:
    sec: 9223372036
    nsec: 854775807
  liveliness: 1
  liveliness_lease_duration:
    sec: 9223372036
    nsec: 854775807
  avoid_ros_namespace_conventions: false"""
"""The quality of service of what a late listener must hear too."""


def message_record(channel: int, sequence: int, stamp: int, data: bytes) -> bytes:
    """Return one message as the record that stands in a chunk."""
    head = RECORD.pack(MESSAGE, 22 + len(data), channel, sequence, stamp, stamp)
    return head + data


class Block:
    """Message records that become one chunk, and where each of them stands."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.places: dict[int, list[tuple[int, int]]] = {}
        """Time and place of each message, by channel."""

    def add(self, channel: int, sequence: int, stamp: int, data: bytes) -> None:
        """Add one message; times are nanoseconds."""
        self.places.setdefault(channel, []).append((stamp, len(self.data)))
        self.data += message_record(channel, sequence, stamp, data)


class McapWriter:
    """An MCAP file of ROS 2 messages that is being written.

    Parameters
    ----------
    stream : binary file
        Written from its present place on, and not closed.
    library : str
        Who writes, for the header.
    """

    def __init__(self, stream: BinaryIO, library: str) -> None:
        from mcap.records import Header

        self._stream = stream
        self._place = 0
        self._schemas: dict[str, McapRecord] = {}
        self._channels: list[McapRecord] = []
        self._chunks: list[ChunkIndex] = []
        self._counts: dict[int, int] = {}
        self._span: tuple[int, int] | None = None
        self._write(MAGIC)
        self._write(_packed([Header("ros2", library)]))

    def channel(self, topic: str, kind: str, *, latched: bool = False) -> int:
        """Announce a topic and the type of its messages; return its number."""
        from mcap.records import Channel, Schema

        if kind not in self._schemas:
            number = len(self._schemas) + 1
            text = definition_of(kind).encode()
            schema = Schema(id=number, data=text, encoding="ros2msg", name=kind)
            self._schemas[kind] = schema
            self._write(_packed([schema]))
        number = len(self._channels) + 1
        schema_id = list(self._schemas).index(kind) + 1
        metadata = {"offered_qos_profiles": LATCHED} if latched else {}
        channel = Channel(
            id=number,
            topic=topic,
            message_encoding="cdr",
            metadata=metadata,
            schema_id=schema_id,
        )
        self._channels.append(channel)
        self._counts[number] = 0
        self._write(_packed([channel]))
        return number

    def chunk(
        self,
        data: bytes | memoryview,
        places: dict[int, NDArray[np.uint64]],
        first: int,
        last: int,
    ) -> None:
        """Write message records as one chunk.

        Parameters
        ----------
        data : bytes-like
            Records as `message_record` returns them.
        places : dict
            For each channel rows (time, place in `data`), in order of time.
        first, last : int
            Least and greatest time, in nanoseconds.
        """
        import zstandard
        from mcap.records import Chunk, ChunkIndex

        packed = zstandard.ZstdCompressor(level=1).compress(data)
        chunk = Chunk(
            compression="zstd",
            data=packed,
            message_start_time=first,
            message_end_time=last,
            uncompressed_crc=zlib.crc32(data),
            uncompressed_size=len(data),
        )
        start = self._place
        self._write(_packed([chunk]))
        length = self._place - start
        offsets: dict[int, int] = {}
        for channel, rows in places.items():
            offsets[channel] = self._place
            size = 16 * len(rows)
            head = struct.pack("<BQHI", MESSAGE_INDEX, 6 + size, channel, size)
            self._write(head + rows.astype("<u8").tobytes())
            self._counts[channel] += len(rows)
        self._chunks.append(
            ChunkIndex(
                message_start_time=first,
                message_end_time=last,
                chunk_start_offset=start,
                chunk_length=length,
                message_index_offsets=offsets,
                message_index_length=self._place - start - length,
                compression="zstd",
                compressed_size=len(packed),
                uncompressed_size=len(data),
            )
        )
        before = self._span or (first, last)
        self._span = min(before[0], first), max(before[1], last)

    def block(self, block: Block) -> None:
        """Write the messages of a block, if it has any, as one chunk."""
        import numpy as np

        stamps = [stamp for rows in block.places.values() for stamp, _ in rows]
        if stamps:
            places = {
                channel: np.array(sorted(rows), dtype=np.uint64)
                for channel, rows in block.places.items()
            }
            self.chunk(bytes(block.data), places, min(stamps), max(stamps))

    def finish(self) -> None:
        """Write what stands at the end: the summary, and where to find things."""
        from mcap.opcode import Opcode
        from mcap.records import DataEnd, Footer, Statistics, SummaryOffset

        self._write(_packed([DataEnd(0)]))
        first, last = self._span or (0, 0)
        statistics = Statistics(
            attachment_count=0,
            channel_count=len(self._channels),
            channel_message_counts=self._counts,
            chunk_count=len(self._chunks),
            message_count=sum(self._counts.values()),
            metadata_count=0,
            message_start_time=first,
            message_end_time=last,
            schema_count=len(self._schemas),
        )
        start = self._place
        offsets: list[McapRecord] = []
        summary = b""
        for code, records in (
            (Opcode.SCHEMA, list(self._schemas.values())),
            (Opcode.CHANNEL, self._channels),
            (Opcode.STATISTICS, [statistics]),
            (Opcode.CHUNK_INDEX, self._chunks),
        ):
            group = _packed(records)
            if group:
                offsets.append(SummaryOffset(code, start + len(summary), len(group)))
            summary += group
        offset_start = start + len(summary)
        summary += _packed(offsets)
        footer = _packed([Footer(start, offset_start, 0)])
        check = zlib.crc32(footer[:-4], zlib.crc32(summary))
        self._write(summary + footer[:-4] + struct.pack("<I", check) + MAGIC)

    def _write(self, data: bytes) -> None:
        self._stream.write(data)
        self._place += len(data)


def _packed(records: Iterable[McapRecord]) -> bytes:
    """Return records as bytes, as the library writes them."""
    from mcap.data_stream import RecordBuilder

    builder = RecordBuilder()
    for record in records:
        record.write(builder)
    return bytes(builder.end())
