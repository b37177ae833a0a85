#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "base/grid.h"
#include "terrain/layers/fit/fit_measures.h"

namespace belvedere {

// Under which sun a picture was taken, and what its light did to it.
struct PictureSun {
  double azimuth_deg = 0.0;    // 0…360, clockwise from the picture's top
  double elevation_deg = 0.0;  // 0…90
  double correlation = 0.0;    // of brightness with the light that this sun gives
};

// Cosine of incidence of the sun on ground whose normals are those of the altitudes blurred by a cell; 0 where it faces away and where
// other ground stands before the sun.
Grid<float> sunlight(const Grid<float>& altitude_m, double cell_m, const PictureSun& sun);

// The sun whose light correlates best with the brightness of the cells in use, by steps of 5° of azimuth and 4° of elevation, 18…70°. Where
// clouds have told the azimuth, only elevations are tried. `labels` (may be empty): the brightness of each label is taken from its mean, so
// that what the ground is made of does not count as light.
PictureSun find_sun(const Grid<float>& altitude_m, double cell_m, const Grid<float>& brightness, const std::vector<std::uint8_t>& labels,
                    const Grid<std::uint8_t>& use, std::optional<double> azimuth_deg);

// How a channel of a class answers to light: base + gain · cos i (the C-correction of Teillet, Guindon and Goodenough 1982, c = base /
// gain).
struct LightAnswer {
  double gain = 0.0;
  double base = 1.0;
};
using LightAnswers = std::vector<std::array<LightAnswer, 3>>;  // of each class
// By least squares over the cells of the class in use that the sun reaches (cos i > .05); a class of fewer than 50 of them answers as all
// do.
LightAnswers light_answers(const Grid<glm::vec3>& picture, const Grid<float>& light, const std::vector<std::uint8_t>& labels, int classes,
                           const Grid<std::uint8_t>& use);
// Of a channel: what it would be on level ground over what it is at cos i. 1 where it does not answer to light.
double levelling(const LightAnswer& answer, double cos_incidence, double level_cos);
// The picture as on level ground: each cell by the answers of its class (no_class: those of class 0).
Grid<glm::vec3> lit_evenly(const Grid<glm::vec3>& picture, const Grid<float>& light, double level_cos,
                           const std::vector<std::uint8_t>& labels, const LightAnswers& answers);

}  // namespace belvedere
