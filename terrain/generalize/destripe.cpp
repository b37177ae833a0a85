#include "terrain/generalize/destripe.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/filter.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "terrain/generalize/stripe_fit.h"

// Across a stripe the terrain's fine detail h = z - blur(z) is noise whose sign changes along the
// line, while the stripe's part is constant. So along each line h = c · g is fitted over a long
// window, where g is 1 (an offset) or the slope of the smoothed terrain along or across the line (a
// displacement by -c cells). The stripe direction is the one in which such fits explain the most.
namespace belvedere {
namespace {

constexpr std::array<Follows, 3> kinds{Follows::offset, Follows::slope_along,
                                       Follows::slope_across};

struct Stripes {
  bool columns = false;  // they run nearly along columns
  Follows follows = Follows::offset;
  double tilt = 0.0;      // rows per column; for columns the reverse
  double contrast = 0.0;  // explained energy divided by the median over all directions
};

constexpr int smallest_side = 48;
constexpr double smoothing_cells = 1.6;  // of the terrain whose slope moves altitudes
// The tilt is searched with short pieces of lines first, which detect a stripe of 3 cells within
// ±.03, then with long ones near the best.
constexpr int scan_length = 96;
constexpr double scan_step = 0.01;
constexpr int fine_length = 320;
constexpr double fine_step = 0.002;
constexpr std::size_t scanned_cells = std::size_t{1} << 21;
// A line may exceed its neighbours by this factor (geometric mean of their amplitudes; a sine's
// crest has 2, a saw tooth 2.7): a ridge along the lines is a single large exception and must not
// be removed.
constexpr float max_exception = 4.F;

Grid<float> transposed(const Grid<float>& values) {
  Grid<float> out(values.height(), values.width());
  parallel_tiles(values.width(), values.height(), 64, [&](const PixelRect& tile) {
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) out(y, x) = values(x, y);
  });
  return out;
}

float median_size(const Grid<float>& values) {
  const std::size_t step = std::max<std::size_t>(1, values.size() / 65536);
  std::vector<float> sizes;
  for (std::size_t i = 0; i < values.size(); i += step) sizes.push_back(std::abs(values[i]));
  return middle_value(std::move(sizes));
}

// The terrain prepared for the fits, with lines along rows.
struct Detail {
  Grid<float> height_m;   // h: detail across the lines, narrower than the longest period
  Grid<float> smooth_m;   // its slope moves altitudes
  Grid<float> certainty;  // 0…1, small where the ground is curved (ridges, gullies) or rough
};

Detail find_detail(const Grid<float>& altitude_m, const DestripeParameters& parameters) {
  Detail detail;
  // 1 - G alone is not steep enough: a third of bands twice the longest period would pass. Cubed,
  // it passes .8 at the period and .1 at twice the period: (1 - exp(-2 π² σ² / period²))³.
  detail.height_m = altitude_m;
  for (int pass = 0; pass < 3; ++pass) {
    const Grid<float> mean =
        gaussian_blur(detail.height_m, 0.0, parameters.longest_period_cells / 2.74);
    parallel_rows(altitude_m.height(), [&](int y) {
      for (int x = 0; x < altitude_m.width(); ++x) detail.height_m(x, y) -= mean(x, y);
    });
  }
  detail.smooth_m = gaussian_blur(altitude_m, smoothing_cells);
  const Grid<float> broad = gaussian_blur(altitude_m, 1.6 * smoothing_cells);
  detail.certainty = Grid<float>(altitude_m.width(), altitude_m.height());
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < altitude_m.width(); ++x)
      detail.certainty(x, y) = detail.smooth_m(x, y) - broad(x, y);
  });
  const float rough_m = 4.F * std::max(median_size(detail.height_m), 1e-4F);
  const float bent_m = 2.F * std::max(median_size(detail.certainty), 1e-4F);
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < altitude_m.width(); ++x) {
      const float bend = detail.certainty(x, y) / bent_m;
      const float rough = detail.height_m(x, y) / rough_m;
      detail.certainty(x, y) = 1.F / ((1.F + bend * bend) * (1.F + rough * rough));
    }
  });
  return detail;
}

// A ridge along the lines is an exception among them and must not be taken for a stripe.
double sum_without_exceptions(const std::vector<float>& energies) {
  const float max = max_exception * max_exception * middle_value(energies);
  double sum = 0.0;
  for (const float energy : energies) sum += std::min(energy, max);
  return sum;
}

// The energy explained by fits along lines of each tilt. Lines are summed at the nearest cells,
// because interpolation would damp all tilts except 0.
std::vector<double> explained_energy(const Detail& detail, Follows follows,
                                     const std::vector<double>& tilts, int longest) {
  const int width = detail.height_m.width();
  const int height = detail.height_m.height();
  const int length = std::min(longest, width);
  const int pieces = width / length;
  const int used = std::clamp(
      static_cast<int>(scanned_cells / (static_cast<std::size_t>(length) * height)), 1, pieces);
  const int margin = static_cast<int>(std::ceil(
                         std::max(std::abs(tilts.front()), std::abs(tilts.back())) * length / 2)) +
                     1;
  const int lines = height + 2 * margin;
  Grid<double> energy(static_cast<int>(tilts.size()), used);
  parallel_rows(used, [&](int piece) {
    const int x0 = static_cast<int>(static_cast<long>(piece) * pieces / used) * length;
    // Columns are contiguous in memory, with empty margins: a shift across lines is then an offset.
    std::vector<float> product(static_cast<std::size_t>(lines) * length);
    std::vector<float> square(product.size());
    for (int y = 0; y < height; ++y) {
      for (int i = 0; i < length; ++i) {
        const float g = followed(detail.smooth_m, follows, x0 + i, y);
        const float weighted = detail.certainty(x0 + i, y) * g;
        const std::size_t at = static_cast<std::size_t>(i) * lines + margin + y;
        product[at] = weighted * detail.height_m(x0 + i, y);
        square[at] = weighted * g;
      }
    }
    std::vector<float> p(static_cast<std::size_t>(height));
    std::vector<float> q(p.size());
    for (std::size_t t = 0; t < tilts.size(); ++t) {
      std::fill(p.begin(), p.end(), 0.F);
      std::fill(q.begin(), q.end(), 0.F);
      for (int i = 0; i < length; ++i) {
        const auto shift = static_cast<int>(std::lround(tilts[t] * (i - 0.5 * (length - 1))));
        const std::size_t at =
            static_cast<std::size_t>(i) * lines + static_cast<std::size_t>(margin + shift);
        for (int y = 0; y < height; ++y) p[y] += product[at + y];
        for (int y = 0; y < height; ++y) q[y] += square[at + y];
      }
      for (int y = 0; y < height; ++y) p[y] = q[y] > 0.F ? p[y] * p[y] / q[y] : 0.F;
      energy(static_cast<int>(t), piece) = sum_without_exceptions(p);
    }
  });
  std::vector<double> total(tilts.size(), 0.0);
  for (int piece = 0; piece < used; ++piece)
    for (std::size_t t = 0; t < tilts.size(); ++t) total[t] += energy(static_cast<int>(t), piece);
  return total;
}

// The tilt at which long lines explain the most.
double refine_tilt(const Detail& detail, const Stripes& stripes) {
  std::vector<double> tilts;
  for (int i = -6; i <= 6; ++i) tilts.push_back(stripes.tilt + i * fine_step);
  const std::vector<double> energy = explained_energy(detail, stripes.follows, tilts, fine_length);
  const auto best =
      static_cast<std::size_t>(std::max_element(energy.begin(), energy.end()) - energy.begin());
  // Lines this close to the axis need no interpolation.
  return std::abs(tilts[best]) < 1.6 * fine_step ? 0.0 : tilts[best];
}

// The strongest stripes near this axis.
Stripes find_stripes(const Detail& detail, bool columns, const DestripeParameters& parameters) {
  const int steps = static_cast<int>(std::lround(parameters.max_tilt / scan_step));
  // Tilts outside the search range still show how coherent terrain without stripes is.
  const int scanned = std::max(steps, 30);
  std::vector<double> tilts;
  for (int i = -scanned; i <= scanned; ++i) tilts.push_back(i * scan_step);
  Stripes best;
  for (const Follows follows : kinds) {
    const std::vector<double> energy = explained_energy(detail, follows, tilts, scan_length);
    std::vector<double> sorted = energy;
    std::sort(sorted.begin(), sorted.end());
    const double centre = sorted[sorted.size() / 2];
    if (centre <= 0.0) continue;
    for (int i = scanned - steps; i <= scanned + steps; ++i)
      if (energy[i] / centre > best.contrast)
        best = {columns, follows, tilts[i], energy[i] / centre};
  }
  return best;
}

// Lakes were flattened after the stripes appeared: nothing is subtracted from them, up to the
// shore.
Grid<std::uint8_t> find_level(const Grid<float>& altitude_m) {
  const auto amid_equals = [&](int x, int y) {
    const float z = altitude_m.clamped(x, y);
    return altitude_m.clamped(x - 1, y) == z && altitude_m.clamped(x + 1, y) == z &&
           altitude_m.clamped(x, y - 1) == z && altitude_m.clamped(x, y + 1) == z;
  };
  Grid<std::uint8_t> level(altitude_m.width(), altitude_m.height());
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < altitude_m.width(); ++x) {
      for (int dy = -1; dy <= 1 && level(x, y) == 0; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          if (altitude_m.clamped(x + dx, y + dy) == altitude_m(x, y) && amid_equals(x + dx, y + dy))
            level(x, y) = 1;
    }
  });
  return level;
}

// Removes these stripes from `altitude_m`; their lines run along rows.
void remove_stripes(Grid<float>& altitude_m, const Detail& detail, const Stripes& stripes,
                    const DestripeParameters& parameters) {
  const Grid<std::uint8_t> level = find_level(altitude_m);
  StripeLines lines;
  lines.follows = stripes.follows;
  lines.tilt = stripes.tilt;
  lines.longest_period_cells = parameters.longest_period_cells;
  lines.length_cells = parameters.length_cells;
  const Grid<float> stripe = fit_stripes(altitude_m, detail.height_m, detail.smooth_m, lines);
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < altitude_m.width(); ++x) {
      if (level(x, y) == 0)
        altitude_m(x, y) -= stripe(x, y) * followed(detail.smooth_m, stripes.follows, x, y);
    }
  });
}

std::string describe(const Stripes& stripes) {
  const char* axis = stripes.columns ? "columns" : "rows";
  const char* kind = stripes.follows == Follows::offset        ? "offset"
                     : stripes.follows == Follows::slope_along ? "displaced along"
                                                               : "displaced across";
  return fmt::format(
      "stripes removed: {} {}, tilt {:+.3f}, {:.1f} times as coherent as the terrain", axis, kind,
      stripes.tilt, stripes.contrast);
}

void check(const DestripeParameters& p) {
  const auto fail = [](const char* key, double value, const char* allowed) {
    throw Error(ErrorKind::usage, key, fmt::format("{}", value), allowed);
  };
  if (!(p.longest_period_cells >= 3.F && p.longest_period_cells <= 64.F))
    fail("longest_period_cells", p.longest_period_cells, "3…64");
  if (!(p.length_cells >= 16.F && p.length_cells <= 2000.F))
    fail("length_cells", p.length_cells, "16…2000");
  if (!(p.max_tilt >= 0.F && p.max_tilt <= 0.5F)) fail("max_tilt", p.max_tilt, "0…0.5");
  if (!(p.min_contrast >= 1.2F && p.min_contrast <= 100.F))
    fail("min_contrast", p.min_contrast, "1.2…100");
  if (p.max_passes < 0 || p.max_passes > 20) fail("max_passes", p.max_passes, "0…20");
}

}  // namespace

Grid<float> destripe(const Grid<float>& altitude_m, const DestripeParameters& parameters,
                     Progress& progress) {
  check(parameters);
  progress.begin("remove stripes", parameters.max_passes);
  Grid<float> out = altitude_m;
  if (std::min(altitude_m.width(), altitude_m.height()) < smallest_side) return out;
  int removed = 0;
  for (; removed < parameters.max_passes; ++removed) {
    Grid<float> turned = transposed(out);
    const Detail in_rows = find_detail(out, parameters);
    const Detail in_columns = find_detail(turned, parameters);
    const Stripes rows = find_stripes(in_rows, false, parameters);
    const Stripes columns = find_stripes(in_columns, true, parameters);
    Stripes worst = rows.contrast >= columns.contrast ? rows : columns;
    if (worst.contrast < parameters.min_contrast) break;
    worst.tilt = refine_tilt(worst.columns ? in_columns : in_rows, worst);
    if (worst.columns) {
      remove_stripes(turned, in_columns, worst, parameters);
      out = transposed(turned);
    } else {
      remove_stripes(out, in_rows, worst, parameters);
    }
    progress.note(describe(worst));
    progress.advance(1.0);
  }
  if (removed == 0) progress.note("no stripes found");
  return out;
}

}  // namespace belvedere
