#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "renderer/paint/palette.h"

namespace belvedere {

// The look of a painting without the painting: its colours, its brushwork and its sky. All colours
// here are OKLab (L, a, b), those of the palette encoded sRGB. Lengths of strokes are pixels of the
// painting's file; units_per_px turns them into units of the sheet (0.5 mm).

// How the painting lays the strokes of one class.
struct StyleBrushwork {
  double length_px = 0.0;            // of a stroke, 1…20; 0: the class has no strokes of its own
  double width_px = 0.0;             // 0.5…5
  double level = 0.0;                // mean of cos 2θ over strokes: 1 level, -1 upright
  double form = 0.0;                 // mean of cos 2(θ - direction of larger forms): 1 along them
  double coherence = 0.0;            // 0…1: how much neighbouring strokes agree in direction
  double lightness_deviation = 0.0;  // of the residuals' L
  // Colour of a stroke against the mean colour around it, a list for each third of lightness, dark
  // to light.
  std::array<std::vector<glm::vec3>, 3> residuals;
  std::vector<glm::vec3> accents;  // colours of the most colourful strokes
};

// One change of the sky's colour: `axis` (OKLab, of one deviation, towards light) times an amount
// whose correlation has fallen to one half at these lengths along and down.
struct StyleSkyChange {
  glm::vec3 axis{0.0F};
  double length_x = 0.3;  // shares of the sky's width and height, > 0
  double length_y = 0.3;
  std::array<double, 7>
      quantiles{};  // of the change's amount, at shares 0.02 0.1 0.25 0.5 0.75 0.9 0.98
};

struct StyleSky {
  // 5 rows from the top to the horizon, of 3 from left to right; empty: the painting has no sky.
  Grid<glm::vec3> medians;
  std::vector<StyleSkyChange> changes;  // at most 2
};

struct Style {
  std::string name;
  std::string origin;  // painter, title, year and where the picture comes from
  std::string licence;
  Palette palette;
  std::array<StyleBrushwork, land_cover_class_count> brushwork;  // [sky] as well
  StyleSky sky;
  double units_per_px = 1.2;  // units of the sheet a pixel of the painting covers, 1…2.6
  double broken =
      0.0;  // spread of lightness of strokes, over that of forms: how much paint shows, 0…2
  double vapour = 0.0;          // 0…1: how much of the middle forms the air dissolves
  double form_deviation = 0.0;  // of lightness between sigma 2 and 12 px, on the ground: how strong
                                // middle forms are
  glm::vec3 trend{0.0F};        // change of colour from the ground's foot to its top
  double hue_by_light = 0.0;    // 0…1: share of the hue's variance that lightness alone explains
  std::vector<std::string> notes;  // what was derived and from what, for people
};

}  // namespace belvedere
