#include "renderer/paint/guides.h"
#include "renderer/scene/scene_table.h"

namespace belvedere {

std::vector<SceneSection> make_synthesis_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "synthesis",
       .meaning = "How the painting's texture is laid over the land.",
       .keys = {
           {.name = "enabled", .field = AT(synthesis.enabled), .meaning = "false paints everything as strokes, without exemplars."},
           {.name = "colours",
            .field = AT(synthesis.colours),
            .meaning = "Whose colours the picture has: the scene's palette, or the paintings' own, by class and light, with their sky.",
            .text = TextKind::choice,
            .choices = {"palette", "painting"}},
           {.name = "harmonize",
            .field = AT(synthesis.harmonize),
            .meaning =
                "Colours of several paintings, class by class, before they are used: as they are, brought to a common mean and spread, "
                "or to those of the first painting; or, classes apart, regions of like colour with those of the first that stand "
                "where they do (regions: for scans whose classes are not alike).",
            .text = TextKind::choice,
            .choices = {"off", "common", "first", "regions"}},
           {.name = "knit",
            .field = AT(synthesis.knit),
            .meaning = "Where paint of two paintings or texture models meets, the pixels along the seam are made anew by a model of both."},
           {.name = "residual",
            .field = AT(synthesis.residual),
            .range = {0, 1},
            .meaning = "How far the scene's own light and air correct the texture: 0 is the painting's colour as it is."},
           {.name = "weights",
            .field = AT(synthesis.weights),
            .range = {0, 100},
            .meaning = "How strongly each guide steers, by name; a guide not named keeps the strength given here, 0 switches it off.",
            .choices = guide_names()},
           {.name = "fallback",
            .field = AT(synthesis.fallback),
            .meaning = "Class to copy from for a class that no exemplar has: shrub = \"forest\"."},
           {.name = "reuse", .field = AT(synthesis.search.reuse), .range = {0, 10}, .meaning = "How hard repetition is avoided."},
           {.name = "neighbourhood",
            .field = AT(synthesis.search.neighbourhood),
            .range = {3, 11},
            .unit = "px",
            .meaning =
                "Side of the patches that are compared, odd: 3 … 11. As large as the painting's elements; larger keeps longer strokes and "
                "takes longer."},
           {.name = "surroundings",
            .field = AT(synthesis.search.surroundings),
            .range = {0, 100},
            .meaning = "How much the classes around a place count: forest beside meadow is copied from forest beside meadow."},
           {.name = "surroundings_of",
            .field = AT(synthesis.search.surroundings_of),
            .meaning = "Which of the other classes around a place count: the commonest of them alone, or all, each by its share.",
            .text = TextKind::choice,
            .choices = {"commonest", "all"}},
           {.name = "unlikeness",
            .field = AT(synthesis.unlikeness),
            .range = {0, 1},
            .meaning = "How unlike two classes are as surroundings, 0 (one is as good as the other) … 1, by pair: \"forest/shrub\" = 0.3. "
                       "Pairs not named are wholly unlike."},
           {.name = "copy_cap",
            .field = AT(synthesis.search.copy_cap),
            .range = {16, 100000},
            .unit = "px",
            .meaning = "Largest piece of the painting that may be copied whole, in pixels of area."},
           {.name = "levels",
            .field = AT(synthesis.search.levels),
            .range = {1, 8},
            .meaning = "Steps from coarse to fine; more carries larger patterns over."},
           {.name = "plan_mpx",
            .field = AT(synthesis.plan_mpx),
            .range = {0.001, 64},
            .unit = "Mpx",
            .meaning =
                "Texture is chosen for the sheet as a whole on a picture of it of at most this size, and then refined in tiles of 1024 "
                "pixels. Larger sheets repeat less with more; a part of the sheet takes longer."},
       }});
  return sections;
}

}  // namespace belvedere
