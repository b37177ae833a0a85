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

std::size_t synthesis_bytes(std::size_t texels, std::size_t pixels, int guides, bool with_depth) {
  // Per texel: word and guides plus a third for the coarser levels, its record and its list entry
  // (synth_texels.h, synth_lists.h), and their inputs: bin and contrast or surroundings. Per pixel
  // at the start of the finest level: word and guides, match, every fourth's next, pieces,
  // surroundings (as they are and by shares), silhouettes, and a quarter of the words, guides and
  // matches of the level above; later, instead, the memory for moving whole pieces. The result (6)
  // is allocated when all but the matches is freed.
  const std::size_t g = static_cast<std::size_t>(guides);
  const std::size_t record = g <= 1 ? 8 : 8 + (g + 6) / 8 * 8;
  const std::size_t entry = 4 + (10 + g + 3) / 4 * 4;
  const std::size_t per_texel = (4 + g) * 4 / 3 + 1 + record + entry + 5;
  const std::size_t per_pixel = 4 + g + 4 + 1 + 6 + 4 + (8 + g) / 4 + 3 + (with_depth ? 2 : 0);
  return texels * per_texel + pixels * per_pixel + (std::size_t{32} << 20);
}

}  // namespace belvedere
