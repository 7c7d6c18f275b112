"""A reader of MCAP files that shares nothing with Helical's own: the format's text (https://mcap.dev/spec), struct,
zlib's CRC and the zstd library. Raises where the file breaks a rule of the format."""

import ctypes
import struct
import zlib

MAGIC = b"\x89MCAP0\r\n"
FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX = 2, 3, 4, 5, 6, 7, 8
ATTACHMENT, ATTACHMENT_INDEX, STATISTICS, DATA_END = 9, 10, 11, 15


ZSTD = ctypes.CDLL("libzstd.so.1")
ZSTD.ZSTD_decompress.restype = ctypes.c_size_t
ZSTD.ZSTD_decompress.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]


def unpack(packed, size):
    plain = ctypes.create_string_buffer(size)
    assert ZSTD.ZSTD_decompress(plain, size, packed, len(packed)) == size
    return plain.raw


class Fields:
    def __init__(self, content):
        self.content, self.at = content, 0

    def take(self, form):
        size = struct.calcsize("<" + form)
        (value,) = struct.unpack_from("<" + form, self.content, self.at)
        self.at += size
        return value

    def raw(self, size):
        assert self.at + size <= len(self.content)
        self.at += size
        return self.content[self.at - size:self.at]

    def text(self):
        return self.raw(self.take("I")).decode()

    def rest(self):
        return self.content[self.at:]


def records(content, start=0):
    """Opcode, offset and content of each record that is whole."""
    at = start
    while at + 9 <= len(content) and content[at:] != MAGIC:
        opcode, length = struct.unpack_from("<BQ", content, at)
        if at + 9 + length > len(content):
            return
        yield opcode, at, content[at + 9:at + 9 + length]
        at += 9 + length


class McapFile:
    """`messages`: (topic, log time, payload) in the file's order."""

    def __init__(self, path):
        with open(path, "rb") as file:
            self.content = file.read()
        assert self.content[:8] == MAGIC
        self.schemas, self.channels, self.attachments, self.messages = {}, {}, {}, []
        self.counts, self.chunks, self.complete = {}, {}, False
        for opcode, at, content in records(self.content, 8):
            if opcode == FOOTER:
                self.check_summary(at, content)
                break
            self.add(opcode, at, Fields(content))

    def add(self, opcode, at, fields):
        if opcode == SCHEMA:
            number, name = fields.take("H"), fields.text()
            assert fields.text() == "ros2msg"
            self.schemas[number] = (name, fields.text())
        elif opcode == CHANNEL:
            number, schema = fields.take("H"), fields.take("H")
            assert schema in self.schemas
            self.channels[number] = (fields.text(), self.schemas[schema][0])
            assert fields.text() == "cdr"
        elif opcode == ATTACHMENT:
            fields.raw(16)
            name = fields.text()
            fields.text()
            self.attachments[name] = fields.raw(fields.take("Q"))
            assert zlib.crc32(fields.content[:fields.at]) == fields.take("I")
        elif opcode == CHUNK:
            self.add_chunk(at, fields)
        elif opcode == MESSAGE_INDEX:
            self.check_message_index(fields)
        elif opcode == DATA_END:
            assert fields.take("I") == zlib.crc32(self.content[:at])

    def add_chunk(self, at, fields):
        start, end, size, crc = (fields.take(form) for form in "QQQI")
        assert fields.text() == "zstd"
        plain = unpack(fields.raw(fields.take("Q")), size)
        assert zlib.crc32(plain) == crc
        self.last_chunk, times = {}, []
        for opcode, offset, content in records(plain):
            assert opcode == MESSAGE
            message = Fields(content)
            channel, sequence, time = message.take("H"), message.take("I"), message.take("Q")
            message.take("Q")
            assert sequence == self.counts.get(channel, 0)
            self.counts[channel] = sequence + 1
            self.messages.append((self.channels[channel][0], time, message.rest()))
            self.last_chunk.setdefault(channel, []).append((time, offset))
            times.append(time)
        assert (min(times), max(times)) == (start, end)
        self.chunks[at] = (start, end)

    def check_message_index(self, fields):
        channel = fields.take("H")
        entries = Fields(fields.raw(fields.take("I")))
        listed = [(entries.take("Q"), entries.take("Q")) for _ in range(len(entries.content) // 16)]
        assert listed == self.last_chunk[channel]

    def check_summary(self, at, content):
        fields = Fields(content)
        start, offsets, crc = fields.take("Q"), fields.take("Q"), fields.take("I")
        assert zlib.crc32(self.content[start:at + 9 + 16]) == crc
        assert start < offsets < at and self.content[-8:] == MAGIC
        seen = {}
        for opcode, _, record in records(self.content[:at], start):
            seen.setdefault(opcode, []).append(record)
        assert [Fields(c).take("Q") for c in seen.get(CHUNK_INDEX, [])] == [c[0] for c in self.chunks.values()]
        for record, where in zip(seen.get(CHUNK_INDEX, []), self.chunks):
            index = Fields(record)
            index.raw(16)
            assert index.take("Q") == where
        statistics = Fields(seen[STATISTICS][0])
        counted = tuple(statistics.take(form) for form in "QHIIII")
        assert counted == (len(self.messages), len(self.schemas), len(self.channels), len(self.attachments), 0,
                           len(self.chunks))
        assert len(seen[ATTACHMENT_INDEX]) == len(self.attachments)
        self.complete = True

    def of(self, topic):
        return [(time, payload) for name, time, payload in self.messages if name == topic]


def pose(payload):
    """Position x y z and quaternion x y z w of a PoseStamped or PoseWithCovarianceStamped, by hand."""
    assert payload[:4] == b"\0\1\0\0"
    body = payload[4:]
    (size,) = struct.unpack_from("<I", body, 8)
    at = (12 + size + 7) // 8 * 8
    return struct.unpack_from("<7d", body, at)
