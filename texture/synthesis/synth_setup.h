#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/progress.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/synth_state.h"
#include "texture/synthesis/synthesis_parameters.h"

// What exemplars, target and parameters come to before the first level: which guides are paired, which numbers classes have.
namespace belvedere::synth {

// Dense numbers for the labels that exemplars have, and which of them each label of the target copies from.
struct Classes {
  std::array<std::uint32_t, 256> of_exemplar{};
  std::array<std::uint32_t, 256> of_target{};  // also of labels that the target given does not have, but a part of its sheet may
  std::array<std::uint32_t, 256> around{};     // as which class unlikeness is told: of_target without the labels that only may be
  int count = 0;
};

struct Setup {
  SynthesisParameters parameters;
  std::vector<std::string> guide_names;  // the strongest first, as in planes
  std::vector<GuideRole> roles;
  Classes classes;
  SurroundingsPrice around_price = no_surroundings();

  LevelSettings settings(int level) const;
};

// Checks everything; notes what is left out. pixels_each: pixels of the picture for one of the target given.
Setup make_setup(const std::vector<Exemplar>& exemplars, const GuideStack& target, const SynthesisParameters& parameters,
                 std::size_t pixels_each, Progress& progress);

Plane exemplar_plane(const std::vector<Exemplar>& exemplars, const Setup& setup);
// Throws Error(usage) where the stack lacks a guide.
Plane target_plane(const GuideStack& target, const Setup& setup);
// Levels of a whole picture of this size: the coarsest has at least 16 pixels on a side.
int level_count(const std::vector<Exemplar>& exemplars, int width, int height, int requested);
// Depths of neighbours that differ by more than this ratio are two surfaces.
float depth_ratio(int level);

// Levels levels - 1 … finest of a whole picture. sources: exemplars of level 0 … levels - 1; targets: the target at level `finest`, with
// its depths in `target`. Leaves of both what level `finest` and finer ones have. The matches of `finest`, by index of targets[0].
std::vector<std::uint32_t> synthesize_levels(const Setup& setup, const GuideStack& target, int finest, int levels,
                                             std::vector<Plane>& sources, std::vector<Plane>& targets, Progress& progress);

}  // namespace belvedere::synth
