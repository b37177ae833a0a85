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
           {.name = "neighbourhood",
            .field = AT(synthesis.search.neighbourhood),
            .range = {3, 11},
            .unit = "px",
            .meaning = "Side of the patches that are compared, odd: 3 … 11. About the size of the "
                       "painting's elements; larger keeps longer strokes and takes longer."},
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

}  // namespace belvedere
