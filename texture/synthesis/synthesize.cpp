#include "texture/synthesis/synthesize.h"

#include "base/parallel.h"
#include "texture/synthesis/synth_setup.h"

namespace belvedere {

namespace {

// The result replaces its inputs: this is the peak of memory use.
MatchField to_match_field(const std::vector<std::uint32_t>& matches, const synth::Plane::Part& part,
                          std::size_t stride, const synth::Plane& exemplars) {
  MatchField field(part.width, part.height);
  parallel_rows(part.height, [&](int y) {
    for (int x = 0; x < part.width; ++x) {
      const std::uint32_t texel =
          matches[part.origin + static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)];
      if (texel == exemplars.nowhere()) continue;
      const synth::Plane::Place position = exemplars.position(texel);
      field(x, y) = {static_cast<std::uint16_t>(position.part),
                     static_cast<std::uint16_t>(position.x),
                     static_cast<std::uint16_t>(position.y)};
    }
  });
  return field;
}

}  // namespace

MatchField synthesize(const std::vector<Exemplar>& exemplars, const GuideStack& target,
                      const SynthesisParameters& parameters, Progress& progress) {
  const synth::Setup setup = synth::make_setup(exemplars, target, parameters, 1, progress);
  if (setup.classes.count == 0) return MatchField(target.width(), target.height());
  const int levels =
      synth::level_count(exemplars, target.width(), target.height(), parameters.levels);
  std::vector<synth::Plane> sources{synth::exemplar_plane(exemplars, setup)};
  for (int level = 1; level < levels; ++level) sources.push_back(synth::halve(sources.back()));
  std::vector<synth::Plane> targets{synth::target_plane(target, setup)};
  const std::vector<std::uint32_t> matches =
      synth::synthesize_levels(setup, target, 0, levels, sources, targets, progress);
  const synth::Plane::Part part = targets[0].parts[0];
  const std::size_t stride = static_cast<std::size_t>(targets[0].stride);
  targets.clear();
  return to_match_field(matches, part, stride, sources[0]);
}

}  // namespace belvedere
