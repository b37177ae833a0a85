#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/progress.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/synth_state.h"

// Preparation before the first level: the pairing of guides and the numbers of classes.
namespace belvedere::synth {

// Dense numbers for the labels of the exemplars, and the one from which each label of the target
// copies.
struct Classes {
  std::array<std::uint32_t, 256> of_exemplar{};
  std::array<std::uint32_t, 256> of_target{};  // also of labels that the given target lacks
                                               // but a part of its sheet may have
  std::array<std::uint32_t, 256>
      around{};  // the class used for dissimilarity: of_target without labels that the target lacks
  int count = 0;
};

// Largest weight of a guide or of surroundings, relative to the usual price.
inline constexpr int max_weight = 100;

struct Setup {
  SynthesisParameters parameters;
  std::vector<std::string> guide_names;  // in descending order of weight, as in planes
  std::vector<GuideRole> roles;
  Classes classes;
  SurroundingsPrice around_price = no_surroundings();

  LevelSettings settings(int level) const;
};

// Checks everything; notes what is left out. pixels_each: pixels of the picture per pixel of the
// given target.
Setup make_setup(const std::vector<Exemplar>& exemplars, const GuideStack& target,
                 const SynthesisParameters& parameters, std::size_t pixels_each,
                 Progress& progress);

Plane exemplar_plane(const std::vector<Exemplar>& exemplars, const Setup& setup);
// Throws Error(usage) if the stack lacks a guide.
Plane target_plane(const GuideStack& target, const Setup& setup);
// Levels of a whole picture of this size: the coarsest has at least 16 pixels on a side.
int level_count(const std::vector<Exemplar>& exemplars, int width, int height, int requested);
// Neighbours with a larger depth ratio are on two surfaces.
float depth_ratio(int level);

// Levels levels - 1 … finest of a whole picture. sources: exemplars of level 0 … levels - 1;
// targets: the target at level `finest`, with its depths in `target`. Of both, the data of level
// `finest` and finer ones are kept. Returns the matches of `finest`, by index of targets[0].
std::vector<std::uint32_t> synthesize_levels(const Setup& setup, const GuideStack& target,
                                             int finest, int levels, std::vector<Plane>& sources,
                                             std::vector<Plane>& targets, Progress& progress);

}  // namespace belvedere::synth
