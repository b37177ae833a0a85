#include "texture/statistical/choose_seed.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.h"
#include "base/math_exact.h"
#include "texture/statistical/make_texture.h"
#include "texture/statistical/texture_figures.h"

namespace belvedere {
namespace {

constexpr int trial_px = 128;
constexpr float streak_lengths_px[] = {6.F, 12.F, 24.F};
constexpr float disc_radius_px = 4.F;

float lightness(const Rgb8& c) {
  return .299F * static_cast<float>(c[0]) + .587F * static_cast<float>(c[1]) +
         .114F * static_cast<float>(c[2]);
}

bool is_streaks(const SeedTrial& trial) { return trial.seed == TextureSeed::streaks; }

double handicapped(const SeedTrial& trial) {
  return trial.score() / (trial.polish || is_streaks(trial) ? 1.0 : unpolished_margin);
}

double min_shape(const std::vector<SeedTrial>& trials, bool of_streaks) {
  double min = std::numeric_limits<double>::infinity();
  for (const SeedTrial& trial : trials)
    if (is_streaks(trial) == of_streaks) min = std::min(min, trial.shape());
  return min;
}

}  // namespace

StrokeDirection find_stroke_direction(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states) {
  // The doubled angle of each gradient, so that opposite ones agree; strokes run perpendicular to
  // it.
  double cosine = 0.0;
  double sine = 0.0;
  double all = 0.0;
  for (int y = 1; y + 1 < crop.height(); ++y) {
    for (int x = 1; x + 1 < crop.width(); ++x) {
      if (!states.empty() && (states(x, y) & pixel_counts) == 0) continue;
      const double gx = static_cast<double>(lightness(crop(x + 1, y)) - lightness(crop(x - 1, y)));
      const double gy = static_cast<double>(lightness(crop(x, y + 1)) - lightness(crop(x, y - 1)));
      cosine += gx * gx - gy * gy;
      sine += 2.0 * gx * gy;
      all += gx * gx + gy * gy;
    }
  }
  if (all <= 0.0) return {0.F, 1.F};
  const double along = 90.0 + 0.5 * to_degrees(exact::atan2(sine, cosine));
  return {static_cast<float>(along >= 180.0 ? along - 180.0 : along),
          static_cast<float>(1.0 - std::sqrt(cosine * cosine + sine * sine) / all)};
}

std::vector<SeedTrial> choose_seed(CliqueModel& model, const Grid<Rgb8>& crop,
                                   const Grid<std::uint8_t>& states,
                                   const LearnParameters& parameters, Progress& progress) {
  const StrokeDirection strokes = find_stroke_direction(crop, states);
  model.direction_deg = strokes.deg;
  model.direction_spread = strokes.spread;
  std::vector<SeedTrial> trials = {{TextureSeed::white, 0.F, false},
                                   {TextureSeed::white, 0.F, true}};
  // The polish's moves to a neighbour's colour wear streaks away.
  for (const float px : streak_lengths_px) trials.push_back({TextureSeed::streaks, px, false});
  trials.push_back({TextureSeed::discs, disc_radius_px, false});
  progress.begin("choosing the initial noise", static_cast<double>(trials.size()));
  const auto take = [&](const SeedTrial& trial) {
    model.seed = trial.seed;
    model.seed_px = trial.px;
    model.polish = trial.polish;
  };
  for (SeedTrial& trial : trials) {
    take(trial);
    const TextureFigures figures = texture_figures(
        crop, states, make_texture(model, trial_px, trial_px, {}), model, parameters);
    trial.beyond = figures.beyond;
    trial.drawn = figures.drawn;
    trial.turned = figures.turned;
    progress.advance(1.0);
  }
  const bool streaks_win = min_shape(trials, true) < streaks_margin * min_shape(trials, false);
  std::stable_sort(trials.begin(), trials.end(), [&](const SeedTrial& a, const SeedTrial& b) {
    if (is_streaks(a) != is_streaks(b)) return is_streaks(a) == streaks_win;
    return handicapped(a) < handicapped(b);
  });
  take(trials.front());
  return trials;
}

}  // namespace belvedere
