#include "texture/composite/learn_composite.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/cache/content_hash.h"
#include "base/error.h"
#include "base/filter.h"
#include "texture/statistical/choose_seed.h"
#include "texture/statistical/difference_histogram.h"

namespace belvedere {
namespace {

constexpr std::ptrdiff_t min_label_pixels = std::ptrdiff_t{min_crop_px} * min_crop_px;

bool is_large_enough(const Grid<std::uint8_t>& states) {
  const PixelRect box = box_of(states);
  return std::count(states.begin(), states.end(), pixel_free) >= min_label_pixels &&
         box.width() >= min_crop_px && box.height() >= min_crop_px;
}

// Of one pixel or more.
bool has_one_colour(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& states) {
  std::size_t first = 0;
  while (states[first] == 0) ++first;
  for (std::size_t i = first; i < states.size(); ++i)
    if (states[i] != 0 && picture[i] != picture[first]) return false;
  return true;
}

// Requirements on the pixels of a label that are far enough from its borders.
void check_label(const std::string& name, const Grid<Rgb8>& picture,
                 const Grid<std::uint8_t>& states) {
  const std::string where = "the label " + name;
  if (!is_large_enough(states)) {
    const PixelRect box = box_of(states);
    throw Error(
        ErrorKind::input, where,
        fmt::format("{} pixels, {} × {}, are {} or more from its borders",
                    std::count(states.begin(), states.end(), pixel_free), std::max(0, box.width()),
                    std::max(0, box.height()), label_inset_px),
        fmt::format("at least {} pixels, {} × {}: merge it with a similar label, or leave it out",
                    min_label_pixels, min_crop_px, min_crop_px));
  }
  if (has_one_colour(picture, states))
    throw Error(ErrorKind::input, where, "it has a single colour", "a texture");
}

CliqueModel learn_part(const LabelledCrop& crop, const Grid<std::uint8_t>& states, bool choose,
                       const CompositeParameters& parameters, Progress& progress) {
  const PixelRect box =
      intersection(grown(box_of(states), min_crop_px / 2), {0, 0, states.width(), states.height()});
  const Grid<Rgb8> picture = part_of(crop.picture, box);
  const Grid<std::uint8_t> counted = part_of(states, box);
  CliqueModel model = learn_texture(picture, counted, parameters.learn, progress).model;
  if (choose) {
    choose_seed(model, picture, counted, parameters.learn, progress);
    return model;
  }
  const StrokeDirection strokes = find_stroke_direction(picture, counted);
  model.direction_deg = strokes.deg;
  model.direction_spread = strokes.spread;
  model.seed = parameters.begin;
  model.seed_px = parameters.begin_px;
  model.polish = model.seed == TextureSeed::white;
  return model;
}

Grid<std::uint8_t> states_where(const LabelledCrop& crop, const auto& is) {
  Grid<std::uint8_t> states(crop.labels.width(), crop.labels.height());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const bool counts =
        crop.labels[i] != no_label && (crop.states.empty() || (crop.states[i] & pixel_counts) != 0);
    states[i] = counts && is(i) ? pixel_free : std::uint8_t{0};
  }
  return states;
}

// Where the label is unknown, the map takes that of the nearest pixel.
Grid<std::uint8_t> completed(const Grid<std::uint8_t>& labels) {
  Grid<std::uint8_t> known(labels.width(), labels.height());
  std::transform(labels.begin(), labels.end(), known.begin(),
                 [](std::uint8_t l) { return static_cast<std::uint8_t>(l != no_label); });
  const Grid<std::int32_t> nearest = nearest_marked(known);
  Grid<std::uint8_t> out = labels;
  for (std::size_t i = 0; i < out.size(); ++i)
    if (nearest[i] >= 0) out[i] = labels[static_cast<std::size_t>(nearest[i])];
  return out;
}

std::string hash_of(const LabelledCrop& crop) {
  ContentHash hash;
  hash.add(crop.picture.data(), crop.picture.size() * sizeof(Rgb8));
  hash.add(crop.labels.data(), crop.labels.size());
  return hash.digits();
}

}  // namespace

Grid<std::uint8_t> join_small_labels(const LabelledCrop& crop) {
  Grid<std::uint8_t> labels = crop.labels;
  for (;;) {
    const Grid<std::uint8_t> off_limits = near_borders(labels, label_inset_px);
    std::array<std::size_t, no_label> pixels{};
    for (const std::uint8_t label : labels)
      if (label != no_label) ++pixels[label];
    // The smallest of those that cannot be learnt.
    std::size_t smallest = no_label;
    for (std::size_t label = 0; label < no_label; ++label) {
      if (pixels[label] == 0 || (smallest != no_label && pixels[label] >= pixels[smallest]))
        continue;
      const Grid<std::uint8_t> states =
          states_where({crop.picture, crop.states, labels, {}},
                       [&](std::size_t i) { return labels[i] == label && off_limits[i] == 0; });
      if (!is_large_enough(states) || has_one_colour(crop.picture, states)) smallest = label;
    }
    // Neighbours along rows and columns.
    std::array<std::size_t, no_label> border{};
    const auto meet = [&](std::uint8_t a, std::uint8_t b) {
      if (a == b || a == no_label || b == no_label) return;
      if (a == smallest) ++border[b];
      if (b == smallest) ++border[a];
    };
    for (int y = 0; y < labels.height(); ++y)
      for (int x = 0; x < labels.width(); ++x) {
        if (x > 0) meet(labels(x - 1, y), labels(x, y));
        if (y > 0) meet(labels(x, y - 1), labels(x, y));
      }
    const auto longest = std::max_element(border.begin(), border.end());
    if (smallest != no_label && *longest > 0) {
      std::replace(labels.begin(), labels.end(), static_cast<std::uint8_t>(smallest),
                   static_cast<std::uint8_t>(longest - border.begin()));
      continue;
    }
    std::array<std::uint8_t, 256> number{};
    number.fill(no_label);
    std::uint8_t next = 0;
    for (std::size_t label = 0; label < no_label; ++label)
      if (pixels[label] > 0) number[label] = next++;
    for (std::uint8_t& label : labels) label = number[label];
    return labels;
  }
}

CompositeModel learn_composite(const LabelledCrop& crop, const CompositeParameters& parameters,
                               Progress& progress) {
  if (!crop.labels.same_size(crop.picture))
    throw Error(
        ErrorKind::input, "the labels",
        fmt::format("{} × {} pixels", crop.labels.width(), crop.labels.height()),
        fmt::format("the size of the crop: {} × {}", crop.picture.width(), crop.picture.height()));
  const auto count = static_cast<int>(crop.names.size());
  if (count < 2 || count > max_labels)
    throw Error(ErrorKind::input, "the labels",
                fmt::format("{} label{}", count, count == 1 ? "" : "s"),
                fmt::format("2 to {}", max_labels));

  const Grid<std::uint8_t> off_limits = near_borders(crop.labels, label_inset_px);
  std::vector<Grid<std::uint8_t>> masks;
  for (int label = 0; label < count; ++label) {
    masks.push_back(states_where(
        crop, [&](std::size_t i) { return crop.labels[i] == label && off_limits[i] == 0; }));
    check_label(crop.names[static_cast<std::size_t>(label)], crop.picture, masks.back());
  }
  CompositeModel out;
  out.crop_hash = hash_of(crop);
  out.map = learn_label_map(completed(crop.labels), count);
  for (std::size_t label = 0; label < masks.size(); ++label)
    out.labels.push_back({crop.names[label],
                          learn_part(crop, masks[label], parameters.choose, parameters, progress)});

  const Grid<std::uint8_t> near = near_borders(crop.labels, transition_px);
  const Grid<std::uint8_t> zone = states_where(crop, [&](std::size_t i) { return near[i] != 0; });
  const bool enough = std::count(zone.begin(), zone.end(), pixel_free) >= min_label_pixels;
  const CompositeParameters white{.learn = parameters.learn};
  if (enough)
    out.transition = learn_part(crop, zone, false, white, progress);
  else
    progress.note(
        "warning: the labels' borders are too short to learn a transition; textures will "
        "meet without a transition");
  return out;
}

namespace {

constexpr std::size_t strips = 16;
constexpr std::size_t cells = 8 * 8 * 8;

std::vector<double> colour_profile(const Grid<Rgb8>& picture) {
  std::vector<double> shares(strips * cells, 0.0);
  std::array<double, strips> pixels{};
  for (int y = 0; y < picture.height(); ++y) {
    const auto strip =
        static_cast<std::size_t>(y) * strips / static_cast<std::size_t>(picture.height());
    for (int x = 0; x < picture.width(); ++x) {
      const Rgb8& c = picture(x, y);
      const std::size_t cell = (static_cast<std::size_t>(c[0]) >> 5) * 64 +
                               (static_cast<std::size_t>(c[1]) >> 5) * 8 + (c[2] >> 5);
      shares[strip * cells + cell] += 1.0;
    }
    pixels[strip] += picture.width();
  }
  for (std::size_t i = 0; i < shares.size(); ++i) shares[i] /= std::max(1.0, pixels[i / cells]);
  return shares;
}

}  // namespace

LayoutFigures layout_figures(const Grid<Rgb8>& crop, const Grid<Rgb8>& made) {
  LayoutFigures figures;
  const std::vector<double> wanted = colour_profile(crop);
  const std::vector<double> found = colour_profile(made);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    figures.profile += std::abs(wanted[i] - found[i]) / strips;

  const BandSpace bands = find_bands(crop, {});
  const BandPicture one = to_bands(crop, bands, {});
  const BandPicture other = to_bands(made, bands, {});
  int types = 0;
  for (const int far : {16, 32, 64, 128}) {
    for (const bool along : {true, false}) {
      if (far >=
          std::min(along ? crop.width() : crop.height(), along ? made.width() : made.height()))
        continue;
      for (int band = 0; band < 3; ++band) {
        const CliqueType type{0, along ? far : 0, along ? 0 : far, band, band};
        figures.far_pairs += HistogramGroups(count_differences(one, bands, type))
                                 .distance(count_differences(other, bands, type))
                                 .l1;
        ++types;
      }
    }
  }
  figures.far_pairs /= std::max(types, 1);
  return figures;
}

}  // namespace belvedere
