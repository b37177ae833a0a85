#include "texture/synthesis/exemplar.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/text/text_encoding.h"

namespace belvedere {

void check_guide_stack(const GuideStack& stack, const std::string& where) {
  if (stack.label.empty())
    throw Error(ErrorKind::usage, where, "no labels", "a label (class) for every pixel");
  const std::string size =
      fmt::format("{} × {}, the size of its labels", stack.width(), stack.height());
  for (std::size_t i = 0; i < stack.guides.size(); ++i) {
    const Guide& guide = stack.guides[i];
    if (guide.name.empty())
      throw Error(ErrorKind::usage, where, "a guide without a name", "a name such as \"altitude\"");
    for (std::size_t j = 0; j < i; ++j) {
      if (stack.guides[j].name == guide.name) {
        throw Error(ErrorKind::usage, where, fmt::format("two guides named \"{}\"", guide.name),
                    "unique names");
      }
    }
    if (!guide.values.same_size(stack.label)) {
      throw Error(ErrorKind::usage, where,
                  fmt::format("guide \"{}\" of {} × {} pixels", guide.name, guide.values.width(),
                              guide.values.height()),
                  size);
    }
  }
  if (!stack.depth_m.empty() && !stack.depth_m.same_size(stack.label)) {
    throw Error(
        ErrorKind::usage, where,
        fmt::format("depths of {} × {} pixels", stack.depth_m.width(), stack.depth_m.height()),
        size);
  }
}

void check_exemplar(const Exemplar& exemplar) {
  const std::string where = fmt::format("exemplar \"{}\"", exemplar.name);
  const Grid<Rgb8>& picture = exemplar.picture;
  if (picture.empty())
    throw Error(ErrorKind::usage, where, "no picture",
                "a picture and a label for each of its texels");
  if (picture.width() > Exemplar::largest_side || picture.height() > Exemplar::largest_side) {
    throw Error(ErrorKind::limit, where,
                fmt::format("{} × {} texels", picture.width(), picture.height()),
                fmt::format("at most {} texels on a side", Exemplar::largest_side));
  }
  check_guide_stack(exemplar.guides, where);
  if (!picture.same_size(exemplar.guides.label)) {
    throw Error(ErrorKind::usage, where,
                fmt::format("labels of {} × {}", exemplar.guides.width(), exemplar.guides.height()),
                fmt::format("{} × {}, the size of its picture", picture.width(), picture.height()));
  }
}

Rgb8 to_rgb8(glm::vec3 encoded) {
  Rgb8 rgb{};
  for (int c = 0; c < 3; ++c)
    rgb[static_cast<std::size_t>(c)] =
        static_cast<std::uint8_t>(std::lround(std::clamp(encoded[c], 0.F, 1.F) * 255.F));
  return rgb;
}

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
