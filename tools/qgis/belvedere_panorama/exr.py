"""Reads channels of a guidance.exr: an OpenEXR file of several tiled parts, packed by ZIP or not at
all, as the program writes them (openexr.com/en/latest/OpenEXRFileLayout.html). GDAL in Debian reads
no OpenEXR."""
import struct
import zlib
from typing import Dict, List, Tuple

import numpy as np

_types = {0: np.dtype("<u4"), 1: np.dtype("<f2"), 2: np.dtype("<f4")}


class NotReadable(ValueError):
    """The file is none that the program writes."""


def _text(data: bytes, at: int) -> Tuple[str, int]:
    end = data.index(b"\0", at)
    return data[at:end].decode("utf-8"), end + 1


def _header(data: bytes, at: int) -> Tuple[Dict[str, bytes], int]:
    """Attributes of a part; none after the last part."""
    values = {}
    while data[at]:
        name, at = _text(data, at)
        _, at = _text(data, at)
        (length,) = struct.unpack_from("<i", data, at)
        values[name] = data[at + 4 : at + 4 + length]
        at += 4 + length
    return values, at + 1


def _channels(data: bytes) -> List[Tuple[str, np.dtype]]:
    """Names and types in the order of the file, which is that of the alphabet."""
    out, at = [], 0
    while data[at]:
        name, at = _text(data, at)
        (kind,) = struct.unpack_from("<i", data, at)
        out.append((name, _types[kind]))
        at += 16
    return out


def _unpacked(data: bytes, size: int) -> np.ndarray:
    """Bytes of a tile: differences of neighbours, the even bytes before the odd ones."""
    if len(data) == size:  # packing did not help
        return np.frombuffer(data, np.uint8)
    steps = np.frombuffer(zlib.decompress(data), np.uint8).copy()
    steps[1:] -= np.uint8(128)
    bytes_ = np.cumsum(steps, dtype=np.uint8)
    out = np.empty(size, np.uint8)
    out[0::2], out[1::2] = np.split(bytes_, [(size + 1) // 2])
    return out


class _Part:
    def __init__(self, header: Dict[str, bytes]):
        try:
            x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
            self.tile = struct.unpack("<2IB", header["tiles"])[:2]
        except KeyError as missing:
            raise NotReadable(f"a part without {missing}") from missing
        if header["compression"][0] not in (0, 2, 3):
            raise NotReadable("a packing other than ZIP")
        self.width, self.height = x1 - x0 + 1, y1 - y0 + 1
        self.channels = _channels(header["channels"])
        across = -(-self.width // self.tile[0])
        self.chunks = across * -(-self.height // self.tile[1])


def read(path: str, wanted: List[str]) -> Dict[str, np.ndarray]:
    """The channels of these names, rows × columns. Throws NotReadable, and KeyError for a channel
    that the file lacks."""
    with open(path, "rb") as file:
        data = file.read()
    magic, version = struct.unpack_from("<II", data)
    if magic != 20000630:
        raise NotReadable("no OpenEXR file")
    many = bool(version & 0x1000)
    at, parts = 8, []
    while True:
        header, at = _header(data, at)
        if not header:
            break
        parts.append(_Part(header))
        if not many:
            break
    out = {name: np.zeros((part.height, part.width), kind)
           for part in parts for name, kind in part.channels if name in wanted}
    if set(wanted) - set(out):
        raise KeyError(f"{path} has no channel {', '.join(sorted(set(wanted) - set(out)))}")
    offsets = np.frombuffer(data, "<u8", sum(part.chunks for part in parts), at)
    for offset in offsets:
        start = int(offset)
        number = struct.unpack_from("<i", data, start)[0] if many else 0
        start += 4 if many else 0
        tile_x, tile_y, _, _, length = struct.unpack_from("<5i", data, start)
        _read_tile(parts[number], tile_x, tile_y, data[start + 20 : start + 20 + length], out)
    return out


def _read_tile(part: _Part, tile_x: int, tile_y: int, data: bytes,
               out: Dict[str, np.ndarray]) -> None:
    if not any(name in out for name, _ in part.channels):
        return
    x, y = tile_x * part.tile[0], tile_y * part.tile[1]
    width, height = min(part.tile[0], part.width - x), min(part.tile[1], part.height - y)
    bytes_of_row = width * sum(kind.itemsize for _, kind in part.channels)
    rows = _unpacked(data, bytes_of_row * height).reshape(height, bytes_of_row)
    first = 0
    for name, kind in part.channels:
        last = first + width * kind.itemsize
        if name in out:
            out[name][y : y + height, x : x + width] = (
                np.ascontiguousarray(rows[:, first:last]).view(kind)
            )
        first = last
