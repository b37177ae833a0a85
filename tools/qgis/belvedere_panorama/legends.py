"""Which of the program's built-in legends a land-cover raster has, by its values and its name."""
import re
from typing import Dict, Optional, Set

from qgis.core import QgsRasterLayer

# CORINE: the classes of each group of its nomenclature, 111 … 523.
_groups = {11: 2, 12: 4, 13: 3, 14: 2, 21: 3, 22: 3, 23: 1, 24: 4, 31: 3, 32: 4, 33: 5, 41: 2,
           42: 3, 51: 2, 52: 3}
# The codes of data/legends/*.toml, those that mean no data, and names of files.
CODES: Dict[str, Set[int]] = {
    "esa_worldcover": {*range(10, 101, 10), 95},
    "nlcd": {11, 12, *range(21, 25), 31, *range(41, 44), 51, 52, *range(71, 75), 81, 82, 90, 95},
    "fbfm40": {91, 92, 93, 98, 99, *range(101, 110), *range(121, 125), *range(141, 150),
               *range(161, 166), *range(181, 190), *range(201, 205)},
    "corine": {*range(1, 45), *(10 * g + i for g, n in _groups.items() for i in range(1, n + 1))},
}
NO_DATA: Dict[str, Set[int]] = {"esa_worldcover": {0}, "nlcd": {0, 127, 250, 255}, "fbfm40": {0},
                                "corine": {0, 48, 128, 255, 990, 995, 999}}
_names = {"esa_worldcover": r"world.?cover|esa", "nlcd": r"nlcd", "fbfm40": r"fbfm|landfire|lcp",
          "corine": r"corine|clc|u20\d\d"}
MOST_CELLS = 512  # of a side that are looked at


def infer(values: Set[int], name: str) -> Optional[str]:
    """The legend that has all these values; of several the one that the name tells, or else the one
    with the fewest codes. None if no legend has them all."""
    known = [legend for legend, codes in CODES.items()
             if values - NO_DATA[legend] and values <= codes | NO_DATA[legend]]
    named = [legend for legend in known if re.search(_names[legend], name, re.IGNORECASE)]
    return min(named or known, key=lambda legend: len(CODES[legend]), default=None)


def values_of(layer: QgsRasterLayer, band: int) -> Set[int]:
    """Values of up to MOST_CELLS² cells, evenly over the raster."""
    width, height = min(layer.width(), MOST_CELLS), min(layer.height(), MOST_CELLS)
    cells = layer.dataProvider().block(band, layer.extent(), width, height)
    return {int(cells.value(y, x)) for y in range(height) for x in range(width)
            if not cells.isNoData(y, x)}
