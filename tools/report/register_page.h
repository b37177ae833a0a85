#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/text/json.h"
#include "renderer/register/registered_ground.h"
#include "renderer/register/registered_guidance.h"
#include "terrain/register/registration.h"

namespace belvedere::tools {

// Deviation of places in the darkest colour of the map of trust; of a painting 1200 px wide.
constexpr double trusted_px = 12.0;

// The verdict of a registration on a pair, in a word ("wrong", "moved", "fits" …) and a sentence.
struct PairWords {
  std::string verdict;
  std::string sentence;
};
PairWords pair_words(const PairFinding& finding, double sigma_px);

// Pairs from the farthest off, in deviations, to the nearest; those thrown out first.
std::vector<std::size_t> pairs_worst_first(const Registration& registration);

struct RegisterReportInput {
  std::string painting;  // its name
  std::string command;
  std::vector<ControlPair> pairs;
  Registration registration;
  std::size_t painted_places = 0;  // that were found in the paint and fitted too
  Grid<glm::vec3> picture;         // the painting, as large as the ground
  RegisteredGround ground;
  RegisteredLight light;
  RegisteredCover cover;
  Grid<std::uint8_t> classes;  // of the picture's pixels
};

// The lines of the painting's land cover in words, beside those of the climate.
std::string cover_words(const RegisteredCover& cover);
// The light of a painting in words: where the sun stands to the viewer, and whether the paint
// tells.
std::string light_words(const RegisteredLight& light);

// The figures of a registration.
Json registration_json(const RegisterReportInput& input);
// index.html and report.json in the folder: the pairs, worst first, in words; contours and skyline
// of the terrain over the painting; its light; a map of trust. Throws Error(output).
void write_register_report(const std::string& folder, const RegisterReportInput& input);

}  // namespace belvedere::tools
