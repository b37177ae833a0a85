#include "renderer/paint/guides.h"
#include "renderer/scene/scene_table.h"

namespace belvedere {

std::vector<SceneSection> make_style_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "style",
       .meaning = "The look of a painting over the finished picture: its colours, strokes and "
                  "sky. style = \"NAME\" at the top of the file sets file = \"NAME\" here. See "
                  "style.md.",
       .keys = {
           {.name = "file",
            .field = AT(style.file),
            .meaning = "A built-in name, or a .toml file written by belvedere style fit. Empty: "
                       "the program's own look.",
            .text = TextKind::built_in,
            .choices_from = "styles"},
           {.name = "palette",
            .field = AT(style.palette),
            .range = {0, 1},
            .meaning = "Share of the painting's change of colour with distance. Its palette is "
                       "used unless `palette` names another."},
           {.name = "brushwork",
            .field = AT(style.brushwork),
            .range = {0, 1},
            .meaning = "Share of the painting's strokes. 0: the program's own strokes only."},
           {.name = "sky",
            .field = AT(style.sky),
            .range = {0, 1},
            .meaning = "Share of the painting's sky, in place of the program's sky and clouds."},
           {.name = "scale",
            .field = AT(style.scale),
            .range = {0.2, 8},
            .unit = "units of 0.5 mm",
            .meaning = "Size of a pixel of the painting on the sheet; larger values give larger "
                       "strokes.",
            .derived = "by the painting's size"},
           {.name = "winter",
            .field = AT(style.winter),
            .meaning = "Covers open ground with the style's snow, as the palette \"winter\" does."},
           {.name = "contour_lines",
            .field = AT(style.contour_lines),
            .range = {0, 1},
            .meaning = "Share of the painting's dark lines on silhouettes, as van Gogh drew them."},
           {.name = "relief",
            .field = AT(style.relief),
            .range = {0, 3},
            .meaning = "Strength of light on the relief of the paint."},
           {.name = "canvas",
            .field = AT(style.canvas),
            .range = {0, 3},
            .meaning = "Strength of the weave of the canvas."},
       }});
  return sections;
}

std::vector<SceneSection> make_synthesis_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "synthesis",
       .meaning = "How the painting's texture is laid on the land.",
       .keys = {
           {.name = "enabled",
            .field = AT(synthesis.enabled),
            .meaning =
                "Whether texture is copied from exemplars; otherwise everything is painted as "
                "strokes. true without an [[exemplar]] copies from a sheet that the program "
                "paints: its own strokes, at several times the cost.",
            .derived = "true where the scene has an [[exemplar]]"},
           {.name = "colours",
            .field = AT(synthesis.colours),
            .meaning = "Whose colours the picture takes: the scene's palette, or the paintings' "
                       "own, by class and light, with their sky.",
            .text = TextKind::choice,
            .choices = {"palette", "painting"}},
           {.name = "harmonize",
            .field = AT(synthesis.harmonize),
            .meaning = "Matches the colours of several paintings before they are used, class by "
                       "class: off leaves them, common brings them to a common mean and spread, "
                       "first to those of the first painting. regions ignores classes and matches "
                       "regions of similar colour to those of the first painting in similar "
                       "positions, for scans whose classes differ.",
            .text = TextKind::choice,
            .choices = {"off", "common", "first", "regions"}},
           {.name = "synthesize_seams",
            .field = AT(synthesis.synthesize_seams),
            .meaning = "Where two paintings or texture models meet, the pixels along the seam are "
                       "synthesized by a model of both."},
           {.name = "residual",
            .field = AT(synthesis.residual),
            .range = {0, 1},
            .meaning = "How much the scene's own light and air correct the texture: 0 leaves the "
                       "painting's colour."},
           {.name = "weights",
            .field = AT(synthesis.weights),
            .range = {0, 100},
            .meaning = "Weight of each guide, by name; a guide not named keeps the default, 0 "
                       "switches it off.",
            .choices = guide_names()},
           {.name = "fallback",
            .field = AT(synthesis.fallback),
            .meaning = "Class to copy from for a class that no exemplar has: shrub = \"forest\"."},
           {.name = "reuse",
            .field = AT(synthesis.search.reuse),
            .range = {0, 10},
            .meaning = "Strength of the penalty on repetition."},
           {.name = "distance",
            .field = AT(synthesis.search.distance),
            .meaning = "How two patches are compared: ssd sums squared differences of colour; "
                       "normalized leaves out the difference of their mean lightness, for "
                       "paintings whose light is uneven within a class.",
            .text = TextKind::choice,
            .choices = {"ssd", "normalized"}},
           {.name = "neighbourhood",
            .field = AT(synthesis.neighbourhood),
            .range = {3, 11},
            .unit = "px",
            .meaning = "Side of the patches that are compared, odd: 3 … 11. About the size of the "
                       "painting's elements; larger keeps longer strokes and takes longer.",
            .derived = "5, 7 or 9, by the length of the paintings' strokes; 7 without paintings"},
           {.name = "surroundings",
            .field = AT(synthesis.search.surroundings),
            .range = {0, 100},
            .meaning = "Weight of the classes around a pixel: forest beside meadow is copied from "
                       "forest beside meadow."},
           {.name = "surroundings_of",
            .field = AT(synthesis.search.surroundings_of),
            .meaning = "Which of the surrounding classes count: only the commonest, or all, each "
                       "by its share.",
            .text = TextKind::choice,
            .choices = {"commonest", "all"}},
           {.name = "class_dissimilarity",
            .field = AT(synthesis.class_dissimilarity),
            .range = {0, 1},
            .meaning = "Dissimilarity of two classes as surroundings, 0 (interchangeable) … 1, by "
                       "pair: \"forest/shrub\" = 0.3. Pairs not named have 1."},
           {.name = "copy_cap",
            .field = AT(synthesis.search.copy_cap),
            .range = {16, 100000},
            .unit = "px",
            .meaning =
                "Largest piece of the painting that may be copied whole, in pixels of area."},
           {.name = "levels",
            .field = AT(synthesis.search.levels),
            .range = {1, 8},
            .meaning = "Levels from coarse to fine; more levels transfer larger patterns."},
           {.name = "plan_mpx",
            .field = AT(synthesis.plan_mpx),
            .range = {0.001, 64},
            .unit = "Mpx",
            .meaning = "Texture is chosen for the whole sheet on a picture of it of at most this "
                       "size, and then refined in tiles of 1024 pixels. A larger value repeats "
                       "less on large sheets; a part of the sheet takes longer."},
       }});
  return sections;
}

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
                           "image gives the shadow and the program did not paint the picture: "
                           "guide uses them for shaded ground, exclude never copies from them, "
                           "ignore treats them like any other.",
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
