#include "renderer/scene/scene_table.h"

namespace belvedere {

std::vector<SceneSection> make_exemplar_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "exemplar",
       .kind = SectionKind::list,
       .meaning = "One block for each painting to copy from: a picture with its classes, or one "
                  "that the program paints. Without a block nothing is copied, unless "
                  "synthesis.enabled = true.",
       .keys =
           {
               {.name = "picture",
                .field = AT(exemplars[i].picture),
                .meaning =
                    "The painting or scan. Default: the program paints one of a synthetic terrain.",
                .text = TextKind::file},
               {.name = "model",
                .field = AT(exemplars[i].model),
                .meaning = "Instead of a picture: a texture model (`belvedere texture learn`), "
                           "which paints the classes in serves without repeating.",
                .text = TextKind::file},
               {.name = "prefer",
                .field = AT(exemplars[i].prefer),
                .meaning = "With model: texels uses it only for a class of which the exemplars "
                           "have no texels or so few that they would repeat; model always uses it.",
                .text = TextKind::choice,
                .choices = {"texels", "model"}},
               {.name = "light",
                .field = AT(exemplars[i].light),
                .meaning = "With model: any paints all ground of its classes, lit or shaded only "
                           "the ground in light or in shade; another block must serve the rest.",
                .text = TextKind::choice,
                .choices = {"any", "lit", "shaded"}},
               {.name = "guidance",
                .field = AT(exemplars[i].guidance),
                .meaning = "guidance.exr of the picture, registered to the pixel; or give classes, "
                           "altitude and distance instead.",
                .text = TextKind::file},
               {.name = "classes",
                .field = AT(exemplars[i].classes),
                .meaning = "Grey image of the picture's size with the number of each pixel's "
                           "class, also instead of those of guidance; 255 is never copied from.",
                .text = TextKind::file},
               {.name = "classes_from",
                .field = AT(exemplars[i].classes_from),
                .meaning = "With the guidance of a registered painting and without classes: paint "
                           "corrects its classes by the colours of the painting, guidance takes "
                           "them as they are.",
                .text = TextKind::choice,
                .choices = {"paint", "guidance"}},
               {.name = "altitude",
                .field = AT(exemplars[i].altitude),
                .meaning = "Grey image of the picture's size: altitude from black to white.",
                .text = TextKind::file},
               {.name = "altitude_range_m",
                .field = AT(exemplars[i].altitude_range_m),
                .range = {-12000, 1e5},
                .unit = "m",
                .meaning = "Altitudes of black and of white."},
               {.name = "distance",
                .field = AT(exemplars[i].distance),
                .meaning = "Grey image of the picture's size: distance from the viewer, black "
                           "near, white far; equal steps of grey are equal ratios of distance.",
                .text = TextKind::file},
               {.name = "distance_range_m",
                .field = AT(exemplars[i].distance_range_m),
                .range = {1, 1e6},
                .unit = "m",
                .meaning = "Distances of black and of white."},
               {.name = "trust",
                .field = AT(exemplars[i].trust),
                .meaning =
                    "Grey image of the picture's size: how far the place of a pixel is "
                    "known: white exactly, mid grey (128) to a hundredth of the picture's width, "
                    "black not at all. Guides are averages of what the place may be.",
                .text = TextKind::file},
               {.name = "shadow",
                .field = AT(exemplars[i].shadow),
                .meaning = "Grey image of the picture's size: black where it shows cast shadow, "
                           "white where the sun shines.",
                .text = TextKind::file},
               {.name = "found_shadow",
                .field = AT(exemplars[i].found_shadow),
                .meaning = "What happens to pixels that are dark and cool for their class, if no "
                           "image or guidance gives the shadow: guide uses them for shaded ground, "
                           "exclude never copies from them, ignore treats them like any other.",
                .text = TextKind::choice,
                .choices = {"guide", "exclude", "ignore"}},
               {.name = "exclude",
                .field = AT(exemplars[i].exclude),
                .meaning = "Grey image of the picture's size: pixels that are not black are not "
                           "paint (lettering, frames, figures).",
                .text = TextKind::file},
               {.name = "excluded",
                .field = AT(exemplars[i].excluded),
                .meaning = "What happens to those pixels: skip never copies from them; fill "
                           "synthesizes them from the paint around, class by class, and then "
                           "copies from them like from the rest.",
                .text = TextKind::choice,
                .choices = {"skip", "fill"}},
               {.name = "serves",
                .field = AT(exemplars[i].serves),
                .meaning = "Classes it may be copied for, or painted from a model: [\"rock\", "
                           "\"snow\"]. Default: every class it shows."},
               {.name = "stroke_px",
                .field = AT(exemplars[i].stroke_px),
                .range = {0.5, 100},
                .unit = "px",
                .meaning = "If the painting's light is inferred from the painting itself: "
                           "variation larger than this is light, smaller variation is strokes."},
               {.name = "origin",
                .field = AT(exemplars[i].origin),
                .meaning = "Who painted it, and when."},
               {.name = "licence",
                .field = AT(exemplars[i].licence),
                .meaning = "Under which terms it may be used."},
               {.name = "get_from",
                .field = AT(exemplars[i].get_from),
                .meaning = "Where to get it; shown when a file is missing."},
               {.name = "optional",
                .field = AT(exemplars[i].optional),
                .meaning = "If a file is missing, leave the exemplar out with a note instead of an "
                           "error."},
               {.name = "width",
                .field = AT(exemplars[i].width),
                .range = {0, 16384},
                .unit = "px",
                .meaning = "Width of one that the program paints. 0: as the print needs, one texel "
                           "per eight pixels, from 2000 × 1400 to 24 Mpx. Up to 8192 × 8192 is "
                           "useful if memory allows, about 80 bytes per texel."},
               {.name = "height",
                .field = AT(exemplars[i].height),
                .range = {0, 16384},
                .unit = "px",
                .meaning = "Height of one that the program paints; 0: 0.7 times the width."},
               {.name = "seed",
                .field = AT(exemplars[i].seed),
                .range = {0, largest_seed},
                .meaning = "Random seed of its synthetic terrain and strokes."},
           },
       .count = [](const Scene& s) { return s.exemplars.size(); },
       .resize = [](Scene& s, std::size_t n) { s.exemplars.resize(n); }});
  return sections;
}

}  // namespace belvedere
