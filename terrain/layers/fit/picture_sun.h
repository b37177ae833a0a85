#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "base/grid.h"
#include "terrain/layers/fit/fit_measures.h"

namespace belvedere {

// The sun under which a picture was taken, and its effect on the picture.
struct PictureSun {
  double azimuth_deg = 0.0;    // 0…360, clockwise from the picture's top
  double elevation_deg = 0.0;  // 0…90
  double correlation = 0.0;    // of brightness with the light of this sun
};

// Cosine of incidence of the sun on the altitudes blurred by a cell; 0 where the ground faces away
// or lies in cast shadow.
Grid<float> sunlight(const Grid<float>& altitude_m, double cell_m, const PictureSun& sun);

// The sun whose light correlates best with the brightness of the used cells, in steps of 5° of
// azimuth and 4° of elevation, 18…70°. With an azimuth from clouds, only elevations are tried.
// `labels` (may be empty): brightness is relative to the mean of each label, so that material does
// not count as light.
PictureSun find_sun(const Grid<float>& altitude_m, double cell_m, const Grid<float>& brightness,
                    const std::vector<std::uint8_t>& labels, const Grid<std::uint8_t>& use,
                    std::optional<double> azimuth_deg);

// Linear response of a channel of a class to light: base + gain · cos i (the C-correction of
// Teillet, Guindon and Goodenough 1982, c = base / gain).
struct LightAnswer {
  double gain = 0.0;
  double base = 1.0;
};
using LightAnswers = std::vector<std::array<LightAnswer, 3>>;  // of each class
// Fits the responses by least squares over the used sunlit cells of a class (cos i > .05); a class
// with fewer than 50 of them uses the response of all classes.
LightAnswers light_answers(const Grid<glm::vec3>& picture, const Grid<float>& light,
                           const std::vector<std::uint8_t>& labels, int classes,
                           const Grid<std::uint8_t>& use);
// Factor from a channel at cos i to level ground. 1 if it does not respond to light.
double levelling(const LightAnswer& answer, double cos_incidence, double level_cos);
// The picture corrected to level ground by the responses of each cell's class (no_class: those of
// class 0).
Grid<glm::vec3> lit_evenly(const Grid<glm::vec3>& picture, const Grid<float>& light,
                           double level_cos, const std::vector<std::uint8_t>& labels,
                           const LightAnswers& answers);

}  // namespace belvedere
