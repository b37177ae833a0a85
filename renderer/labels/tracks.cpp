#include "renderer/labels/tracks.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "base/filter.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

constexpr double min_gap_px = 3.0;
constexpr double pixel_step = 0.6;  // positions nearer to each other are one

struct Sample {
  glm::dvec2 position{0.0};
  double from_start_m = 0.0;
  double altitude_m = NAN;  // NAN outside the terrain
  std::optional<ImagePosition> drawn;
};

bool in_picture(const Sample& sample) { return sample.drawn && sample.drawn->in_picture; }

std::vector<Sample> sample_line(const LocatedGround& ground, const MapLine& line) {
  const double metres = ground.cell_m / ground.transform.cell_x;
  std::vector<Sample> samples;
  double from_start_m = 0.0;
  for (std::size_t i = 0; i + 1 < line.positions.size(); ++i) {
    const double length_m = glm::length(line.positions[i + 1] - line.positions[i]) * metres;
    const int steps = std::max(1, static_cast<int>(std::ceil(2.0 * length_m / ground.cell_m)));
    for (int k = 0; k < steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      samples.push_back({.position = glm::mix(line.positions[i], line.positions[i + 1], t),
                         .from_start_m = from_start_m + t * length_m,
                         .drawn = {}});
    }
    from_start_m += length_m;
  }
  samples.push_back({.position = line.positions.back(), .from_start_m = from_start_m, .drawn = {}});
  for (Sample& sample : samples) {
    if (!ground.map.on_surface(sample.position)) continue;
    const glm::dvec2 cell = ground.transform.to_cell(sample.position.x, sample.position.y);
    sample.altitude_m = static_cast<double>(sample_bilinear(ground.altitude_m, cell.x, cell.y));
    sample.drawn = ground.map.to_image(sample.position);
  }
  return samples;
}

double climb_of(const std::vector<glm::dvec2>& profile) {
  double climb_m = 0.0;
  double low_m = profile.empty() ? 0.0 : profile.front().y;
  double high_m = low_m;
  for (const glm::dvec2 p : profile) {
    high_m = std::max(high_m, p.y);
    if (high_m - p.y < climb_step_m && p.y >= low_m) continue;
    // Descending again, or lower than ever since the last ascent: the climb counts if it was
    // enough.
    if (high_m - low_m >= climb_step_m) climb_m += high_m - low_m;
    low_m = high_m = p.y;
  }
  return high_m - low_m >= climb_step_m ? climb_m + high_m - low_m : climb_m;
}

double length_px(const TrackRun& run) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < run.pixels.size(); ++i)
    length += glm::length(run.pixels[i + 1] - run.pixels[i]);
  return length;
}

// Consecutive runs of one line: each begins where the previous one ends.
void join_short_gaps(std::vector<TrackRun>& runs) {
  for (TrackRun& run : runs)
    if (!run.seen && length_px(run) < min_gap_px) run.seen = true;
  std::vector<TrackRun> joined;
  for (TrackRun& run : runs) {
    if (!joined.empty() && joined.back().seen == run.seen)
      joined.back().pixels.insert(joined.back().pixels.end(), run.pixels.begin() + 1,
                                  run.pixels.end());
    else
      joined.push_back(std::move(run));
  }
  runs = std::move(joined);
}

// Removes positions within a pixel of each other; both ends stay.
void thin(std::vector<glm::dvec2>& pixels) {
  std::vector<glm::dvec2> kept = {pixels.front()};
  for (std::size_t i = 1; i + 1 < pixels.size(); ++i)
    if (glm::length(pixels[i] - kept.back()) >= pixel_step) kept.push_back(pixels[i]);
  kept.push_back(pixels.back());
  pixels = std::move(kept);
}

std::vector<TrackRun> runs_of(const std::vector<Sample>& samples) {
  std::vector<TrackRun> all;
  std::vector<TrackRun> stretch;
  const auto end_stretch = [&] {
    join_short_gaps(stretch);
    for (TrackRun& run : stretch) {
      thin(run.pixels);
      all.push_back(std::move(run));
    }
    stretch.clear();
  };
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const Sample& a = samples[i];
    const Sample& b = samples[i + 1];
    if (!in_picture(a) || !in_picture(b)) {
      end_stretch();
      continue;
    }
    const bool seen = a.drawn->visible && b.drawn->visible;
    if (stretch.empty() || stretch.back().seen != seen) stretch.push_back({seen, {a.drawn->pixel}});
    stretch.back().pixels.push_back(b.drawn->pixel);
  }
  end_stretch();
  return all;
}

Track find_track(const LocatedGround& ground, const MapLine& line) {
  const std::vector<Sample> samples = sample_line(ground, line);
  Track track;
  track.name = line.name;
  track.where = line.where;
  track.length_m = samples.back().from_start_m;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!std::isnan(samples[i].altitude_m))
      track.profile.emplace_back(samples[i].from_start_m, samples[i].altitude_m);
    if (i > 0 && in_picture(samples[i]) && samples[i].drawn->visible)
      track.seen_m += samples[i].from_start_m - samples[i - 1].from_start_m;
  }
  track.climb_m = climb_of(track.profile);
  track.runs = runs_of(samples);
  return track;
}

// 1, 2 or 5 times a power of ten: about `count` of them over a span.
double round_step(double span, int count) {
  double step = 0.1;
  while (span / step > count)
    for (const double factor : {2.0, 2.5, 2.0}) {
      step *= factor;
      if (span / step <= count) break;
    }
  return step;
}

}  // namespace

std::vector<Track> find_tracks(const LocatedGround& ground, const std::vector<MapLine>& lines) {
  std::vector<Track> tracks(lines.size());
  parallel_ranges<std::size_t>(lines.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) tracks[i] = find_track(ground, lines[i]);
  });
  return tracks;
}

Drawing profile_drawing(const Track& track, const std::string& colour, double px_per_mm) {
  constexpr glm::dvec2 sheet_mm{180.0, 50.0};
  constexpr double left = 14.0;
  constexpr double right = 4.0;
  constexpr double top = 8.0;
  constexpr double bottom = 9.0;
  constexpr const char* ink = "#303030";
  Drawing drawing{.size_px = px_per_mm * sheet_mm, .shapes = {}};
  if (track.profile.size() < 2) return drawing;
  const auto at = [&](double x_mm, double y_mm) { return px_per_mm * glm::dvec2(x_mm, y_mm); };
  const auto say = [&](const std::string& words, glm::dvec2 where, double anchor,
                       double size_mm = 2.6) {
    drawing.shapes.push_back(
        DrawnText{.text = words,
                  .type = {.family = "DejaVu Sans, sans-serif", .size_px = size_mm * px_per_mm},
                  .at = where,
                  .anchor = anchor,
                  .colour = ink});
  };
  const auto [lowest, highest] =
      std::minmax_element(track.profile.begin(), track.profile.end(),
                          [](glm::dvec2 a, glm::dvec2 b) { return a.y < b.y; });
  const double step_m = round_step(std::max(50.0, highest->y - lowest->y), 6);
  const double from_m = std::floor(lowest->y / step_m) * step_m;
  const double to_m = std::max(from_m + step_m, std::ceil(highest->y / step_m) * step_m);
  const auto x = [&](double distance_m) {
    return left + (sheet_mm.x - left - right) * distance_m / std::max(1.0, track.length_m);
  };
  const auto y = [&](double altitude_m) {
    return sheet_mm.y - bottom -
           (sheet_mm.y - top - bottom) * (altitude_m - from_m) / (to_m - from_m);
  };
  say(fmt::format("{}{:.1f} km, {:.0f} m up", track.name.empty() ? "" : track.name + ": ",
                  track.length_m / 1000.0, track.climb_m),
      at(left, 5.0), 0.0, 3.2);
  for (double z = from_m; z <= to_m + .5; z += step_m) {
    drawing.shapes.push_back(DrawnPath{.points = {at(left, y(z)), at(sheet_mm.x - right, y(z))},
                                       .fill = {},
                                       .stroke = "#c8c8c8",
                                       .width_px = .15 * px_per_mm});
    say(fmt::format("{:.0f}", z), at(left - 1.5, y(z) + .9), 1.0);
  }
  const double step_km = round_step(track.length_m / 1000.0, 12);
  for (double km = 0.0; km <= track.length_m / 1000.0; km += step_km)
    say(fmt::format("{:g}", km), at(x(1000.0 * km), sheet_mm.y - 5.0), .5);
  say("km", at(sheet_mm.x - right, sheet_mm.y - 1.5), 1.0);
  std::vector<glm::dvec2> line;
  double last = -1.0;
  for (const glm::dvec2 p : track.profile) {
    if (x(p.x) - last < .15 && !line.empty()) continue;
    last = x(p.x);
    line.push_back(at(last, y(p.y)));
  }
  std::vector<glm::dvec2> area = line;
  area.push_back(at(last, y(from_m)));
  area.push_back(at(x(track.profile.front().x), y(from_m)));
  drawing.shapes.push_back(DrawnPath{
      .points = std::move(area), .closed = true, .fill = colour, .stroke = {}, .opacity = .18});
  drawing.shapes.push_back(DrawnPath{
      .points = std::move(line), .fill = {}, .stroke = colour, .width_px = .45 * px_per_mm});
  return drawing;
}

}  // namespace belvedere
