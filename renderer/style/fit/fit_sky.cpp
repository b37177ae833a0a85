#include "renderer/style/fit/fit_sky.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/filter.h"
#include "base/land_cover_class.h"
#include "base/matrix/matrix.h"
#include "base/parallel.h"
#include "base/pixel_rect.h"
#include "base/statistics.h"

namespace belvedere {
namespace {

constexpr std::uint8_t sky_label_number = static_cast<std::uint8_t>(LandCoverClass::sky);
// Sigma of the smallest changes that count as clouds, and of the clouds whose edges are measured,
// as shares of the root of the sky's area.
constexpr double cloud_share = 1.0 / 90.0;
constexpr double edge_share = 1.0 / 40.0;
constexpr double edge_quantile = 0.05;
constexpr std::size_t min_edge_cells = 200;
constexpr double clear_part = 0.05;  // of the sky's upper half that shows clear sky at its purest
constexpr std::array<double, 7> amount_shares = {0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.98};
// Ranks of lightness within a sky: light of clouds, and their shade.
constexpr double clouds_light_share = 11.0 / 12.0;
constexpr std::array<double, 2> shade_shares = {0.25, 1.0 / 3.0};

glm::dvec3 median_of(const std::vector<glm::vec3>& texels) {
  glm::dvec3 out(0.0);
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<float> values;
    values.reserve(texels.size());
    for (const glm::vec3& texel : texels) values.push_back(texel[channel]);
    out[channel] = static_cast<double>(middle_value(std::move(values)));
  }
  return out;
}

std::vector<glm::vec3> sky_texels(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                                  const PixelRect& part) {
  std::vector<glm::vec3> texels;
  for (int y = part.y0; y < part.y1; ++y)
    for (int x = part.x0; x < part.x1; ++x)
      if (mask(x, y) == sky_label_number) texels.push_back(colours(x, y));
  return texels;
}

// Linear between the centres of cells, constant beyond them; u, v in shares.
glm::dvec3 grid_colour(const Grid<glm::vec3>& grid, double u, double v) {
  const double x = std::clamp(u * grid.width() - 0.5, 0.0, grid.width() - 1.0);
  const double y = std::clamp(v * grid.height() - 0.5, 0.0, grid.height() - 1.0);
  const int i = static_cast<int>(x);
  const int j = static_cast<int>(y);
  const glm::dvec3 upper = (1.0 - (x - i)) * glm::dvec3(grid.clamped(i, j)) +
                           (x - i) * glm::dvec3(grid.clamped(i + 1, j));
  const glm::dvec3 lower = (1.0 - (x - i)) * glm::dvec3(grid.clamped(i, j + 1)) +
                           (x - i) * glm::dvec3(grid.clamped(i + 1, j + 1));
  return (1.0 - (y - j)) * upper + (y - j) * lower;
}

// Sky minus the grid, blurred to the size of clouds and subsampled; `there` is 1 where there is
// sky.
struct SkyRest {
  std::array<Grid<float>, 3> colour;
  Grid<std::uint8_t> there;
  double sigma_cells = 1.0;  // of the blur
};

SkyRest sky_rest(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                 const PixelRect& box, const Grid<glm::vec3>& medians) {
  const int width = box.x1 - box.x0;
  const int height = box.y1 - box.y0;
  const double sigma = cloud_share * std::sqrt(static_cast<double>(width) * height);
  std::array<Grid<float>, 3> rest;
  for (Grid<float>& channel : rest) channel = Grid<float>(width, height, 0.0F);
  Grid<float> weight(width, height, 0.0F);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (mask(box.x0 + x, box.y0 + y) != sky_label_number) continue;
      weight(x, y) = 1.0F;
      const glm::dvec3 off = glm::dvec3(colours(box.x0 + x, box.y0 + y)) -
                             grid_colour(medians, (x + 0.5) / width, (y + 0.5) / height);
      for (int c = 0; c < 3; ++c)
        rest[static_cast<std::size_t>(c)](x, y) = static_cast<float>(off[c]);
    }
  });
  const Grid<float> soft_weight = gaussian_blur(weight, sigma);
  const int step = std::max(1, static_cast<int>(sigma / 3.0));
  SkyRest out;
  out.sigma_cells = sigma / step;
  out.there = Grid<std::uint8_t>((width - 1) / step + 1, (height - 1) / step + 1);
  for (std::size_t c = 0; c < 3; ++c) {
    const Grid<float> soft = gaussian_blur(rest[c], sigma);
    out.colour[c] = Grid<float>(out.there.width(), out.there.height());
    for (int y = 0; y < out.there.height(); ++y)
      for (int x = 0; x < out.there.width(); ++x) {
        out.there(x, y) = weight(x * step, y * step) > 0.0F ? 1 : 0;
        out.colour[c](x, y) =
            soft(x * step, y * step) / std::max(soft_weight(x * step, y * step), 0.05F);
      }
  }
  return out;
}

// The lag, in cells, at which the correlation of `values` has fallen to one half, along x or y.
double half_correlation(const Grid<float>& values, const Grid<std::uint8_t>& there, bool along_x) {
  const int extent = along_x ? values.width() : values.height();
  double before = 1.0;
  double base = 0.0;
  for (int lag = 0; lag < extent / 2; ++lag) {
    double sum = 0.0;
    double count = 0.0;
    const int dx = along_x ? lag : 0;
    const int dy = along_x ? 0 : lag;
    for (int y = 0; y + dy < values.height(); ++y)
      for (int x = 0; x + dx < values.width(); ++x) {
        if (there(x, y) == 0 || there(x + dx, y + dy) == 0) continue;
        sum += static_cast<double>(values(x, y)) * static_cast<double>(values(x + dx, y + dy));
        count += 1.0;
      }
    if (lag == 0) {
      base = sum / std::max(count, 1.0);
      if (base <= 0.0) return extent / 4.0;
      continue;
    }
    const double correlation = sum / std::max(count, 1.0) / base;
    if (correlation < 0.5) return lag - 1 + (before - 0.5) / std::max(before - correlation, 1e-9);
    before = correlation;
  }
  return extent / 4.0;
}

// An amount blurred within the sky, and the share of sky under the kernel.
struct SoftAmount {
  Grid<float> amount;
  Grid<float> weight;
};

SoftAmount soften(const Grid<float>& amount, const Grid<std::uint8_t>& there, double sigma) {
  SoftAmount soft{Grid<float>(amount.width(), amount.height(), 0.0F), {}};
  soft.weight = soft.amount;
  for (std::size_t i = 0; i < amount.size(); ++i)
    if (there[i] != 0) {
      soft.amount[i] = amount[i];
      soft.weight[i] = 1.0F;
    }
  soft.amount = gaussian_blur(soft.amount, sigma);
  soft.weight = gaussian_blur(soft.weight, sigma);
  for (std::size_t i = 0; i < amount.size(); ++i) soft.amount[i] /= std::max(soft.weight[i], 0.05F);
  return soft;
}

// Deviations between Gaussians of 1, 2, 4 and 8 `sigma`, with the first of which `amount` is
// already blurred.
std::array<double, 3> streaks_of(const Grid<float>& amount, const Grid<std::uint8_t>& there,
                                 double sigma) {
  std::array<double, 3> streaks{};
  Grid<float> finer = amount;
  for (std::size_t k = 0; k < streaks.size(); ++k) {
    const double wide = static_cast<double>(2 << k);
    Grid<float> coarser = soften(amount, there, sigma * std::sqrt(wide * wide - 1.0)).amount;
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < finer.size(); ++i) {
      if (there[i] == 0) continue;
      const double off = static_cast<double>(finer[i]) - static_cast<double>(coarser[i]);
      squares += off * off;
      count += 1.0;
    }
    streaks[k] = std::min(1.0, std::sqrt(squares / std::max(count, 1.0)));
    finer = std::move(coarser);
  }
  return streaks;
}

// Skewness of the vertical gradient of `amount` in the upper half, from quantiles, so that a branch
// or bird in the mask does not decide it.
double upper_edges(const Grid<float>& amount, const Grid<std::uint8_t>& there, double sigma) {
  const SoftAmount softened = soften(amount, there, sigma);
  const Grid<float>& soft = softened.amount;
  const Grid<float>& weight = softened.weight;
  constexpr float well_inside = 0.9F;
  std::vector<double> gradients;
  for (int y = 1; y < amount.height() / 2; ++y)
    for (int x = 0; x < amount.width(); ++x)
      if (weight(x, y - 1) > well_inside && weight(x, y + 1) > well_inside)
        gradients.push_back(static_cast<double>(soft(x, y + 1) - soft(x, y - 1)));
  if (gradients.size() < min_edge_cells) return 0.0;
  const double low = value_at_share(gradients, edge_quantile);
  const double high = value_at_share(gradients, 1.0 - edge_quantile);
  return high > low ? std::clamp((high + low) / (high - low), -1.0, 1.0) : 0.0;
}

// The bluest part of the upper half, and the share of texels that are nearer to it than to the
// medians.
void fit_clear(const SkyRest& rest, StyleSky& sky) {
  std::vector<glm::vec3> texels;
  std::vector<float> blues;
  for (int y = 0; y < rest.there.height() / 2; ++y)
    for (int x = 0; x < rest.there.width(); ++x) {
      if (rest.there(x, y) == 0) continue;
      texels.emplace_back(rest.colour[0](x, y), rest.colour[1](x, y), rest.colour[2](x, y));
      blues.push_back(texels.back().z);
    }
  if (texels.size() < min_edge_cells) return;
  const float limit = value_at_share(blues, clear_part);
  glm::dvec3 sum(0.0);
  double count = 0.0;
  for (const glm::vec3& texel : texels)
    if (texel.z <= limit) {
      sum += glm::dvec3(texel);
      count += 1.0;
    }
  sky.clear = glm::vec3(sum / count);
  double nearer = 0.0;
  for (const glm::vec3& texel : texels)
    if (glm::dot(texel - 0.5F * sky.clear, sky.clear) > 0.0F) nearer += 1.0;
  sky.clear_share = nearer / static_cast<double>(texels.size());
}

void fit_changes(const SkyRest& rest, StyleSky& sky) {
  glm::dvec3 mean(0.0);
  glm::dmat3 products(0.0);
  double count = 0.0;
  const auto colour_at = [&](std::size_t i) {
    return glm::dvec3(rest.colour[0][i], rest.colour[1][i], rest.colour[2][i]);
  };
  for (std::size_t i = 0; i < rest.there.size(); ++i) {
    if (rest.there[i] == 0) continue;
    mean += colour_at(i);
    products += glm::outerProduct(colour_at(i), colour_at(i));
    count += 1.0;
  }
  mean /= count;
  const SymmetricEigen eigen = symmetric_eigen(products / count - glm::outerProduct(mean, mean));
  std::array<int, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return eigen.values[a] > eigen.values[b]; });
  for (int k = 0; k < 2; ++k) {
    const double deviation =
        std::sqrt(std::max(eigen.values[order[static_cast<std::size_t>(k)]], 0.0));
    if (deviation < 1e-5) break;  // a flat sky
    glm::dvec3 way = eigen.vectors[order[static_cast<std::size_t>(k)]];
    if (way.x < 0.0) way = -way;
    Grid<float> amount(rest.there.width(), rest.there.height(), 0.0F);
    std::vector<double> amounts;
    for (std::size_t i = 0; i < amount.size(); ++i) {
      const glm::dvec3 c = colour_at(i);
      amount[i] = static_cast<float>((c.x * way.x + c.y * way.y + c.z * way.z) / deviation);
      if (rest.there[i] != 0) amounts.push_back(static_cast<double>(amount[i]));
    }
    StyleSkyChange change;
    change.axis = glm::vec3(deviation * way);
    change.streaks = streaks_of(amount, rest.there, rest.sigma_cells);
    change.length_x = half_correlation(amount, rest.there, true) / amount.width();
    change.length_y = half_correlation(amount, rest.there, false) / amount.height();
    for (std::size_t q = 0; q < amount_shares.size(); ++q)
      change.quantiles[q] = value_at_share(amounts, amount_shares[q]);
    if (k == 0)
      sky.upper_edges =
          upper_edges(amount, rest.there, rest.sigma_cells * edge_share / cloud_share);
    sky.changes.push_back(change);
  }
}

}  // namespace

FittedSky fit_sky(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                  const SkyFitParameters& parameters) {
  FittedSky out;
  PixelRect box{mask.width(), mask.height(), 0, 0};
  std::size_t count = 0;
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (mask(x, y) == sky_label_number) {
        box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
               std::max(box.y1, y + 1)};
        ++count;
      }
  if (count < parameters.min_texels) return out;
  std::vector<glm::vec3> all = sky_texels(colours, mask, box);
  const glm::dvec3 whole = median_of(all);
  Grid<glm::vec3> medians(parameters.columns, parameters.rows);
  for (int j = 0; j < parameters.rows; ++j) {
    PixelRect part = box;
    part.y0 = box.y0 + (box.y1 - box.y0) * j / parameters.rows;
    part.y1 = box.y0 + (box.y1 - box.y0) * (j + 1) / parameters.rows;
    const std::vector<glm::vec3> row = sky_texels(colours, mask, part);
    out.gradient.push_back(row.empty() ? whole : median_of(row));
    for (int i = 0; i < parameters.columns; ++i) {
      part.x0 = box.x0 + (box.x1 - box.x0) * i / parameters.columns;
      part.x1 = box.x0 + (box.x1 - box.x0) * (i + 1) / parameters.columns;
      const std::vector<glm::vec3> cell = sky_texels(colours, mask, part);
      medians(i, j) = glm::vec3(cell.size() > parameters.min_cell_texels ? median_of(cell)
                                                                         : out.gradient.back());
    }
  }
  out.sky.aspect =
      std::clamp(static_cast<double>(box.width()) / static_cast<double>(box.height()), 0.1, 20.0);
  const SkyRest rest = sky_rest(colours, mask, box, medians);
  fit_changes(rest, out.sky);
  fit_clear(rest, out.sky);
  out.sky.medians = std::move(medians);
  std::stable_sort(all.begin(), all.end(),
                   [](const glm::vec3& a, const glm::vec3& b) { return a.x < b.x; });
  const auto part = [&](double from, double to) {
    const auto size = static_cast<double>(all.size());
    return median_of({all.begin() + static_cast<std::ptrdiff_t>(from * size),
                      all.begin() + static_cast<std::ptrdiff_t>(to * size)});
  };
  out.cloud_light = part(clouds_light_share, 1.0);
  out.cloud_shade = part(shade_shares[0], shade_shares[1]);
  return out;
}

}  // namespace belvedere
