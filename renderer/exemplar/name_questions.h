#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/exemplar/classes_by_paint.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Names of what a painting shows, as far as its paint alone tells them. Of six painters' classes
// only the sky looks alike with all of them; every other class is one painter's rock and another's
// sea. So the sky is named, the rest is asked for: one question for all groups that look alike.

// How likely a part of a painting is sky: a logistic regression on its look. The defaults are
// fitted to six paintings whose classes were drawn by hand, each painting with the same weight;
// fitted to five of them, at most 4 % of what is called sky in the sixth is something else.
struct SkyModel {
  double constant = -4.538;
  double lightness = 6.687;   // OKLab
  double yellow = -17.659;    // OKLab b: the sky is blue
  double height = -3.247;     // 0 at the upper edge … 1 at the lower one
  double upper_edge = 7.03;   // share of the upper edge, at most .3
  double log_rough = -2.941;  // ln of the roughness relative to the whole painting, .4 … 3
};
double sky_probability(const PartLook& look, const SkyModel& model = {});

// Which question names each group of a painting.
struct NameQuestions {
  std::vector<std::uint16_t> of_group;  // no_question where the class is sure
  std::size_t count = 0;                // question 0 concerns the most paint
};
inline constexpr std::uint16_t no_question = 0xffff;
inline constexpr std::size_t usual_questions = 20;

// At most `most` (≥ 1) questions about the groups `nodes` of a painting: groups of like colour,
// height and strokes share one. A group inferred to be sky, and surely so, is not asked for.
NameQuestions ask_names(const PaintingSegments& segments, const std::vector<std::uint16_t>& nodes,
                        std::size_t most = usual_questions, const SkyModel& model = {});

// What a person said that a place of a painting shows.
struct PlaceName {
  double across = 0.5, down = 0.5;       // of its width and height, 0…1
  std::uint8_t class_id = unused_label;  // or a class
};
inline constexpr std::string_view not_used_name = "not used";

// The [[named]] places of a file that the page of `exemplar segment` saved. Error(input) if it is
// missing, Error(usage) with the position of what is wrong.
std::vector<PlaceName> read_place_names(const std::string& path);

// Groups with what was said of them.
struct NamedGroups {
  std::vector<std::uint16_t> nodes;   // of the tree
  std::vector<std::uint8_t> classes;  // of each
  std::vector<std::uint8_t> named;    // 1 where a person said so
  Partition of_pieces;                // the group of each piece
};
// The groups of the cut that leaves `count`, with inferred classes; what was said of a place counts
// for its whole group. A group in whose places different things were seen is split until they are
// in groups of their own.
NamedGroups name_groups(const PaintingSegments& segments, std::size_t count,
                        const std::vector<PlaceName>& places);

}  // namespace belvedere
