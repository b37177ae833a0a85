"""Panorama maps from elevation models, in the look of a painting. See docs/python.md.

    import belvedere

    scene = belvedere.new("my_dem.tif", towards="south")
    scene["sun.azimuth_deg"] = 300
    picture = scene.draw(width=1000)      # uint8 (height, width, 3)
    guidance = scene.guidance(width=1000, channels=["Z", "landcover.id"])
    scene.render("out")
"""

from belvedere import style, textures
from belvedere._belvedere import version as __version__
from belvedere._error import Error
from belvedere._guidance import Channel, Guidance, channels
from belvedere._scene import Scene, new
from belvedere._synthesis import synthesize
from belvedere._terrain import deform, generalize, generalize_presets

__all__ = [
    "Channel",
    "Error",
    "Guidance",
    "Scene",
    "__version__",
    "channels",
    "deform",
    "generalize",
    "generalize_presets",
    "new",
    "style",
    "synthesize",
    "textures",
]
