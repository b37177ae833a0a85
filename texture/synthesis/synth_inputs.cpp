#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

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

// A guide that an exemplar lacks costs what two random texels of the class differ in it, twice its
// variance, in the exemplars that know it (in all classes together where none of these has the
// class).
void price_lacking_guides(const std::vector<GuideRole>& roles, Plane& plane) {
  plane.lacking_price.assign(plane.parts.size() * 256, 0);
  for (std::size_t g = 0; g < roles.size(); ++g) {
    constexpr std::size_t all = no_class;
    std::array<std::array<std::int64_t, 3>, 256> sums{};  // by class: count, sum, sum of squares
    plane.for_each([&](std::uint32_t at) {
      const std::size_t c = class_of(plane.words[at]);
      if (c == no_class || !plane.knows(plane.part_of(at), g)) return;
      const std::int64_t v = plane.guides_at(at)[g];
      for (const std::size_t of : {c, all})
        sums[of] = {sums[of][0] + 1, sums[of][1] + v, sums[of][2] + v * v};
    });
    for (std::size_t p = 0; p < plane.parts.size(); ++p)
      for (std::size_t c = 0; c < all && !plane.knows(static_cast<int>(p), g); ++c) {
        const auto& [count, sum, squares] = sums[sums[c][0] > 0 ? c : all];
        if (count == 0) continue;
        const std::int64_t mean_q8 = 256 * sum / count;
        const std::int64_t difference_q8 = 2 * (256 * squares / count - mean_q8 * mean_q8 / 256);
        plane.lacking_price[p * 256 + c] += (roles[g].weight_q4 * difference_q8) >> 12;
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
  std::vector<std::uint8_t> known(exemplars.size() * setup.roles.size() + vector_guides, 255);
  for (std::size_t e = 0; e < exemplars.size(); ++e) {
    const Exemplar& exemplar = exemplars[e];
    const std::vector<const Grid<std::uint8_t>*> guides = guides_of(exemplar.guides, setup);
    for (std::size_t g = 0; g < guides.size(); ++g)
      if (guides[g] == nullptr) known[e * guides.size() + g] = 0;
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
  if (std::find(known.begin(), known.end(), 0) != known.end()) {
    plane.known = std::move(known);
    price_lacking_guides(setup.roles, plane);
  }
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
