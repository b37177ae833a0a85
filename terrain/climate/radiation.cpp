#include "terrain/climate/radiation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "terrain/climate/horizon_sweep.h"

namespace belvedere {
namespace {

constexpr int days_of_year = 365;
constexpr std::array<int, 12> first_days = {1,   32,  60,  91,  121, 152,
                                            182, 213, 244, 274, 305, 335};  // of the months
constexpr double solar_constant_w_m2 = 1367.0;
constexpr double scale_height_m = 8434.5;

void require(bool good, const char* where, double found, const char* allowed) {
  if (!good) throw Error(ErrorKind::usage, where, fmt::format("{}", found), allowed);
}

void check(double latitude_deg, const SunYearParameters& p) {
  require(std::abs(latitude_deg) <= 90.0, "latitude", latitude_deg, "-90 … 90 degrees");
  require(p.transmissivity >= 0.1 && p.transmissivity <= 1.0, "transmissivity", p.transmissivity,
          "0.1 … 1");
  require(p.first_day >= 1 && p.first_day <= days_of_year, "first_day", p.first_day, "1 … 365");
  require(p.last_day >= 1 && p.last_day <= days_of_year, "last_day", p.last_day, "1 … 365");
  require(p.step_min >= 0.5 && p.step_min <= 10.0, "step_min", p.step_min, "0.5 … 10 minutes");
  for (const float share : p.sunshine)
    require(share >= 0.F && share <= 1.F, "sunshine", static_cast<double>(share), "0 … 1");
}

}  // namespace

MonthShares shares_of_months(const std::vector<float>& given, const std::string& where) {
  MonthShares shares = always_sunny;
  if (given.size() == 1)
    shares.fill(given.front());
  else if (given.size() == shares.size())
    std::copy(given.begin(), given.end(), shares.begin());
  else if (!given.empty())
    throw Error(ErrorKind::usage, where, fmt::format("{} values", given.size()),
                "one share, or twelve: January … December");
  for (const float share : shares)
    if (!(share >= 0.F && share <= 1.F))
      throw Error(ErrorKind::usage, where, fmt::format("{}", share), "0 … 1");
  return shares;
}

SunOfDay sun_of_day(int day) {
  const double angle = 2.0 * std::numbers::pi * (day - 1) / days_of_year;
  const exact::Turn one = exact::turn(angle);
  const exact::Turn two = exact::turn(2.0 * angle);
  const exact::Turn three = exact::turn(3.0 * angle);
  return {.declination_rad = 0.006918 - 0.399912 * one.cosine + 0.070257 * one.sine -
                             0.006758 * two.cosine + 0.000907 * two.sine - 0.002697 * three.cosine +
                             0.00148 * three.sine,
          .nearness = 1.000110 + 0.034221 * one.cosine + 0.001280 * one.sine +
                      0.000719 * two.cosine + 0.000077 * two.sine};
}

double clear_share(double transmissivity, double air_mass, double altitude_m) {
  return exact::exp(exact::log(transmissivity) * air_mass *
                    exact::exp(-altitude_m / scale_height_m));
}

std::vector<SunMoment> sun_moments(double latitude_deg, const SunYearParameters& parameters) {
  check(latitude_deg, parameters);
  const exact::Turn latitude = exact::turn(to_radians(latitude_deg));
  const int steps = static_cast<int>(std::lround(24.0 * 60.0 / parameters.step_min));
  const double seconds = 24.0 * 3600.0 / steps;
  std::vector<exact::Turn> hours;
  for (int i = 0; i < steps; ++i)
    hours.push_back(exact::turn(2.0 * std::numbers::pi * ((i + 0.5) / steps - 0.5)));
  const int count = (parameters.last_day - parameters.first_day + days_of_year) % days_of_year + 1;
  std::vector<SunMoment> moments;
  for (int i = 0; i < count; ++i) {
    const int number = (parameters.first_day - 1 + i) % days_of_year + 1;
    const SunOfDay day = sun_of_day(number);
    const auto month = static_cast<std::size_t>(
        std::upper_bound(first_days.begin(), first_days.end(), number) - first_days.begin() - 1);
    const auto sunshine = static_cast<double>(parameters.sunshine[month]);
    const exact::Turn declination = exact::turn(day.declination_rad);
    for (const exact::Turn& hour : hours) {
      const double sine =
          latitude.sine * declination.sine + latitude.cosine * declination.cosine * hour.cosine;
      if (sine <= 0.0) continue;
      const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
      double azimuth = exact::atan2(
          -declination.cosine * hour.sine,
          latitude.cosine * declination.sine - latitude.sine * declination.cosine * hour.cosine);
      if (azimuth < 0.0) azimuth += 2.0 * std::numbers::pi;
      const double elevation_deg = to_degrees(exact::atan2(sine, cosine));
      moments.push_back(
          {.azimuth_rad = azimuth,
           .sine = sine,
           .cosine = cosine,
           .exposure_mj = sunshine * (solar_constant_w_m2 * day.nearness * seconds * 1e-6),
           .air_mass = 1.0 / (sine + 0.50572 * exact::pow(elevation_deg + 6.07995, -1.6364))});
    }
  }
  return moments;
}

SunTable::SunTable(double south_deg, double north_deg, double lowest_m, double highest_m,
                   double grid_north_deg, int sectors, const SunYearParameters& parameters)
    : south_deg_(south_deg),
      lowest_m_(lowest_m),
      altitude_step_m_(std::max(1.0, highest_m - lowest_m) / (altitudes - 1)) {
  // Sums are nearly linear over a degree of latitude: (1°)² / 8 in radians is 4e-5.
  constexpr double min_span_deg = 0.01;
  const double span = north_deg - south_deg;
  latitudes_ = span < min_span_deg ? 1 : 1 + std::max(1, static_cast<int>(std::ceil(span)));
  if (latitudes_ == 1) south_deg_ = 0.5 * (south_deg + north_deg);
  latitude_step_deg_ = latitudes_ == 1 ? 1.0 : span / (latitudes_ - 1);
  sums_.assign(stride() * static_cast<std::size_t>(sectors), 0.0F);
  constexpr std::size_t bins = steps + 1;
  std::array<double, altitudes> thickness{};
  for (int a = 0; a < altitudes; ++a)
    thickness[static_cast<std::size_t>(a)] =
        exact::exp(-(lowest_m_ + a * altitude_step_m_) / scale_height_m);
  const double log_clear = exact::log(parameters.transmissivity);
  parallel_rows(latitudes_, [&](int l) {
    // Sums in double: a year has 130 000 positions of the sun.
    std::vector<double> sums(static_cast<std::size_t>(sectors) * bins * altitudes * 3, 0.0);
    for (const SunMoment& sun : sun_moments(south_deg_ + l * latitude_step_deg_, parameters)) {
      const auto sector = static_cast<std::size_t>(
          std::floor(sun.azimuth_rad * sectors / (2.0 * std::numbers::pi) + 0.5));
      const auto all = static_cast<std::size_t>(sectors);
      // The parabola through the results of three sectors (Lagrange's weights) at the sun's
      // position between them, -1/2 … 1/2.
      const double off =
          sun.azimuth_rad * sectors / (2.0 * std::numbers::pi) - static_cast<double>(sector);
      const std::array<std::pair<std::size_t, double>, 3> shares = {
          {{sector % all, 1.0 - off * off},
           {(sector + 1) % all, 0.5 * off * (off + 1.0)},
           {(sector + all - 1) % all, 0.5 * off * (off - 1.0)}}};
      const exact::Turn azimuth = exact::turn(sun.azimuth_rad - to_radians(grid_north_deg));
      const double tangent = sun.cosine > 0.0 ? sun.sine / sun.cosine : 1e9;
      // The sun is above a horizon in its own step; look-ups are also rounded to the nearest step.
      const std::size_t step = tangent < max_tangent ? step_of(static_cast<float>(tangent)) : steps;
      for (std::size_t a = 0; a < altitudes; ++a) {
        const double energy = sun.exposure_mj * exact::exp(log_clear * sun.air_mass * thickness[a]);
        for (const auto& [whose, share] : shares) {
          const double weight = energy * share;
          double* at = sums.data() + ((whose * bins + step) * altitudes + a) * 3;
          at[0] += weight * sun.sine;
          at[1] += weight * sun.cosine * azimuth.sine;
          at[2] += weight * sun.cosine * azimuth.cosine;
        }
      }
    }
    for (std::size_t s = 0; s < static_cast<std::size_t>(sectors); ++s) {
      float* out = sums_.data() + s * stride() + static_cast<std::size_t>(l) * bins * altitudes * 4;
      for (std::size_t a = 0; a < altitudes; ++a)
        for (std::size_t part = 0; part < 3; ++part) {
          double above = 0.0;
          for (std::size_t step = bins; step-- > 0;) {
            above += sums[((s * bins + step) * altitudes + a) * 3 + part];
            out[(step * altitudes + a) * 4 + part] = static_cast<float>(above);
          }
        }
    }
  });
}

bool SunTable::lit(int sector) const {
  const float* all = sums(sector);
  for (int l = 0; l < latitudes_; ++l)
    for (std::size_t a = 0; a < altitudes; ++a)
      if (all[(static_cast<std::size_t>(l) * (steps + 1) * altitudes + a) * 4] != 0.0F) return true;
  return false;
}

namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

using Four = float __attribute__((vector_size(16)));

Four load(const float* at) {
  Four four;
  __builtin_memcpy(&four, at, sizeof four);
  return four;
}

struct Gradient {
  float right = 0.0F;  // rise per metre, on the map
  float top = 0.0F;
};

// Central differences; one-sided at borders and voids.
class Gradients {
 public:
  Gradients(const Grid<float>& altitude_m, glm::dvec2 cell_m)
      : altitude_m_(altitude_m),
        row_(static_cast<std::ptrdiff_t>(altitude_m.width())),
        inner_width_(static_cast<unsigned>(std::max(0, altitude_m.width() - 2))),
        inner_height_(static_cast<unsigned>(std::max(0, altitude_m.height() - 2))),
        per_two_right_(static_cast<float>(0.5 / cell_m.x)),
        per_two_top_(static_cast<float>(0.5 / cell_m.y)) {}

  // The gradient at a cell that is not void.
  [[gnu::always_inline]] Gradient at(int x, int y) const {
    if (static_cast<unsigned>(x - 1) < inner_width_ &&
        static_cast<unsigned>(y - 1) < inner_height_) {
      const float* here = altitude_m_.data() + altitude_m_.index(x, y);
      const Gradient inside{(here[1] - here[-1]) * per_two_right_,
                            (here[-row_] - here[row_]) * per_two_top_};
      if (!std::isnan(inside.right + inside.top)) return inside;
    }
    return at_border(x, y);
  }

 private:
  [[gnu::noinline]] Gradient at_border(int x, int y) const {
    const float here = altitude_m_(x, y);
    const auto known = [&](int column, int row) {
      const float value = altitude_m_.clamped(column, row);
      return std::isnan(value) ? here : value;
    };
    // Twice the difference over one cell if the other neighbour is missing.
    const auto missing = [&](int column, int row) {
      return !altitude_m_.contains(column, row) || std::isnan(altitude_m_(column, row));
    };
    const float across = missing(x - 1, y) || missing(x + 1, y) ? 2.0F : 1.0F;
    const float along = missing(x, y - 1) || missing(x, y + 1) ? 2.0F : 1.0F;
    return {(known(x + 1, y) - known(x - 1, y)) * per_two_right_ * across,
            (known(x, y - 1) - known(x, y + 1)) * per_two_top_ * along};
  }

  const Grid<float>& altitude_m_;
  std::ptrdiff_t row_;
  unsigned inner_width_, inner_height_;
  float per_two_right_;
  float per_two_top_;
};

// A value that is linear over the map, in float for the inner loop.
struct Slope {
  float first, per_column, per_row;
  float at(int x, int y) const {
    return first + static_cast<float>(x) * per_column + static_cast<float>(y) * per_row;
  }
};
Slope slope_of(const MapPlane& plane, double subtract, double factor) {
  return {static_cast<float>((plane.at_first - subtract) * factor),
          static_cast<float>(plane.per_column * factor),
          static_cast<float>(plane.per_row * factor)};
}

std::pair<double, double> range_of_corners(const MapPlane& plane, int width, int height) {
  const std::array<double, 4> corner = {plane.at(0, 0), plane.at(width - 1, 0),
                                        plane.at(0, height - 1), plane.at(width - 1, height - 1)};
  return {*std::min_element(corner.begin(), corner.end()),
          *std::max_element(corner.begin(), corner.end())};
}

std::pair<float, float> range_of_altitudes(const Grid<float>& altitude_m) {
  std::pair<float, float> range{std::numeric_limits<float>::max(),
                                std::numeric_limits<float>::lowest()};
  for (const float z : altitude_m)
    if (!std::isnan(z)) range = {std::min(range.first, z), std::max(range.second, z)};
  return range.first > range.second ? std::pair{0.0F, 1.0F} : range;
}

// Light of the clouds that would reach level open ground, MJ/m² by altitude and latitude, with the
// steps of `clear`; empty where the sun always shines.
Grid<float> light_of_clouds(const SunTable& clear, double south_deg, double north_deg,
                            double highest_m, SunYearParameters sun) {
  if (sun.sunshine == always_sunny) return {};
  for (float& share : sun.sunshine) share = 1.F - share;
  constexpr int sectors = 8;  // their sum is the same for any number
  const SunTable cloudy(south_deg, north_deg, clear.lowest_m(), highest_m, 0.0, sectors, sun);
  Grid<float> light(SunTable::altitudes, cloudy.latitudes(), 0.F);
  for (int sector = 0; sector < sectors; ++sector)
    for (int l = 0; l < light.height(); ++l)
      for (int a = 0; a < light.width(); ++a) {
        const std::size_t step =
            static_cast<std::size_t>(l) * (SunTable::steps + 1) + SunTable::step_of(0.F);
        light(a, l) +=
            overcast_share *
            cloudy.sums(sector)[(step * SunTable::altitudes + static_cast<std::size_t>(a)) * 4];
      }
  return light;
}

}  // namespace

Radiation potential_radiation(const Grid<float>& altitude_m, const MapPosition& position,
                              const RadiationParameters& parameters, Progress& progress) {
  const int width = altitude_m.width();
  const int height = altitude_m.height();
  const int sectors = parameters.azimuths;
  if (sectors < 8 || sectors > 360)
    throw Error(ErrorKind::usage, "azimuths", fmt::format("{}", sectors), "8 … 360");
  if (position.width != width || position.height != height)
    throw Error(ErrorKind::bug, "radiation",
                fmt::format("a map of {} × {} cells for a grid of {} × {}", position.width,
                            position.height, width, height));
  check_memory("radiation", 2.0 * sizeof(float) * static_cast<double>(altitude_m.size()));
  const auto range = range_of_altitudes(altitude_m);
  const float lowest = range.first;
  const float highest = range.second;
  const auto [south, north] = range_of_corners(position.latitude_deg, width, height);
  const double grid_north_deg = position.grid_north_deg.at(0.5 * (width - 1), 0.5 * (height - 1));
  const SunTable table(std::max(-90.0, south), std::min(90.0, north), static_cast<double>(lowest),
                       static_cast<double>(highest), grid_north_deg, sectors, parameters.sun);
  // Difference between true azimuths and azimuths of the map at its centre. It varies slightly over
  // the map; that affects the direction of the sun, not the light.
  const Slope rest_rad =
      slope_of(position.grid_north_deg, grid_north_deg, std::numbers::pi / 180.0);
  const Slope latitude =
      slope_of(position.latitude_deg, table.south_deg(), 1.0 / table.latitude_step_deg());
  const Gradients gradients(altitude_m, position.cell_m);
  const auto per_altitude = static_cast<float>(1.0 / table.altitude_step_m());
  constexpr std::size_t altitude_stride = 4;
  constexpr std::size_t step_stride = SunTable::altitudes * altitude_stride;
  constexpr std::size_t latitude_stride = (SunTable::steps + 1) * step_stride;
  constexpr auto top_altitude = static_cast<float>(SunTable::altitudes - 1);

  Radiation radiation{Grid<float>(width, height), Grid<float>(width, height)};
  const int latitudes = table.latitudes();
  progress.begin("radiation", sectors);
  for (int sector = 0; sector < sectors; ++sector) {
    const exact::Turn towards =
        exact::turn(2.0 * std::numbers::pi * sector / sectors - to_radians(grid_north_deg));
    const auto towards_right = static_cast<float>(towards.sine);
    const auto towards_top = static_cast<float>(towards.cosine);
    const bool lit = table.lit(sector);
    const float* const sums = table.sums(sector);
    sweep_horizon(altitude_m, plan_sweep(width, height, position.cell_m, towards),
                  [&](int x, int y, float horizon) {
                    const std::size_t i = altitude_m.index(x, y);
                    const float z = altitude_m[i];
                    if (std::isnan(z)) return;
                    const Gradient g = gradients.at(x, y);
                    // The slope itself is a horizon too: below it the sun is behind the ground.
                    const float from = std::max(
                        std::max(horizon, g.right * towards_right + g.top * towards_top), 0.0F);
                    radiation.sky_view[i] += 1.0F / (1.0F + from * from);
                    if (!lit || from > SunTable::max_tangent) return;
                    const float up = (z - lowest) * per_altitude;
                    const int bin = std::min(static_cast<int>(up), SunTable::altitudes - 2);
                    const float up_part = std::min(up, top_altitude) - static_cast<float>(bin);
                    const float* at = sums + SunTable::step_of(from) * step_stride +
                                      static_cast<std::size_t>(bin) * altitude_stride;
                    const auto look_up = [&](const float* low) {
                      return load(low) + (load(low + altitude_stride) - load(low)) * up_part;
                    };
                    Four sum;
                    if (latitudes == 1) {
                      sum = look_up(at);
                    } else {
                      const float north_part =
                          std::clamp(latitude.at(x, y), 0.0F, static_cast<float>(latitudes - 1));
                      const int l = std::min(static_cast<int>(north_part), latitudes - 2);
                      at += static_cast<std::size_t>(l) * latitude_stride;
                      const Four south_sum = look_up(at);
                      sum = south_sum + (look_up(at + latitude_stride) - south_sum) *
                                            (north_part - static_cast<float>(l));
                    }
                    const float rest = rest_rad.at(x, y);
                    radiation.direct_mj_m2[i] += sum[0] - (g.right + g.top * rest) * sum[1] -
                                                 (g.top - g.right * rest) * sum[2];
                  });
    progress.advance(1.0);
  }
  const Grid<float> clouds = light_of_clouds(table, std::max(-90.0, south), std::min(90.0, north),
                                             static_cast<double>(highest), parameters.sun);
  // Convert from level to inclined ground: a unit normal is (-right, -top, 1) / √(1 + right² +
  // top²).
  const auto share = 1.0F / static_cast<float>(sectors);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (std::isnan(altitude_m(x, y))) {
        radiation.direct_mj_m2(x, y) = radiation.sky_view(x, y) = nan_value;
        continue;
      }
      const Gradient g = gradients.at(x, y);
      float& direct = radiation.direct_mj_m2(x, y);
      direct = std::max(0.0F, direct) / std::sqrt(1.0F + g.right * g.right + g.top * g.top);
      radiation.sky_view(x, y) *= share;
      if (!clouds.empty())
        direct +=
            radiation.sky_view(x, y) *
            sample_bilinear(clouds, static_cast<double>((altitude_m(x, y) - lowest) * per_altitude),
                            static_cast<double>(latitude.at(x, y)));
    }
  });
  return radiation;
}

}  // namespace belvedere
