#include "renderer/ground/laid_rivers.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "base/cache/cache.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/pixel_rect.h"
#include "renderer/ground/cached_products.h"
#include "renderer/ground/packed_rows.h"

namespace belvedere {
namespace {

// Of each river its group and number of places; east, north and half a width of each place.
PackedRows pack(const Courses& courses) {
  std::vector<std::int32_t> counts;
  std::vector<double> numbers;
  for (const Course& course : courses.lines) {
    counts.insert(counts.end(), {course.group, static_cast<std::int32_t>(course.places.size())});
    for (std::size_t i = 0; i < course.places.size(); ++i)
      numbers.insert(numbers.end(), {course.places[i].x, course.places[i].y, static_cast<double>(course.half_width_m[i])});
  }
  return {row_of(counts), row_of(numbers)};
}

constexpr float most_widened = 3.F;
// Of least_px: guessed rivers that stay below the first, at their widest, are not drawn, from the second on they are.
constexpr float faded_below = 0.4F;
constexpr float full_from = 0.8F;
// Guessed rivers of half this width, m, are drawn with least_px; larger ones by the root of how much they are, so that one that has taken
// in others is seen to.
constexpr double least_of_half_m = 12.0;
constexpr double most_grown = 2.2;

std::vector<CoverCourse> unpack(const PackedRows& packed, const MapRivers& rivers) {
  std::vector<CoverCourse> courses;
  std::size_t n = 0;
  for (std::size_t c = 0; c + 2 <= packed.counts.size(); c += 2) {
    const auto group = static_cast<std::size_t>(packed.counts[c]);
    CoverCourse course = rivers.looks[group];
    for (std::int32_t i = 0; i < packed.counts[c + 1]; ++i) {
      course.places.emplace_back(packed.numbers[n], packed.numbers[n + 1]);
      course.half_width_m.push_back(static_cast<float>(packed.numbers[n + 2]));
      n += 3;
    }
    courses.push_back(std::move(course));
  }
  return courses;
}

// What rivers see of the ground: where water runs, and how high it lies.
void add_ground(CacheKeyText& key, const Dem& dem) {
  const auto& [altitude_m, filled, transform, crs, entries, halved] = dem;
  const auto& [origin_x, origin_y, cell_x, cell_y] = transform;
  key.add("altitude_m", altitude_m).add("origin_x", origin_x).add("origin_y", origin_y).add("cell_x", cell_x).add("cell_y", cell_y);
  for (const auto& [x, y, km2] : entries) key.add("entry_x", x).add("entry_y", y).add("km2", km2);
}

CacheKey courses_key(const LoadedScene& loaded, const MapRivers& rivers, const Dem& dem) {
  CacheKeyText key;
  std::vector<double> numbers;
  for (const DrawnCourse& river : rivers.lines) {
    const auto& [places, width_m, least_width_m, snap_m, group] = river;
    numbers.insert(numbers.end(), {width_m, least_width_m, snap_m, static_cast<double>(group), static_cast<double>(places.size())});
    for (const glm::dvec2 place : places) numbers.insert(numbers.end(), {place.x, place.y});
  }
  key.add("rivers", row_of(numbers));
  add_ground(key, dem);
  return make_cache_key(CachedProduct::river_courses, key, subject_of(loaded));
}

}  // namespace

std::vector<CoverCourse> lay_rivers(const MapRivers& rivers, const LoadedScene& loaded, const Dem& dem, Progress& progress,
                                    const Cache& cache, Catchments* catchments) {
  if (rivers.lines.empty()) return {};
  const PackedRows packed = cached<PackedRows>(
      cache, [&] { return courses_key(loaded, rivers, dem); }, progress,
      [&](Progress& watcher) {
        watcher.begin("laying rivers into their valleys", 0.0);
        Catchments own(dem);
        const Courses laid = lay_courses(rivers.lines, dem, (catchments != nullptr ? *catchments : own).km2());
        if (laid.lines.empty()) return PackedRows{};
        watcher.note(fmt::format(
            "rivers of the map: {} in {} pieces, moved to the bottoms of their valleys by {:.0f} m in the mean, {:.0f} m at most",
            laid.lines.size(), laid.lines.size() + laid.joined, laid.mean_moved_m, laid.most_moved_m));
        return pack(laid);
      });
  return unpack(packed, rivers);
}

CoverCourse widen_for_view(CoverCourse course, const RiverLook& look, const Dem& dem, const SeenFrom& from) {
  constexpr double step_m = 30.0;
  constexpr int passes = 40;  // ground turns from one cell to the next; widths do not
  const auto seen = [&](glm::dvec2 place) {
    const glm::dvec2 cell = dem.transform.to_cell(place.x, place.y);
    return from.camera.project(from.deformation.point({place, sample_bilinear(dem.altitude_m, cell.x, cell.y)}));
  };
  std::vector<float> wanted = course.half_width_m;
  const std::size_t last = course.places.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const glm::dvec2 along = course.places[std::min(i + 1, last)] - course.places[i - std::min<std::size_t>(i, 1)];
    const double length = glm::length(along);
    if (!(length > 0.0)) continue;
    const glm::dvec2 ahead = along * (step_m / length);
    const auto here = seen(course.places[i]);
    const auto on = seen(course.places[i] + ahead);
    const auto beside = seen(course.places[i] + glm::dvec2(-ahead.y, ahead.x));
    if (!here || !on || !beside) continue;
    const glm::dvec2 a = (*on - *here) / step_m;
    const glm::dvec2 b = (*beside - *here) / step_m;
    // A strip 1 m wide is so many pixels thick.
    const double thick = std::abs(a.x * b.y - a.y * b.x) / std::max(glm::length(a), 1e-12);
    const float half = course.half_width_m[i];
    const auto needed = static_cast<float>(0.5 * look.least_px / std::max(thick, 1e-9));
    const double grown = look.fades ? std::clamp(std::sqrt(static_cast<double>(half) / least_of_half_m), 1.0, most_grown) : 1.0;
    wanted[i] = std::clamp(needed * static_cast<float>(grown), half, most_widened * half);
    if (look.fades) wanted[i] *= smoothstep(faded_below, full_from, wanted[i] / std::max(needed, 1e-6F));
  }
  for (int pass = 0; pass < passes && wanted.size() > 2; ++pass) {
    std::vector<float> next = wanted;
    for (std::size_t i = 1; i < last; ++i) next[i] = 0.5F * wanted[i] + 0.25F * (wanted[i - 1] + wanted[i + 1]);
    wanted.swap(next);
  }
  course.half_width_m = std::move(wanted);
  return course;
}

}  // namespace belvedere
