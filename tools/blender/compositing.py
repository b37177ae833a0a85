"""Composites a panorama in Blender: lit from another side, fog in the distance, a class recoloured.

    belvedere render SCENE --channels blender --out out
    blender -b -P tools/blender/compositing.py -- out/guidance.exr out/panorama.png composite.png

The picture may be any of the same size: the panorama, one with names, or one painted over by hand.
The nodes are those that a compositor builds in the editor; --blend saves them to look at and change.
Written for Blender 3.4 (Debian 12).
"""
import argparse
import math
import os
import sys

import bpy


def arguments():
    parser = argparse.ArgumentParser(prog="compositing.py", description=__doc__.splitlines()[0])
    parser.add_argument("guidance", help="guidance.exr of render --channels blender")
    parser.add_argument("picture", help="the picture to composite")
    parser.add_argument("out", help="PNG to write")
    parser.add_argument("--sun", type=float, nargs=2, default=(285.0, 14.0), metavar=("AZIMUTH", "HEIGHT"),
                        help="the new light, degrees clockwise from north and above the horizon (%(default)s)")
    parser.add_argument("--light", type=float, default=0.75, help="strength of the new light, 0…1 (%(default)s)")
    parser.add_argument("--fog", type=float, nargs=2, default=(38.0, 80.0), metavar=("FROM", "TO"),
                        help="fog from nothing to its full strength, km from the eye (%(default)s)")
    parser.add_argument("--density", type=float, default=0.75, help="full strength of the fog, 0…1 (%(default)s)")
    parser.add_argument("--mask", default="forest", help="classes to recolour, separated by commas (%(default)s)")
    parser.add_argument("--tint", type=float, nargs=3, default=(2.1, 0.95, 0.45), metavar=("R", "G", "B"),
                        help="factors of the recoloured classes, linear light (%(default)s)")
    parser.add_argument("--blend", help="also save the nodes as a .blend file")
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
    inputs = [os.path.realpath(path) for path in (options.guidance, options.picture)]
    for written in filter(None, (options.out, options.blend)):
        if os.path.realpath(written) in inputs:
            parser.error(f"{written} is read by this command: name another file to write")
    return options


class Graph:
    """Adds nodes and links them; columns of the editor from left to right."""

    def __init__(self, tree):
        self.tree = tree
        self.count = 0
        for node in list(tree.nodes):
            tree.nodes.remove(node)

    def add(self, kind, inputs=(), **settings):
        node = self.tree.nodes.new("CompositorNode" + kind)
        node.location = (220 * (self.count // 4), -260 * (self.count % 4))
        self.count += 1
        for name, value in settings.items():
            setattr(node, name, value)
        for at, value in enumerate(inputs):
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, node.inputs[at])
            elif value is not None:
                node.inputs[at].default_value = value
        return node

    def math(self, operation, *inputs, clamp=False):
        return self.add("Math", inputs, operation=operation, use_clamp=clamp).outputs[0]

    def mix(self, blend, factor, below, above):
        return self.add("MixRGB", (factor, below, above), blend_type=blend).outputs[0]


def sun_direction(azimuth_deg, height_deg):
    azimuth, height = math.radians(azimuth_deg), math.radians(height_deg)
    return math.sin(azimuth) * math.cos(height), math.cos(azimuth) * math.cos(height), math.sin(height)


def build(graph, options):
    passes = graph.add("Image", image=bpy.data.images.load(options.guidance))
    if "Depth" not in passes.outputs or "CryptoLandCover00" not in passes.outputs:
        sys.exit(f"{options.guidance}: has no passes; write it with belvedere render --channels blender")
    picture = graph.add("Image", image=bpy.data.images.load(options.picture))
    size = tuple(picture.image.size)

    def mask_of(names):
        node = graph.add("CryptomatteV2", source="IMAGE")
        node.image = passes.image
        node.layer_name = "ViewLayer.CryptoLandCover"
        node.matte_id = names
        return node.outputs["Matte"]

    land = graph.math("SUBTRACT", 1.0, mask_of("sky"), clamp=True)

    # A class by its name.
    tinted = graph.mix("MULTIPLY", mask_of(options.mask), picture.outputs["Image"], (*options.tint, 1.0))

    # Light from another side: cosine of its angle to the ground, warm on slopes that face it, blue on others. Hollows stay as dark as their share
    # of the sky makes them.
    parts = graph.add("SeparateXYZ", (passes.outputs["Normal"],)).outputs
    cosine = 0.0
    for component, value in zip(parts, sun_direction(*options.sun)):
        cosine = graph.add("Math", (component, value, cosine), operation="MULTIPLY_ADD").outputs[0]
    facing = graph.math("MULTIPLY", graph.math("MAXIMUM", cosine, 0.0), passes.outputs["AO"])
    light = graph.mix("MIX", facing, (0.34, 0.40, 0.58, 1.0), (2.7, 1.75, 0.95, 1.0))
    lit = graph.mix("MULTIPLY", graph.math("MULTIPLY", land, options.light), tinted, light)

    # Fog by distance, by two plain nodes: Map Range takes everything beyond 10 km as infinitely far. The sky, 1e10 m away, has none.
    start, end = (1000.0 * km for km in options.fog)
    away = graph.math("DIVIDE", graph.math("SUBTRACT", passes.outputs["Depth"], start), end - start, clamp=True)
    strength = graph.math("MULTIPLY", away, options.density)
    fog = graph.math("MULTIPLY", strength, land)
    foggy = graph.mix("MIX", fog, lit, (0.86, 0.74, 0.66, 1.0))
    graph.add("Composite", (foggy,))
    return size


def main():
    options = arguments()
    scene = bpy.context.scene
    scene.use_nodes = True
    width, height = build(Graph(scene.node_tree), options)
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.use_sequencer = False
    render.dither_intensity = 0.0
    render.image_settings.file_format = "PNG"
    render.image_settings.color_mode = "RGB"
    render.image_settings.color_depth = "16"
    render.filepath = bpy.path.abspath(options.out)
    # The colours of the picture, without Blender's own look.
    scene.view_settings.view_transform = "Standard"
    if options.blend:
        bpy.ops.wm.save_as_mainfile(filepath=bpy.path.abspath(options.blend))
    bpy.ops.render.render(write_still=True)


main()
