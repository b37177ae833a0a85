#include "terrain/generalize/generalize_presets.h"

#include <algorithm>

namespace belvedere {
namespace {

using Weights = std::vector<float>;

// The same weights near and far.
GeneralizeParameters everywhere(const Weights& global, const Weights& ridges,
                                const Weights& valleys) {
  GeneralizeParameters bands;
  bands.foreground = bands.background = global;
  bands.foreground_ridges = bands.background_ridges = ridges;
  bands.foreground_valleys = bands.background_valleys = valleys;
  return bands;
}

// Figure 4: near, the highest band is slightly reduced and its ridges are moderately raised; far,
// the top three bands are off except for ridges, which are raised. The paper gives no numbers for
// it. In alpine terrain c is about .5 along ridges and .1 on slopes in every band, so the weight is
// .8 on slopes and 1.4 on ridges near, .2 and 1 far.
GeneralizeParameters figure_4() {
  GeneralizeParameters bands;
  bands.foreground = {1.F, 1.F, 1.F, 1.F, 0.7F};
  bands.background = {1.F, 1.F, 0.F, 0.F, 0.F};
  bands.foreground_ridges = {0.F, 0.F, 0.F, 0.F, 1.2F};
  bands.background_ridges = {0.F, 0.F, 1.7F, 1.8F, 2.F};
  return bands;
}

GeneralizeParameters panorama() {
  GeneralizeParameters bands;
  bands.foreground = {1.1F, 1.2F, 1.1F, 1.F, 0.9F, 0.7F};
  bands.background = {1.3F, 1.3F, 0.8F, 0.3F, 0.1F, 0.F};
  bands.foreground_ridges = {0.F, 0.F, 0.1F, 0.2F, 0.3F, 0.5F};
  bands.background_ridges = {0.F, 0.2F, 0.5F, 0.9F, 1.F, 0.9F};
  bands.background_valleys = {0.F, 0.F, 0.1F, 0.3F, 0.3F, 0.2F};
  return bands;
}

}  // namespace

const std::vector<GeneralizePreset>& generalize_presets() {
  static const Weights figure_2 = {1.F, 1.F, 2.F, 0.25F, 0.F};
  static const std::vector<GeneralizePreset> presets = {
      {"figure2",
       "Figure 2 of Jenny, Jenny & Hurni 2011: fine detail removed, medium forms doubled.",
       everywhere(figure_2, {}, {}),
       {},
       false},
      {"figure4",
       "Figure 4: near ground almost unchanged, far ground reduced to large forms and their "
       "ridges.",
       figure_4(),
       {},
       false},
      {"figure5", "Figure 5: as figure 2, but only on steep ground; flat ground is unchanged.",
       everywhere(figure_2, {}, {}), SlopeRange{}, false},
      {"smooth_slopes",
       "Smooth slopes between sharp ridges and clear valleys.",
       everywhere({1.F, 1.F, 0.7F, 0.3F, 0.05F, 0.F}, {0.F, 0.F, 0.3F, 0.8F, 1.1F, 1.1F},
                  {0.F, 0.F, 0.15F, 0.4F, 0.5F, 0.5F}),
       {},
       false},
      {"bold_ridges",
       "Main ranges and their ridges raised, small forms reduced; no moats at the foot of "
       "slopes.",
       everywhere({1.2F, 1.4F, 1.3F, 0.7F, 0.3F, 0.1F}, {0.F, 0.3F, 0.6F, 0.9F, 1.1F, 1.F},
                  {0.F, 0.F, 0.F, 0.2F, 0.3F, 0.3F}),
       {},
       true},
      {"panorama",
       "Near ground unchanged with stronger ridges, far ground with large forms and crests; no "
       "moats at the "
       "foot of slopes.",
       panorama(),
       {},
       true},
  };
  return presets;
}

const GeneralizePreset* find_generalize_preset(std::string_view name) {
  const std::vector<GeneralizePreset>& all = generalize_presets();
  const auto found = std::find_if(all.begin(), all.end(), [name](const GeneralizePreset& preset) {
    return preset.name == name;
  });
  return found == all.end() ? nullptr : &*found;
}

void choose_weights(GeneralizeParameters& bands, const WrittenWeights& written,
                    const GeneralizePreset* preset) {
  using Set = Weights GeneralizeParameters::*;
  const auto choose_near = [&](const Weights& own_set, Set near_set, const Weights& otherwise) {
    return !own_set.empty() ? own_set : preset != nullptr ? preset->bands.*near_set : otherwise;
  };
  const auto choose_far = [&](const Weights& own_set, Set far_set, Set near_set) {
    const bool own = preset != nullptr && preset->bands.*far_set != preset->bands.*near_set;
    return !own_set.empty() ? own_set : own ? preset->bands.*far_set : bands.*near_set;
  };
  using P = GeneralizeParameters;
  const std::size_t count =
      written.background.empty() ? P().foreground.size() : written.background.size();
  bands.foreground = choose_near(written.foreground, &P::foreground, Weights(count, 1.F));
  bands.foreground_ridges = choose_near(written.foreground_ridges, &P::foreground_ridges, {});
  bands.foreground_valleys = choose_near(written.foreground_valleys, &P::foreground_valleys, {});
  bands.background = choose_far(written.background, &P::background, &P::foreground);
  bands.background_ridges =
      choose_far(written.background_ridges, &P::background_ridges, &P::foreground_ridges);
  bands.background_valleys =
      choose_far(written.background_valleys, &P::background_valleys, &P::foreground_valleys);
}

}  // namespace belvedere
