#include "renderer/exemplar/fill_excluded.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/pixel_rect.h"
#include "texture/statistical/label_borders.h"
#include "texture/statistical/learn_texture.h"
#include "texture/statistical/make_texture.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {
namespace {

constexpr int joined_px = 16;  // letters nearer than twice this are filled together
constexpr int around_px = 96;  // width around a group from which its models are learnt; doubled
                               // until there is enough paint
constexpr int learnt_types = 32;
constexpr std::size_t min_crop_texels = std::size_t{min_crop_px} * min_crop_px;

// Excluded pixels without a class take that of the nearest pixel, from the edge inwards; ties are
// resolved row by row.
void spread_classes(Grid<std::uint8_t>& labels, const Grid<std::uint8_t>& excluded) {
  std::vector<std::pair<int, int>> open;
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x)
      if (excluded(x, y) != 0 && labels(x, y) == unused_label) open.emplace_back(x, y);
  constexpr std::array<std::array<int, 2>, 4> beside = {{{0, -1}, {-1, 0}, {1, 0}, {0, 1}}};
  while (!open.empty()) {
    std::vector<std::pair<int, int>> still;
    std::vector<std::pair<std::size_t, std::uint8_t>> found;
    for (const auto& [x, y] : open) {
      std::uint8_t label = unused_label;
      for (const auto& step : beside)
        if (label == unused_label && labels.contains(x + step[0], y + step[1]))
          label = labels(x + step[0], y + step[1]);
      if (label == unused_label)
        still.emplace_back(x, y);
      else
        found.emplace_back(labels.index(x, y), label);
    }
    if (found.empty()) return;
    for (const auto& [i, label] : found) labels[i] = label;
    open = std::move(still);
  }
}

// Bounding boxes of the excluded areas, group by group, and the group of each pixel, from 1.
struct Groups {
  Grid<std::uint16_t> of;
  std::vector<PixelRect> boxes;
};

Groups find_groups(const Grid<std::uint8_t>& excluded) {
  const Grid<std::uint8_t> joined = widened(excluded, joined_px);
  Groups groups{Grid<std::uint16_t>(joined.width(), joined.height()), {}};
  std::vector<std::pair<int, int>> front;
  constexpr std::size_t max = 4096;  // later areas belong to the last group
  for (int y = 0; y < joined.height(); ++y)
    for (int x = 0; x < joined.width(); ++x) {
      if (joined(x, y) == 0 || groups.of(x, y) != 0) continue;
      if (groups.boxes.size() < max) groups.boxes.push_back({x, y, x, y});
      PixelRect& box = groups.boxes.back();
      const auto number = static_cast<std::uint16_t>(groups.boxes.size());
      groups.of(x, y) = number;
      front.emplace_back(x, y);
      while (!front.empty()) {
        const auto [u, v] = front.back();
        front.pop_back();
        box = {std::min(box.x0, u), std::min(box.y0, v), std::max(box.x1, u + 1),
               std::max(box.y1, v + 1)};
        for (const auto& [i, j] : {std::pair{u - 1, v}, {u + 1, v}, {u, v - 1}, {u, v + 1}})
          if (joined.contains(i, j) && joined(i, j) != 0 && groups.of(i, j) == 0) {
            groups.of(i, j) = number;
            front.emplace_back(i, j);
          }
      }
    }
  return groups;
}

// A part of a painting, and its pixels of one class.
struct Part {
  PixelRect rect;
  Grid<Rgb8> picture;
  Grid<std::uint8_t> known;  // of the class and not excluded
  std::size_t count = 0;
};

Part part_around(const FilledPaint& paint, const Grid<std::uint8_t>& excluded, std::uint8_t label,
                 PixelRect box, int around) {
  Part part;
  part.rect = intersection(grown(box, around), {0, 0, excluded.width(), excluded.height()});
  part.picture = Grid<Rgb8>(part.rect.width(), part.rect.height());
  part.known = Grid<std::uint8_t>(part.rect.width(), part.rect.height());
  for (int y = 0; y < part.picture.height(); ++y)
    for (int x = 0; x < part.picture.width(); ++x) {
      const std::size_t i = excluded.index(part.rect.x0 + x, part.rect.y0 + y);
      part.picture(x, y) = to_rgb8(paint.picture[i]);
      const bool is = excluded[i] == 0 && paint.labels[i] == label;
      part.known(x, y) = is ? pixel_free : 0;
      part.count += is ? 1 : 0;
    }
  return part;
}

// A model of a class around a group: from the smallest surroundings with enough paint, up to the
// whole painting.
std::optional<CliqueModel> learn_around(const FilledPaint& paint,
                                        const Grid<std::uint8_t>& excluded, std::uint8_t label,
                                        PixelRect box) {
  const int farthest = std::max(excluded.width(), excluded.height());
  for (int around = around_px;; around *= 2) {
    const Part part = part_around(paint, excluded, label, box, around);
    const bool wide = std::min(part.picture.width(), part.picture.height()) >= min_crop_px;
    if (wide && part.count >= 2 * min_crop_texels) {
      LearnParameters learning;
      learning.types = learnt_types;
      try {
        return learn_texture(part.picture, part.known, learning).model;
      } catch (const Error&) {
        // One flat colour: it may vary farther away.
      }
    }
    if (around > farthest) return std::nullopt;
  }
}

}  // namespace

FilledPaint fill_excluded(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                          const Grid<std::uint8_t>& excluded, Progress& progress) {
  if (!labels.same_size(picture) || !excluded.same_size(picture))
    throw Error(ErrorKind::bug, "fill_excluded",
                "picture, classes and exclusion have different sizes");
  FilledPaint paint{picture, labels, 0, 0};
  spread_classes(paint.labels, excluded);
  const Groups groups = find_groups(excluded);
  progress.begin("filling excluded areas", static_cast<double>(groups.boxes.size()));
  for (std::size_t g = 0; g < groups.boxes.size(); ++g) {
    const PixelRect box = groups.boxes[g];
    const auto within = [&](std::size_t i) { return excluded[i] != 0 && groups.of[i] == g + 1; };
    std::array<std::size_t, 256> wanted{};
    for (int y = box.y0; y < box.y1; ++y)
      for (int x = box.x0; x < box.x1; ++x)
        if (within(excluded.index(x, y))) ++wanted[paint.labels(x, y)];
    for (std::size_t id = 0; id < wanted.size(); ++id) {
      if (wanted[id] == 0) continue;
      const auto label = static_cast<std::uint8_t>(id);
      const std::optional<CliqueModel> model =
          id == unused_label ? std::nullopt : learn_around(paint, excluded, label, box);
      const Part part = part_around(paint, excluded, label, box, around_px);
      Grid<std::uint8_t> hole(part.picture.width(), part.picture.height());
      for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x) {
          const std::size_t i = excluded.index(x, y);
          if (within(i) && paint.labels[i] == label) hole(x - part.rect.x0, y - part.rect.y0) = 1;
        }
      Grid<Rgb8> made;
      if (model) made = fill_among(part.picture, hole, part.known, {}, *model, {});
      for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x) {
          if (hole(x - part.rect.x0, y - part.rect.y0) == 0) continue;
          if (!model) {
            paint.labels(x, y) = unused_label;
            ++paint.left;
            continue;
          }
          const Rgb8& rgb = made(x - part.rect.x0, y - part.rect.y0);
          paint.picture(x, y) = glm::vec3(rgb[0], rgb[1], rgb[2]) / 255.F;
          ++paint.filled;
        }
    }
    progress.advance(1.0);
  }
  return paint;
}

}  // namespace belvedere
