#include "renderer/exemplar/fill_excluded.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/masks/label_blur.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/pixel_rect.h"
#include "renderer/image/srgb.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/learn_texture.h"
#include "texture/statistical/make_texture.h"
#include "texture/synthesis/exemplar.h"

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

namespace {

constexpr double around_strokes = 1.5;  // sigma of the mean over neighbours, in widths of a stroke
constexpr float min_coherence = 0.2F;   // (λ1 - λ2) / (λ1 + λ2): 0 no direction, 1 lines
constexpr float min_variation =
    1e-7F;  // of squared gradients of lightness; below this, paint is flat
constexpr float steepness_of_lying = 0.26F;  // sine of 15°

}  // namespace

Grid<glm::vec2> find_stroke_direction(const Grid<glm::vec3>& picture,
                                      const Grid<std::uint8_t>& labels, double stroke_px) {
  const int width = picture.width();
  const int height = picture.height();
  Grid<float> lightness(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) lightness(x, y) = static_cast<float>(to_oklab(picture(x, y)).x);
  });
  Grid<float> xx(width, height, 0.F);
  Grid<float> xy(width, height, 0.F);
  Grid<float> yy(width, height, 0.F);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::uint8_t label = labels(x, y);
      if (label == unused_label) continue;
      bool inside = x > 0 && y > 0 && x + 1 < width && y + 1 < height;
      for (int v = -1; v <= 1 && inside; ++v)
        for (int u = -1; u <= 1 && inside; ++u) inside = labels(x + u, y + v) == label;
      if (!inside) continue;
      // Scharr's weights: the direction is accurate to a tenth of a degree.
      const auto at = [&](int u, int v) { return lightness(x + u, y + v); };
      const float gx = (3.F * (at(1, -1) - at(-1, -1)) + 10.F * (at(1, 0) - at(-1, 0)) +
                        3.F * (at(1, 1) - at(-1, 1))) /
                       32.F;
      const float gy = (3.F * (at(-1, 1) - at(-1, -1)) + 10.F * (at(0, 1) - at(0, -1)) +
                        3.F * (at(1, 1) - at(1, -1))) /
                       32.F;
      xx(x, y) = gx * gx;
      xy(x, y) = gx * gy;
      yy(x, y) = gy * gy;
    }
  });
  const double sigma = around_strokes * stroke_px;
  xx = blur_within_labels(xx, labels, sigma);
  xy = blur_within_labels(xy, labels, sigma);
  yy = blur_within_labels(yy, labels, sigma);
  Grid<glm::vec2> direction(width, height, glm::vec2(0.F));
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = direction.index(x, y);
      const float sum = xx[i] + yy[i];
      const double difference = xx[i] - yy[i];
      const double twice = 2.0 * static_cast<double>(xy[i]);
      if (sum < min_variation || std::sqrt(difference * difference + twice * twice) <
                                     static_cast<double>(min_coherence * sum))
        continue;
      const double across =
          0.5 * exact::atan2(
                    twice, difference);  // of the steepest change of lightness: across the strokes
      glm::vec2 along(static_cast<float>(-exact::sin(across)),
                      static_cast<float>(exact::cos(across)));
      if (along.y < 0.F) along = -along;
      if (along.y >= steepness_of_lying) direction[i] = along;
    }
  });
  return direction;
}

}  // namespace belvedere
