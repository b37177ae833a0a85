#include "texture/synthesis/class_texels.h"
#include "base/text/text_encoding.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace belvedere {
namespace {

using Counts = std::array<std::size_t, 256>;

Counts count_texels(const std::vector<Exemplar>& exemplars) {
  Counts texels{};
  for (const Exemplar& exemplar : exemplars)
    for (const std::uint8_t label : exemplar.guides.label) ++texels[label];
  texels[unused_label] = 0;
  return texels;
}

// 12 345 678
}  // namespace

Grid<std::uint8_t> serving_labels(const std::vector<Exemplar>& exemplars,
                                  const Grid<std::uint8_t>& target,
                                  const std::map<std::uint8_t, std::uint8_t>& fallback) {
  const Counts texels = count_texels(exemplars);
  std::array<std::uint8_t, 256> serving{};
  for (std::size_t label = 0; label < serving.size(); ++label) {
    const auto other = fallback.find(static_cast<std::uint8_t>(label));
    serving[label] = texels[label] > 0 ? static_cast<std::uint8_t>(label)
                     : label != unused_label && other != fallback.end() && texels[other->second] > 0
                         ? other->second
                         : unused_label;
  }
  Grid<std::uint8_t> out(target.width(), target.height());
  std::transform(target.begin(), target.end(), out.begin(),
                 [&](std::uint8_t label) { return serving[label]; });
  return out;
}

std::vector<ClassTexels> class_texels(const std::vector<Exemplar>& exemplars,
                                      const Grid<std::uint8_t>& target,
                                      const std::map<std::uint8_t, std::uint8_t>& fallback) {
  const Counts texels = count_texels(exemplars);
  Counts pixels{};
  for (const std::uint8_t label : serving_labels(exemplars, target, fallback)) ++pixels[label];
  std::vector<ClassTexels> available;
  for (std::size_t label = 0; label < unused_label; ++label)
    if (pixels[label] > 0)
      available.push_back({static_cast<std::uint8_t>(label), texels[label], pixels[label]});
  return available;
}

std::string describe_scarcity(const std::vector<ClassTexels>& available,
                              const std::function<std::string(std::uint8_t)>& name) {
  std::string list;
  for (const ClassTexels& of : available) {
    if (of.enough()) continue;
    list += fmt::format(
        "{}{} (each texel serves {:.0f} pixels; {} texels are needed, {} are available)",
        list.empty() ? "" : ", ", name(of.label),
        static_cast<double>(of.pixels) / static_cast<double>(of.texels),
        grouped(of.texels_needed()), grouped(of.texels));
  }
  return list.empty() ? list : "too few texels, so strokes will repeat: " + list;
}

}  // namespace belvedere
