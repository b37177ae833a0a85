#include "renderer/scene/scene_table.h"

namespace belvedere {

std::vector<SceneSection> make_exemplar_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "exemplar",
       .kind = SectionKind::list,
       .meaning = "One block for each painting whose hand is taken over: a picture with its classes, or one the program paints itself. "
                  "Without a block the program paints one.",
       .keys =
           {
               {.name = "picture",
                .field = AT(exemplars[i].picture),
                .meaning = "The painting or scan; without it the program paints one on a made-up terrain.",
                .text = TextKind::file},
               {.name = "model",
                .field = AT(exemplars[i].model),
                .meaning =
                    "Instead of a picture: a texture model (`belvedere texture learn`), from which the classes in serves are painted "
                    "without end.",
                .text = TextKind::file},
               {.name = "prefer",
                .field = AT(exemplars[i].prefer),
                .meaning = "With model: a class is painted from it where exemplars have no texels of it or so few that they would repeat "
                           "(texels), or in any case (model).",
                .text = TextKind::choice,
                .choices = {"texels", "model"}},
               {.name = "light",
                .field = AT(exemplars[i].light),
                .meaning = "With model: whether it paints all ground of its classes, or what lies in the light (lit) or in the shade "
                           "(shaded) alone; another block then serves the rest.",
                .text = TextKind::choice,
                .choices = {"any", "lit", "shaded"}},
               {.name = "guidance",
                .field = AT(exemplars[i].guidance),
                .meaning = "guidance.exr of the picture, registered to the pixel; or classes and altitude instead.",
                .text = TextKind::file},
               {.name = "classes",
                .field = AT(exemplars[i].classes),
                .meaning = "Grey image of the picture's size with the number of each pixel's class; 255 is never copied from.",
                .text = TextKind::file},
               {.name = "altitude",
                .field = AT(exemplars[i].altitude),
                .meaning = "Grey image of the picture's size: altitude from black to white.",
                .text = TextKind::file},
               {.name = "altitude_range_m",
                .field = AT(exemplars[i].altitude_range_m),
                .range = {-12000, 1e5},
                .unit = "m",
                .meaning = "What black and white mean in it."},
               {.name = "shadow",
                .field = AT(exemplars[i].shadow),
                .meaning = "Grey image of the picture's size: black where it shows cast shadow, white where the sun shines.",
                .text = TextKind::file},
               {.name = "found_shadow",
                .field = AT(exemplars[i].found_shadow),
                .meaning =
                    "What becomes of places that are dark and cool for their class, where no image or guidance tells the shadow: they "
                    "serve shaded ground, are never copied from, or count as any other.",
                .text = TextKind::choice,
                .choices = {"guide", "exclude", "ignore"}},
               {.name = "exclude",
                .field = AT(exemplars[i].exclude),
                .meaning = "Grey image of the picture's size: what is not black is no paint (lettering, frames, figures).",
                .text = TextKind::file},
               {.name = "excluded",
                .field = AT(exemplars[i].excluded),
                .meaning =
                    "What becomes of it: never copied from (skip), or made anew from the paint around it, class by class, and copied "
                    "like the rest (fill).",
                .text = TextKind::choice,
                .choices = {"skip", "fill"}},
               {.name = "serves",
                .field = AT(exemplars[i].serves),
                .meaning = "Classes it may be copied for, or painted from a model: [\"rock\", \"snow\"]; without it every class it shows."},
               {.name = "stroke_px",
                .field = AT(exemplars[i].stroke_px),
                .range = {0.5, 100},
                .unit = "px",
                .meaning = "Where the painting's light must be told from the painting itself: what is larger than this is light, what is "
                           "smaller a stroke."},
               {.name = "origin", .field = AT(exemplars[i].origin), .meaning = "Who painted it, and when."},
               {.name = "licence", .field = AT(exemplars[i].licence), .meaning = "Under which terms it may be used."},
               {.name = "get_from", .field = AT(exemplars[i].get_from), .meaning = "Where to get it; shown when a file is missing."},
               {.name = "optional",
                .field = AT(exemplars[i].optional),
                .meaning = "Where a file is missing, the exemplar is left out with a note instead of an error."},
               {.name = "width",
                .field = AT(exemplars[i].width),
                .range = {0, 16384},
                .unit = "px",
                .meaning =
                    "Width of one that the program paints. 0: as large as the print needs, a texel for eight pixels, from 2000 × 1400 "
                    "to 24 Mpx; up to 8192 × 8192 has its use where memory allows, about 80 bytes a texel."},
               {.name = "height",
                .field = AT(exemplars[i].height),
                .range = {0, 16384},
                .unit = "px",
                .meaning = "Height of one that the program paints; 0: seven tenths of the width."},
               {.name = "seed",
                .field = AT(exemplars[i].seed),
                .range = {0, largest_seed},
                .meaning = "Another number gives another made-up terrain and other strokes."},
           },
       .count = [](const Scene& s) { return s.exemplars.size(); },
       .resize = [](Scene& s, std::size_t n) { s.exemplars.resize(n); }});
  return sections;
}

}  // namespace belvedere
