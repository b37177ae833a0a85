"""Reads channels of a guidance.exr: OpenEXR of several tiled parts, packed by ZIP, as the program
writes it (openexr.com/en/latest/OpenEXRFileLayout.html). GDAL in Debian reads no OpenEXR."""
import mmap
import struct
import zlib
from typing import Dict, Iterable, Tuple

import numpy as np

_types = {0: np.dtype("<u4"), 1: np.dtype("<f2"), 2: np.dtype("<f4")}


def _text(data: bytes, at: int) -> Tuple[str, int]:
    end = data.find(b"\0", at)
    return data[at:end].decode("utf-8"), end + 1


class _Part:
    """The header of a part; without attributes it is the end of the headers."""

    def __init__(self, data: bytes, at: int):
        self.values = {}
        while data[at]:
            name, at = _text(data, at)
            _, at = _text(data, at)  # its type, which follows from the name
            (length,) = struct.unpack_from("<i", data, at)
            self.values[name] = data[at + 4 : at + 4 + length]
            at += 4 + length
        self.end = at + 1
        if not self.values:
            return
        if "tiles" not in self.values or self.values["compression"][0] not in (0, 2, 3):
            raise ValueError("an OpenEXR file of another program: no tiles, or not packed by ZIP")
        x0, y0, x1, y1 = struct.unpack("<4i", self.values["dataWindow"])
        self.width, self.height = x1 - x0 + 1, y1 - y0 + 1
        self.tile = struct.unpack_from("<2I", self.values["tiles"])
        self.chunks = -(-self.width // self.tile[0]) * -(-self.height // self.tile[1])
        self.channels, at = [], 0
        listed = self.values["channels"]
        while listed[at]:
            name, at = _text(listed, at)
            self.channels.append((name, _types[struct.unpack_from("<i", listed, at)[0]]))
            at += 16


def _unpacked(data: bytes, size: int) -> np.ndarray:
    """Bytes of a tile: differences of neighbours, the even bytes before the odd ones."""
    if len(data) == size:  # packing did not help
        return np.frombuffer(data, np.uint8)
    steps = np.frombuffer(zlib.decompress(data), np.uint8).copy()
    steps[1:] -= np.uint8(128)
    out = np.empty(size, np.uint8)
    out[0::2], out[1::2] = np.split(np.cumsum(steps, dtype=np.uint8), [(size + 1) // 2])
    return out


def read(path: str, wanted: Iterable[str]) -> Dict[str, np.ndarray]:
    """The channels of these names, rows × columns. Throws ValueError for a file of another program,
    and for a channel that the file lacks."""
    with open(path, "rb") as file:  # larger ones than memory, too, of which channels are read
        data = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    magic, version = struct.unpack_from("<II", data)
    if magic != 20000630:
        raise ValueError(f"{path} is no OpenEXR file")
    many = bool(version & 0x1000)
    parts = [_Part(data, 8)]
    while many and parts[-1].values:
        parts.append(_Part(data, parts[-1].end))
    first = parts[-1].end
    parts = [part for part in parts if part.values]
    out = {name: np.zeros((part.height, part.width), kind)
           for part in parts for name, kind in part.channels if name in wanted}
    if set(wanted) - set(out):
        raise ValueError(f"{path} has no channel {', '.join(sorted(set(wanted) - set(out)))}")
    for start in np.frombuffer(data, "<u8", sum(part.chunks for part in parts), first).tolist():
        number = struct.unpack_from("<i", data, start)[0] if many else 0
        start += 4 if many else 0
        _read_tile(parts[number], data, start, out)
    return out


def _read_tile(part: _Part, data: bytes, start: int, out: Dict[str, np.ndarray]) -> None:
    tile_x, tile_y, _, _, length = struct.unpack_from("<5i", data, start)
    wanted = [name for name, _ in part.channels if name in out]
    if not wanted:
        return
    x, y = tile_x * part.tile[0], tile_y * part.tile[1]
    width, height = min(part.tile[0], part.width - x), min(part.tile[1], part.height - y)
    row = np.dtype([(name, kind, (width,)) for name, kind in part.channels])
    start += 20
    rows = _unpacked(data[start : start + length], row.itemsize * height).view(row)
    for name in wanted:
        out[name][y : y + height, x : x + width] = rows[name]
