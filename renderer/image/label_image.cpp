#include "renderer/image/label_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/land_cover_class.h"
#include "renderer/image/image_io.h"
#include "renderer/image/png_palette.h"

namespace belvedere {
namespace {

constexpr std::size_t max_colours = 64;

bool is_drawn_in_colours(const std::string& path) {
  const ImageInfo info = read_image_info(path);
  if (info.format == "openexr" || info.parts.empty() || info.parts.front().channels.size() < 3)
    return false;
  return info.format != "png" ||
         !image_io::read_png_kind(path).palette;  // a palette's indices are numbers
}

Grid<std::uint8_t> read_numbers(const std::string& path) {
  const Grid<std::uint16_t> grey = read_grey(path);
  Grid<std::uint8_t> labels(grey.width(), grey.height());
  for (std::size_t i = 0; i < grey.size(); ++i) {
    if (grey[i] > unused_label)
      throw Error(ErrorKind::input, path, fmt::format("has a label {}", grey[i]),
                  "0 … 254, and 255 for unused pixels");
    labels[i] = static_cast<std::uint8_t>(grey[i]);
  }
  return labels;
}

std::uint32_t packed(glm::vec3 colour) {
  std::uint32_t out = 0;
  for (int c = 0; c < 3; ++c)
    out =
        out << 8 | static_cast<std::uint32_t>(std::lround(std::clamp(colour[c], 0.F, 1.F) * 255.F));
  return out;
}

Grid<std::uint32_t> read_colours(const std::string& path) {
  const Grid<glm::vec3> picture = read_picture(path);
  Grid<std::uint32_t> colours(picture.width(), picture.height());
  for (std::size_t i = 0; i < picture.size(); ++i) colours[i] = packed(picture[i]);
  return colours;
}

bool is_flat(const Grid<std::uint32_t>& colours, int x, int y) {
  for (int v = -1; v <= 1; ++v)
    for (int u = -1; u <= 1; ++u)
      if (!colours.contains(x + u, y + v) || colours(x + u, y + v) != colours(x, y)) return false;
  return true;
}

Grid<std::uint8_t> name_colours(const Grid<std::uint32_t>& colours,
                                const std::map<std::uint32_t, std::uint8_t>& names) {
  Grid<std::uint8_t> known(colours.width(), colours.height(), 0);
  for (std::size_t i = 0; i < colours.size(); ++i) known[i] = names.contains(colours[i]) ? 1 : 0;
  const Grid<std::int32_t> nearest = nearest_marked(known);
  Grid<std::uint8_t> labels(colours.width(), colours.height(), unused_label);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (nearest[i] >= 0) labels[i] = names.at(colours[static_cast<std::size_t>(nearest[i])]);
  return labels;
}

// Pixels of a colour within flat squares, and the first of them.
struct FlatColour {
  std::size_t pixels = 0;
  int x = 0, y = 0;
};

// Adds the flat colours of a drawing. Whether it has so many other colours that it was compressed
// with losses, or scaled.
bool find_flat_colours(const Grid<std::uint32_t>& drawing,
                       std::map<std::uint32_t, FlatColour>& flat) {
  for (int y = 0; y < drawing.height(); ++y)
    for (int x = 0; x < drawing.width(); ++x) {
      if (!is_flat(drawing, x, y)) continue;
      FlatColour& found = flat[drawing(x, y)];
      if (found.pixels++ == 0) found.x = x, found.y = y;
    }
  const std::set<std::uint32_t> all(drawing.begin(), drawing.end());
  return all.size() > 2 * flat.size();
}

// The largest difference of a channel.
int steps_between(std::uint32_t a, std::uint32_t b) {
  int steps = 0;
  for (unsigned shift = 0; shift < 24; shift += 8)
    steps = std::max(
        steps, std::abs(static_cast<int>(a >> shift & 255U) - static_cast<int>(b >> shift & 255U)));
  return steps;
}

// Each flat colour, and the one that it is taken as: itself, or where the drawing is lossy the
// nearest one that is four times as frequent and within max_lossy_steps.
std::map<std::uint32_t, std::uint32_t> frequent_colours(
    const std::map<std::uint32_t, FlatColour>& flat, bool lossy) {
  std::vector<std::pair<std::size_t, std::uint32_t>> by_pixels;
  for (const auto& [colour, found] : flat) by_pixels.emplace_back(found.pixels, colour);
  std::sort(by_pixels.rbegin(), by_pixels.rend());
  std::map<std::uint32_t, std::uint32_t> kept;
  std::vector<std::pair<std::size_t, std::uint32_t>> frequent;
  for (const auto& [pixels, colour] : by_pixels) {
    std::uint32_t as = colour;
    int nearest = max_lossy_steps + 1;
    for (const auto& [others, other] : frequent)
      if (const int steps = steps_between(colour, other);
          lossy && others >= 4 * pixels && steps < nearest) {
        nearest = steps;
        as = other;
      }
    kept[colour] = as;
    if (as == colour) frequent.emplace_back(pixels, colour);
  }
  return kept;
}

// The rarest flat colours, with their positions.
std::string odd_ones(const std::map<std::uint32_t, FlatColour>& flat) {
  std::vector<std::pair<std::size_t, std::uint32_t>> by_pixels;
  for (const auto& [colour, found] : flat) by_pixels.emplace_back(found.pixels, colour);
  std::sort(by_pixels.begin(), by_pixels.end());
  constexpr std::size_t max_named = 3;
  by_pixels.resize(std::min(by_pixels.size(), max_named));
  std::string list;
  for (const auto& [pixels, colour] : by_pixels)
    list += fmt::format("{}#{:06x} at {}, {}", list.empty() ? "" : "; ", colour, flat.at(colour).x,
                        flat.at(colour).y);
  return list;
}

void note_repaired(const std::string& path, const std::vector<Grid<std::uint32_t>>& drawings,
                   const std::map<std::uint32_t, std::uint32_t>& kept, std::size_t labels,
                   Progress& progress) {
  if (kept.size() == labels) return;
  std::size_t all = 0, moved = 0;
  for (const Grid<std::uint32_t>& drawing : drawings)
    for (const std::uint32_t colour : drawing) {
      ++all;
      const auto found = kept.find(colour);
      if (found != kept.end() && found->second != colour) ++moved;
    }
  progress.note(fmt::format(
      "{}: compressed with losses; {} flat colours are within {} steps of {} frequent ones and are "
      "taken as these: {:.2f} % of the pixels",
      path, kept.size() - labels, max_lossy_steps, labels,
      100.0 * static_cast<double>(moved) / static_cast<double>(all)));
}

}  // namespace

Grid<std::uint8_t> read_class_mask(const std::string& path,
                                   const std::vector<std::uint8_t>& others) {
  const Grid<std::uint16_t> ids = read_grey(path);
  struct Odd {
    std::size_t pixels = 0;
    std::size_t first = 0;
  };
  std::map<int, Odd> odd;
  Grid<std::uint8_t> out(ids.width(), ids.height());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    out[i] = static_cast<std::uint8_t>(std::min<std::uint16_t>(ids[i], unused_label));
    if (ids[i] < land_cover_class_count || ids[i] == unused_label ||
        std::find(others.begin(), others.end(), ids[i]) != others.end())
      continue;
    Odd& found = odd[ids[i]];
    if (found.pixels++ == 0) found.first = i;
  }
  if (odd.empty()) return out;
  constexpr std::size_t max_named = 8;
  std::string list;
  std::size_t named = 0;
  for (const auto& [number, found] : odd) {
    if (named++ == max_named) break;
    const auto width = static_cast<std::size_t>(ids.width());
    list += fmt::format("{}{} ({} pixels, the first at {}, {})", list.empty() ? "" : ", ", number,
                        found.pixels, found.first % width, found.first / width);
  }
  if (odd.size() > max_named) list += fmt::format(" and {} more", odd.size() - max_named);
  throw Error(ErrorKind::input, path, "has numbers that are no class: " + list,
              fmt::format("0 … {}{} and 255 for unused pixels; save masks without soft edges, "
                          "gradients and compression with losses",
                          land_cover_class_count - 1,
                          others.empty() ? "" : fmt::format(", {}", fmt::join(others, ", "))));
}

LabelImages read_label_images(const std::vector<std::string>& paths, Progress& progress) {
  LabelImages out;
  std::vector<Grid<std::uint32_t>> drawings;
  std::map<std::uint32_t, FlatColour> flat;
  bool lossy = false;
  for (const std::string& path : paths) {
    if (!is_drawn_in_colours(path)) {
      if (!drawings.empty())
        throw Error(ErrorKind::input, path,
                    fmt::format("contains numbers, but {} is drawn in colours", paths.front()),
                    "masks that all hold numbers, or are all drawn in the same colours");
      out.labels.push_back(read_numbers(path));
      continue;
    }
    if (!out.labels.empty())
      throw Error(ErrorKind::input, path,
                  fmt::format("is drawn in colours, but {} contains numbers", paths.front()),
                  "masks that all hold numbers, or are all drawn in the same colours");
    drawings.push_back(read_colours(path));
    lossy = find_flat_colours(drawings.back(), flat) || lossy;
    const std::map<std::uint32_t, std::uint32_t> kept = frequent_colours(flat, lossy);
    std::set<std::uint32_t> labels;
    for (const auto& [colour, as] : kept) labels.insert(as);
    if (labels.empty() || labels.size() > max_colours)
      throw Error(
          ErrorKind::input, path,
          labels.empty()
              ? std::string("has no flat colour")
              : fmt::format("has {} flat colours, among them {}", labels.size(), odd_ones(flat)),
          fmt::format(
              "a mask as PNG or TIFF, grey with numbers, or drawn in at most {} flat colours",
              max_colours));
  }
  if (drawings.empty()) return out;
  std::map<std::uint32_t, std::uint8_t> names;
  const std::map<std::uint32_t, std::uint32_t> kept = frequent_colours(flat, lossy);
  for (const auto& [colour, as] : kept) {
    if (colour != as) continue;
    names[colour] = static_cast<std::uint8_t>(out.colours.size());
    out.colours.push_back({static_cast<std::uint8_t>(colour >> 16),
                           static_cast<std::uint8_t>(colour >> 8 & 255U),
                           static_cast<std::uint8_t>(colour & 255U)});
  }
  for (const auto& [colour, as] : kept) names[colour] = names.at(as);
  note_repaired(paths.front(), drawings, kept, out.colours.size(), progress);
  for (const Grid<std::uint32_t>& drawing : drawings)
    out.labels.push_back(name_colours(drawing, names));
  return out;
}

Grid<float> read_grey_share(const std::string& path) {
  const Grid<glm::vec3> picture = read_picture(path);
  Grid<float> share(picture.width(), picture.height());
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const glm::vec3 value = picture(x, y);
      if (value.x != value.y || value.y != value.z)
        throw Error(ErrorKind::input, path,
                    fmt::format("has colours: pixel ({}, {}) is not grey", x, y),
                    "a grey picture, or one of equal red, green and blue");
      share(x, y) = std::clamp(value.x, 0.F, 1.F);
    }
  return share;
}

}  // namespace belvedere
