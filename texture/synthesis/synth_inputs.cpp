#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/memory/zeroed_memory.h"
#include "base/parallel.h"
#include "texture/synthesis/synth_kernel.h"
#include "texture/synthesis/synth_setup.h"

// The planes of exemplars and target.

namespace belvedere::synth {

namespace {

// The guides of a setup in a stack, null where it lacks one.
std::vector<const Grid<std::uint8_t>*> guides_of(const GuideStack& stack, const Setup& setup) {
  std::vector<const Grid<std::uint8_t>*> guides;
  for (const std::string& name : setup.guide_names) guides.push_back(stack.find(name));
  return guides;
}

// Count, sum and sum of squares of a guide's values, exact.
struct GuideSums {
  std::int64_t count = 0, sum = 0, squares = 0;
  void add(const GuideSums& other) {
    count += other.count;
    sum += other.sum;
    squares += other.squares;
  }
  // Mean squared difference of two random values, 2 × variance, in 256ths.
  std::int64_t random_difference_q8() const {
    if (count == 0) return 0;
    const std::int64_t mean_q8 = 256 * sum / count;
    return std::max<std::int64_t>(0, 2 * (256 * squares / count - mean_q8 * mean_q8 / 256));
  }
};

// A guide that an exemplar lacks costs what two random texels of the class differ in it, in the
// exemplars that know it (in all classes together where none of these has the class).
void price_lacking_guides(const std::vector<Exemplar>& exemplars, const Setup& setup,
                          Plane& plane) {
  const std::size_t guides = setup.guide_names.size();
  std::vector<std::vector<const Grid<std::uint8_t>*>> values;
  std::vector<std::uint8_t> known(exemplars.size() * guides + vector_guides, 255);
  for (std::size_t e = 0; e < exemplars.size(); ++e) {
    values.push_back(guides_of(exemplars[e].guides, setup));
    for (std::size_t g = 0; g < guides; ++g)
      if (values[e][g] == nullptr) known[e * guides + g] = 0;
  }
  if (std::find(known.begin(), known.end(), 0) == known.end()) return;
  plane.known = std::move(known);
  plane.lacking_price.assign(exemplars.size() * 256, 0);
  for (std::size_t g = 0; g < guides; ++g) {
    std::array<GuideSums, 256> by_class{};
    GuideSums all;
    for (std::size_t e = 0; e < exemplars.size(); ++e) {
      if (values[e][g] == nullptr) continue;
      for (std::size_t i = 0; i < values[e][g]->size(); ++i) {
        const std::int64_t v = (*values[e][g])[i];
        by_class[setup.classes.of_exemplar[exemplars[e].guides.label[i]]].add({1, v, v * v});
      }
    }
    for (std::size_t c = 0; c < no_class; ++c) all.add(by_class[c]);
    for (std::size_t e = 0; e < exemplars.size(); ++e) {
      if (values[e][g] != nullptr) continue;
      for (std::size_t c = 0; c < no_class; ++c)
        plane.lacking_price[e * 256 + c] +=
            (setup.roles[g].weight_q4 *
             (by_class[c].count > 0 ? by_class[c] : all).random_difference_q8()) >>
            12;
    }
  }
}

}  // namespace

Plane exemplar_plane(const std::vector<Exemplar>& exemplars, const Setup& setup) {
  std::vector<std::pair<int, int>> sizes;
  sizes.reserve(exemplars.size());
  for (const Exemplar& exemplar : exemplars)
    sizes.emplace_back(exemplar.picture.width(), exemplar.picture.height());
  Plane plane = make_plane(sizes, static_cast<int>(setup.roles.size()),
                           padding_for(setup.parameters.patch_radius()));
  for (std::size_t e = 0; e < exemplars.size(); ++e) {
    const Exemplar& exemplar = exemplars[e];
    const std::vector<const Grid<std::uint8_t>*> guides = guides_of(exemplar.guides, setup);
    parallel_rows(exemplar.picture.height(), [&](int y) {
      for (int x = 0; x < exemplar.picture.width(); ++x) {
        const std::uint32_t at = plane.index(static_cast<int>(e), x, y);
        const Rgb8 colour = exemplar.picture(x, y);
        plane.words[at] = colour[0] | static_cast<std::uint32_t>(colour[1]) << 8 |
                          static_cast<std::uint32_t>(colour[2]) << 16 |
                          setup.classes.of_exemplar[exemplar.guides.label(x, y)] << 24;
        for (std::size_t g = 0; g < guides.size(); ++g)
          if (guides[g] != nullptr) plane.guides[at * guides.size() + g] = (*guides[g])(x, y);
      }
    });
  }
  price_lacking_guides(exemplars, setup, plane);
  bool any_cuts = false;
  for (std::size_t e = 0; e < exemplars.size(); ++e)
    if (!exemplars[e].guides.depth_m.empty())
      any_cuts =
          add_cuts(exemplars[e].guides.depth_m, static_cast<int>(e), depth_ratio(0), plane) ||
          any_cuts;
  if (!any_cuts) plane.cuts = {};
  pad(plane);
  prefer_large_pages(plane.words);
  return plane;
}

Plane target_plane(const GuideStack& target, const Setup& setup) {
  const std::vector<const Grid<std::uint8_t>*> guides = guides_of(target, setup);
  for (std::size_t g = 0; g < guides.size(); ++g)
    if (guides[g] == nullptr)
      throw Error(ErrorKind::usage, "target of synthesis",
                  fmt::format("the guide \"{}\" is missing", setup.guide_names[g]),
                  "the guides of the plan");
  Plane plane = make_plane({{target.width(), target.height()}}, static_cast<int>(guides.size()),
                           padding_for(setup.parameters.patch_radius()));
  parallel_rows(target.height(), [&](int y) {
    for (int x = 0; x < target.width(); ++x) {
      const std::uint32_t at = plane.index(0, x, y);
      plane.words[at] = setup.classes.of_target[target.label(x, y)] << 24;
      for (std::size_t g = 0; g < guides.size(); ++g)
        plane.guides[at * guides.size() + g] = (*guides[g])(x, y);
    }
  });
  pad(plane);
  return plane;
}

}  // namespace belvedere::synth
