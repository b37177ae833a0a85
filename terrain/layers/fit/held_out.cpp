#include "terrain/layers/fit/held_out.h"

#include <algorithm>
#include <cstddef>

#include "base/error.h"
#include "terrain/cover/layer_inputs.h"

namespace belvedere {
namespace {

constexpr int bands = 32;

template <class PartOf>
HoldOut divide(std::string name, int width, int height, const PartOf& part_of) {
  HoldOut out{std::move(name), 2, Grid<std::uint8_t>(width, height)};
  for (int y = 0; y != height; ++y)
    for (int x = 0; x != width; ++x) out.part(x, y) = part_of(x, y) ? 1 : 0;
  return out;
}

Grid<std::uint8_t> all_but(const HoldOut& hold_out, int part) {
  Grid<std::uint8_t> learn(hold_out.part.width(), hold_out.part.height());
  for (std::size_t i = 0; i != learn.size(); ++i) learn[i] = hold_out.part[i] != part ? 1 : 0;
  return learn;
}

// Copies the cells of a part from its prediction.
void take(GroundPrediction& all, const GroundPrediction& one, const HoldOut& hold_out, int part) {
  if (all.classes.values.empty()) all = one;
  const auto classes = static_cast<std::size_t>(one.classes.classes);
  for (std::size_t i = 0; i != hold_out.part.size(); ++i) {
    if (hold_out.part[i] != part) continue;
    std::copy_n(one.classes.values.begin() + static_cast<std::ptrdiff_t>(i * classes), classes,
                all.classes.values.begin() + static_cast<std::ptrdiff_t>(i * classes));
    if (one.even.empty()) continue;
    all.even[i] = one.even[i];
    all.expected[i] = one.expected[i];
  }
}

void judge(const KnownGround& ground, HeldOutResult& result) {
  result.measures = measure_classes(result.prediction.classes, ground.labels);
  std::vector<double> wanted;
  const std::vector<std::size_t> counts =
      count_labels(ground.labels, static_cast<int>(ground.classes.size()));
  std::size_t total = 0;
  for (const std::size_t c : counts) total += c;
  for (const std::size_t c : counts)
    wanted.push_back(static_cast<double>(c) / static_cast<double>(std::max<std::size_t>(total, 1)));
  result.matched = measure_classes(result.prediction.classes, ground.labels,
                                   matching_offsets(result.prediction.classes, wanted));
  if (!ground.picture || result.prediction.expected.empty()) return;
  Grid<std::uint8_t> use(ground.altitude_m.width(), ground.altitude_m.height());
  for (std::size_t i = 0; i != use.size(); ++i) use[i] = ground.labels[i] != no_class ? 1 : 0;
  for (const int block : {1, 16, 32, 64})
    result.differences.push_back(
        block_difference(ground.picture->rgb, result.prediction.expected, &use, block));
  const double whole = gradient_energy(ground.picture->rgb, &use);
  result.gradient_share =
      whole > 0.0 ? gradient_energy(result.prediction.expected, &use) / whole : 0.0;
}

}  // namespace

HoldOut chessboard(int width, int height, int square_cells) {
  return divide("tiles", width, height,
                [=](int x, int y) { return (x / square_cells + y / square_cells) % 2 != 0; });
}
HoldOut west_and_east(int width, int height) {
  return divide("west and east", width, height, [=](int x, int) { return x >= width / 2; });
}
HoldOut north_and_south(int width, int height) {
  return divide("north and south", width, height, [=](int, int y) { return y >= height / 2; });
}

HeldOutResult evaluate_held_out(const KnownGround& ground, const GroundFitParameters& parameters,
                                const HoldOut& hold_out) {
  HeldOutResult result;
  for (int part = 0; part != hold_out.parts; ++part) {
    const Grid<std::uint8_t> learn = all_but(hold_out, part);
    take(result.prediction, predict_ground(ground, fit_ground(ground, parameters, &learn)),
         hold_out, part);
  }
  judge(ground, result);
  return result;
}

HeldOutResult judge_bands(const KnownGround& ground, const HoldOut& hold_out) {
  HeldOutResult result;
  const auto classes = ground.classes.size();
  for (int part = 0; part != hold_out.parts; ++part) {
    const Grid<std::uint8_t> learn = all_but(hold_out, part);
    const std::vector<LayerInput> range = {
        layer_input_range("altitude", ground.altitude_m, &learn)};
    const std::vector<std::uint8_t> at = sample_indices({ground.altitude_m}, range)[0];
    std::vector<double> count(static_cast<std::size_t>(bands) * classes, 1e-3);
    for (std::size_t i = 0; i != at.size(); ++i)
      if (learn[i] != 0 && ground.labels[i] != no_class)
        count[static_cast<std::size_t>(at[i] * bands / 256) * classes + ground.labels[i]] += 1.0;
    GroundPrediction prediction;
    prediction.classes = {static_cast<int>(classes), std::vector<float>(at.size() * classes)};
    for (std::size_t i = 0; i != at.size(); ++i) {
      const double* of = &count[static_cast<std::size_t>(at[i] * bands / 256) * classes];
      double total = 0.0;
      for (std::size_t k = 0; k != classes; ++k) total += of[k];
      for (std::size_t k = 0; k != classes; ++k)
        prediction.classes.values[i * classes + k] = static_cast<float>(of[k] / total);
    }
    take(result.prediction, prediction, hold_out, part);
  }
  judge(ground, result);
  return result;
}

}  // namespace belvedere
