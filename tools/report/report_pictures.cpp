#include "tools/report/report_pictures.h"

#include <cmath>
#include <fstream>
#include <iterator>

#include "base/files/output_file.h"
#include "base/land_cover_class.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "base/text/hex_colour.h"
#include "base/text/text_encoding.h"
#include "renderer/image/image_io.h"
#include "renderer/labels/sheet_painter.h"
#include "terrain/shape/derivatives.h"

namespace belvedere::tools {
namespace {

// Hues spaced by the golden ratio; excluded is near black.
glm::vec3 label_colour(std::uint8_t label) {
  if (label == unused_label) return glm::vec3(0.12F);
  const float hue = 6.F * static_cast<float>(std::fmod(0.1 + label * 0.6180339887, 1.0));
  const auto part = [hue](float shift) {
    return std::clamp(std::abs(std::fmod(hue + shift, 6.F) - 3.F) - 1.F, 0.F, 1.F);
  };
  return glm::vec3(0.25F) + 0.6F * glm::vec3(part(0.F), part(4.F), part(2.F));
}

glm::vec3 mix(glm::vec3 a, glm::vec3 b, float t) { return a + t * (b - a); }

}  // namespace

Reduced reduce_to(const Grid<float>& cells, int longest_px) {
  Reduced out;
  out.factor = std::max(1, (std::max(cells.width(), cells.height()) + longest_px - 1) / longest_px);
  if (out.factor == 1) {
    out.cells = cells;
    return out;
  }
  const int n = out.factor;
  out.cells = Grid<float>((cells.width() + n - 1) / n, (cells.height() + n - 1) / n);
  parallel_rows(out.cells.height(), [&](int y) {
    for (int x = 0; x < out.cells.width(); ++x) {
      double sum = 0.0;
      int count = 0;
      for (int v = y * n; v < std::min((y + 1) * n, cells.height()); ++v) {
        for (int u = x * n; u < std::min((x + 1) * n, cells.width()); ++u, ++count)
          sum += static_cast<double>(cells(u, v));
      }
      out.cells(x, y) = static_cast<float>(sum / count);
    }
  });
  return out;
}

Grid<glm::vec3> relief_picture(const Grid<float>& altitude_m, glm::dvec2 cell_m, int longest_px) {
  const Reduced small = reduce_to(altitude_m, longest_px);
  const Grid<std::uint8_t> shade =
      hillshade(small.cells, small.factor * cell_m.x, small.factor * cell_m.y, {});
  Grid<glm::vec3> out(shade.width(), shade.height());
  std::transform(shade.begin(), shade.end(), out.begin(),
                 [](std::uint8_t s) { return glm::vec3(static_cast<float>(s) / 255.F); });
  return out;
}

Grid<glm::vec3> change_picture(const Grid<float>& before_m, const Grid<float>& after_m,
                               glm::dvec2 cell_m, float full_m, int longest_px) {
  Grid<glm::vec3> out = relief_picture(after_m, cell_m, longest_px);
  const Grid<float> before = reduce_to(before_m, longest_px).cells;
  const Grid<float> after = reduce_to(after_m, longest_px).cells;
  const glm::vec3 red(0.80F, 0.10F, 0.08F);
  const glm::vec3 blue(0.08F, 0.30F, 0.80F);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const float change = (after[i] - before[i]) / full_m;
    const float strength = 0.85F * std::min(std::abs(change), 1.F);
    out[i] = mix(out[i], (change < 0.F ? red : blue) * (0.35F + 0.65F * out[i].x), strength);
  }
  return out;
}

Grid<glm::vec3> signed_picture(const Grid<float>& values, float full) {
  Grid<glm::vec3> out(values.width(), values.height());
  std::transform(values.begin(), values.end(), out.begin(), [full](float v) {
    return glm::vec3(std::clamp(0.5F + 0.5F * v / std::max(full, 1e-6F), 0.F, 1.F));
  });
  return out;
}

Grid<glm::vec3> reduced_picture(const Grid<glm::vec3>& picture, int longest_px) {
  Grid<glm::vec3> out;
  for (int c = 0; c < 3; ++c) {
    Grid<float> channel(picture.width(), picture.height());
    std::transform(picture.begin(), picture.end(), channel.begin(),
                   [c](const glm::vec3& colour) { return colour[c]; });
    const Grid<float> small = reduce_to(channel, longest_px).cells;
    if (out.empty()) out = Grid<glm::vec3>(small.width(), small.height());
    for (std::size_t i = 0; i < small.size(); ++i) out[i][c] = small[i];
  }
  return out;
}

Grid<glm::vec3> to_picture(const Grid<Rgb8>& colours) {
  Grid<glm::vec3> out(colours.width(), colours.height());
  std::transform(colours.begin(), colours.end(), out.begin(),
                 [](const Rgb8& c) { return glm::vec3(c[0], c[1], c[2]) / 255.F; });
  return out;
}

Grid<glm::vec3> label_picture(const Grid<std::uint8_t>& labels) {
  Grid<glm::vec3> out(labels.width(), labels.height());
  std::transform(labels.begin(), labels.end(), out.begin(), label_colour);
  return out;
}

std::vector<std::array<std::uint8_t, 3>> class_map_colours() {
  std::vector<std::array<std::uint8_t, 3>> out(256, {0, 0, 0});
  for (const LandCoverClassInfo& info : land_cover_classes())
    out[static_cast<std::size_t>(info.id)] = {static_cast<std::uint8_t>(info.rgb >> 16U),
                                              static_cast<std::uint8_t>(info.rgb >> 8U & 255U),
                                              static_cast<std::uint8_t>(info.rgb & 255U)};
  return out;
}

Grid<glm::vec3> enlarged(const Grid<glm::vec3>& picture, int times) {
  Grid<glm::vec3> out(picture.width() * times, picture.height() * times);
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) out(x, y) = picture(x / times, y / times);
  return out;
}

Grid<glm::vec3> heat_picture(const Grid<float>& values, float full) {
  Grid<glm::vec3> out(values.width(), values.height());
  std::transform(values.begin(), values.end(), out.begin(), [full](float v) {
    const float t = 3.F * std::clamp(v / std::max(full, 1e-6F), 0.F, 1.F);
    return glm::vec3(std::clamp(t, 0.F, 1.F), std::clamp(t - 1.F, 0.F, 1.F),
                     std::clamp(t - 2.F, 0.F, 1.F));
  });
  return out;
}

float percentile(const Grid<float>& values, double share) {
  if (values.empty()) return 0.F;
  const std::size_t step = std::max<std::size_t>(1, values.size() / 1000000);
  std::vector<float> some;
  for (std::size_t i = 0; i < values.size(); i += step) some.push_back(values[i]);
  return value_at_share(std::move(some), share);
}

PixelRect best_window(const Grid<float>& score, const Grid<float>& where, int side) {
  const int width = std::min(side, score.width());
  const int height = std::min(side, score.height());
  const int step = std::max(1, side / 2);
  PixelRect best{0, 0, width, height};
  double best_sum = -1.0;
  double best_place = -1.0;
  for (int y0 = 0;; y0 = std::min(y0 + step, score.height() - height)) {
    for (int x0 = 0;; x0 = std::min(x0 + step, score.width() - width)) {
      double sum = 0.0;
      double position = 0.0;
      for (int y = y0; y < y0 + height; ++y) {
        for (int x = x0; x < x0 + width; ++x) {
          sum += static_cast<double>(score(x, y));
          position += where.empty() ? 1.0 : static_cast<double>(where(x, y));
        }
      }
      position = std::min(position / (static_cast<double>(width) * height), 0.5);
      if (position > best_place || (position == best_place && sum > best_sum)) {
        best = {x0, y0, x0 + width, y0 + height};
        best_sum = sum;
        best_place = position;
      }
      if (x0 + width >= score.width()) break;
    }
    if (y0 + height >= score.height()) break;
  }
  return best;
}

namespace {

constexpr int capital_px = 7;  // at scale 1

TextStyle type_of(int scale) { return {.family = "sans-serif", .size_px = 9.0 * scale}; }

}  // namespace

int text_width(const std::string& text, int scale) {
  return text.empty()
             ? 0
             : static_cast<int>(std::ceil(TextMeasure().measure(text, type_of(scale)).width_px));
}

void draw_text(Grid<glm::vec3>& picture, int x, int y, const std::string& text, glm::vec3 colour,
               int scale) {
  if (text.empty()) return;
  const DrawnText line{.text = text,
                       .type = type_of(scale),
                       .at = {x, y + capital_px * scale},
                       .colour = hex_colour(colour)};
  SheetPainter({.size_px = {picture.width(), picture.height()}, .shapes = {line}})
      .paint(picture, {0, 0});
}

namespace {

// The writers write files.
template <class Write>
std::string bytes_of(const char* extension, const Write& write) {
  const ScratchFolder folder;
  const std::string path = folder.path() + "/picture." + extension;
  write(path);
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::string jpeg_bytes(const Grid<glm::vec3>& picture, int quality) {
  return bytes_of("jpg", [&](const std::string& path) { write_jpeg(path, picture, quality); });
}

std::string png_bytes(const Grid<glm::vec3>& picture) {
  return bytes_of("png", [&](const std::string& path) { write_png8(path, picture, {}); });
}

std::string png_address(const Grid<glm::vec3>& picture) {
  return "data:image/png;base64," + base64(png_bytes(picture));
}

}  // namespace belvedere::tools
