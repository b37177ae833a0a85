#include "terrain/climate/sun_year.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/angle.h"
#include "base/error.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

constexpr int days_of_year = 365;
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
}

}  // namespace

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
    const SunOfDay day = sun_of_day((parameters.first_day - 1 + i) % days_of_year + 1);
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
           .exposure_mj = solar_constant_w_m2 * day.nearness * seconds * 1e-6,
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

}  // namespace belvedere
