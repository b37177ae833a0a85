#include "terrain/layers/fit/ground_fit.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <utility>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/cover/layer_inputs.h"
#include "terrain/layers/fit/clusters.h"
#include "terrain/layers/layer_coverage.h"

namespace belvedere {
namespace {

double level_cosine(const PictureSun& sun) { return exact::sin(to_radians(sun.elevation_deg)); }

// Weights colour more than lightness, which is still affected by shading.
ClusterPlace colour_place(const glm::dvec3& rgb) {
  constexpr double lightness_weight = 0.012;
  constexpr double darkest = 8.0;
  const LabColour lab = lab_of_srgb(rgb);
  const double l = std::max(lab.l, darkest);
  return {lab.a / l, lab.b / l, lightness_weight * lab.l};
}

FitCells cells_of(const std::vector<std::vector<std::uint8_t>>& inputs,
                  std::vector<std::uint8_t> labels, int classes) {
  const FitCells all{classes, inputs, std::move(labels)};
  return select_cells(all, draw_labelled(all.labels, all.size()));
}

ClassFunctions fit_functions(const FitCells& cells, const GroundFitParameters& parameters,
                             std::size_t max) {
  if (parameters.functions == FunctionSource::histogram)
    return histogram_functions(cells, {.smoothing = parameters.smoothing});
  if (parameters.model == LayerModel::product)
    return fit_product(cells, {.roughness = parameters.roughness.value_or(6e-4), .max = max});
  return fit_additive(cells,
                      {.roughness = parameters.roughness.value_or(2e-3), .steps = 120, .max = max});
}

// Divides each class by its colours on level ground: leaf labels of the training cells, and
// functions of the leaves within their class.
void fit_children(const KnownGround& ground, const GroundFitParameters& parameters,
                  const std::vector<std::vector<std::uint8_t>>& samples,
                  const std::vector<std::uint8_t>& labels, GroundFit& fit,
                  std::vector<std::uint8_t>& leaves) {
  constexpr std::size_t max_for_means = 6'000;
  constexpr std::size_t max_for_functions = 20'000;
  constexpr double small =
      0.05;  // share of the ground below which a class has half as many children
  const Grid<float> light = sunlight(ground.altitude_m, ground.cell_m, fit.sun);
  const Grid<glm::vec3> even =
      lit_evenly(ground.picture->rgb, light, level_cosine(fit.sun), labels, fit.light);
  const std::vector<std::size_t> counts =
      count_labels(labels, static_cast<int>(ground.classes.size()));
  std::size_t learned = 0;
  for (const std::size_t c : counts) learned += c;
  leaves.assign(labels.size(), no_class);
  for (std::size_t k = 0; k != ground.classes.size(); ++k) {
    std::vector<std::uint8_t> own(labels.size(), no_class);
    for (std::size_t i = 0; i != labels.size(); ++i)
      if (labels[i] == k) own[i] = 0;
    std::vector<ClusterPlace> positions;
    for (const std::uint32_t i : draw_labelled(own, max_for_means, 10 + k))
      positions.push_back(colour_place(even[i]));
    const bool is_small = static_cast<double>(counts[k]) < small * static_cast<double>(learned);
    const std::vector<ClusterPlace> means = cluster_means(
        positions, std::max(1, is_small ? (parameters.children + 1) / 2 : parameters.children),
        {.part = 10 + k});
    const auto first = static_cast<std::uint8_t>(fit.parent.size());
    const std::size_t count = std::max<std::size_t>(means.size(), 1);
    std::vector<glm::dvec3> sums(count, glm::dvec3(0.0));
    std::vector<std::size_t> cells(count, 0);
    for (std::size_t i = 0; i != own.size(); ++i) {
      if (own[i] == no_class) continue;
      own[i] = nearest_mean(colour_place(even[i]), means);
      leaves[i] = static_cast<std::uint8_t>(first + own[i]);
      sums[own[i]] += even[i];
      ++cells[own[i]];
    }
    for (std::size_t j = 0; j != count; ++j) {
      fit.parent.push_back(static_cast<int>(k));
      fit.colours.push_back(cells[j] > 0 ? sums[j] / static_cast<double>(cells[j])
                                         : glm::dvec3(128.0));
      fit.cells.push_back(cells[j]);
    }
    fit.children.emplace_back();
    if (count > 1)
      fit.children.back() =
          fit_functions(cells_of(samples, std::move(own), static_cast<int>(count)), parameters,
                        max_for_functions);
  }
}

std::uint32_t packed(const glm::dvec3& rgb) {
  const glm::uvec3 bytes(glm::clamp(rgb, 0.0, 255.0) + 0.5);
  return bytes.x << 16U | bytes.y << 8U | bytes.z;
}

// The layers file of the fit, and the leaf whose colour each layer shows: that of the bare ground,
// then of each layer (-1: it paints nothing).
struct LeafLayers {
  SurfaceLayers layers;
  std::vector<int> leaf_of;
};
LeafLayers leaf_layers(const KnownGround& ground, const GroundFit& fit, const std::string& name) {
  LeafLayers out;
  SurfaceLayers& layers = out.layers;
  layers.name = name;
  layers.model = fit.classes.model;
  layers.inputs = fit.ranges;
  const bool product = layers.model == LayerModel::product;
  const auto colour_of = [&](int leaf) {
    const glm::dvec3& own = fit.colours[static_cast<std::size_t>(leaf)];
    const int k = fit.parent[static_cast<std::size_t>(leaf)];
    const std::optional<glm::vec3>& shown = ground.classes[static_cast<std::size_t>(k)].shown;
    if (!shown) return packed(own);
    glm::dvec3 sum(0.0);
    double cells = 1e-9;
    for (std::size_t j = 0; j != fit.parent.size(); ++j) {
      if (fit.parent[j] != k) continue;
      sum += static_cast<double>(fit.cells[j]) * fit.colours[j];
      cells += static_cast<double>(fit.cells[j]);
    }
    const glm::dvec3 lighter = own - sum / cells;
    return packed(glm::dvec3(*shown) + (lighter.x + lighter.y + lighter.z) / 3.0);
  };
  for (const int k_int : fit.classes.order) {
    const auto k = static_cast<std::size_t>(k_int);
    const int first = static_cast<int>(std::find(fit.parent.begin(), fit.parent.end(), k_int) -
                                       fit.parent.begin());
    const std::vector<int>& order = fit.children[k].order;  // empty if the class has one colour
    SurfaceLayer layer;
    layer.name = ground.classes[k].name;
    layer.painted_as = ground.classes[k].painted_as;
    set_functions(layer, fit.classes, k);
    const int index = static_cast<int>(layers.layers.size());
    // In a product the first child covers its class entirely: the class's own colour.
    const int own = order.empty() ? first : first + order[0];
    layer.rgb = colour_of(own);
    layers.layers.push_back(layer);
    if (index == 0) out.leaf_of.push_back(own);
    out.leaf_of.push_back(product || order.empty() ? own : -1);
    for (std::size_t rank = product ? 1 : 0; rank < order.size(); ++rank) {
      SurfaceLayer child;
      child.name = fmt::format("{}, colour {}", layer.name, rank + 1);
      child.parent = index;
      child.rgb = colour_of(first + order[rank]);
      set_functions(child, fit.children[k], static_cast<std::size_t>(order[rank]));
      layers.layers.push_back(std::move(child));
      out.leaf_of.push_back(first + order[rank]);
    }
  }
  layers.ground_rgb = layers.layers[0].rgb;
  layers.ground_painted_as = layers.layers[0].painted_as;
  check_surface_layers(layers, name);
  return out;
}

// The visible share of each leaf where the file is applied to the ground.
ClassShares seen_leaves(const KnownGround& ground, const GroundFit& fit) {
  constexpr int rows_at_once = 16;
  const LeafLayers file = leaf_layers(ground, fit, "fit");
  const LayerProgram program = compile_layers(file.layers);
  const int width = ground.altitude_m.width();
  const std::size_t leaves = fit.parent.size();
  ClassShares shares{static_cast<int>(leaves),
                     std::vector<float>(ground.altitude_m.size() * leaves, 0.0F)};
  parallel_ranges(ground.altitude_m.height(), rows_at_once, [&](int y0, int y1) {
    const PixelRect cells{0, y0, width, y1};
    std::vector<Grid<float>> inputs;
    for (const Grid<float>& input : ground.inputs) inputs.push_back(part_of(input, cells));
    const std::vector<Grid<float>> seen =
        layer_shares(program, layer_coverage(program, inputs, {}, cells, 0));
    for (std::size_t of = 0; of != seen.size(); ++of) {
      if (file.leaf_of[of] < 0) continue;
      float* to = &shares.values[ground.altitude_m.index(0, y0) * leaves +
                                 static_cast<std::size_t>(file.leaf_of[of])];
      for (std::size_t i = 0; i != seen[of].size(); ++i) to[i * leaves] += seen[of][i];
    }
  });
  return shares;
}

// Scales b of each class so that it covers its own area on the training ground, including children:
// a child of coverage C also hides what is under its class, so classes with children would become
// too large. From the top down, since upper layers decide what is visible of lower ones. For sums
// this holds automatically at the maximum of the likelihood.
void match_painted_areas(const KnownGround& ground, const std::vector<std::uint8_t>& labels,
                         GroundFit& fit) {
  constexpr std::size_t max = 40'000;
  constexpr int halvings = 16;
  const std::vector<std::uint32_t> some = draw_labelled(labels, max, 4);
  const int count = static_cast<int>(some.size());
  std::vector<double> wanted(ground.classes.size(), 0.0);
  for (const std::uint32_t i : some) wanted[labels[i]] += 1.0;
  std::vector<Grid<float>> inputs(ground.inputs.size(), Grid<float>(count, 1));
  for (std::size_t a = 0; a != inputs.size(); ++a)
    for (std::size_t i = 0; i != some.size(); ++i) inputs[a][i] = ground.inputs[a][some[i]];
  std::fill(fit.classes.bias.begin(), fit.classes.bias.end(), 1.0);
  const LeafLayers file = leaf_layers(ground, fit, "fit");
  const std::vector<Grid<float>> products =
      layer_coverage(compile_layers(file.layers), inputs, {}, {0, 0, count, 1}, 0);
  std::vector<double> rest(some.size(), 1.0);
  // A class and its children are contiguous, from `layer` to `end`.
  for (std::size_t layer = products.size(), end = products.size(); layer-- > 1;) {
    if (file.layers.layers[layer].parent >= 0) continue;
    const auto k =
        static_cast<std::size_t>(fit.parent[static_cast<std::size_t>(file.leaf_of[layer + 1])]);
    const auto painted = [&, end](std::size_t i, double bias) {
      double left = 1.0;
      for (std::size_t l = layer; l != end; ++l)
        left *= 1.0 - bias * static_cast<double>(products[l][i]);
      return 1.0 - left;
    };
    double low = 0.0;
    double high = 1.0;
    for (int step = 0; step != halvings; ++step) {
      const double bias = 0.5 * (low + high);
      const double seen =
          deterministic_sum(some.size(), [&](std::size_t i) { return painted(i, bias) * rest[i]; });
      (seen < wanted[k] ? low : high) = bias;
    }
    fit.classes.bias[k] = 0.5 * (low + high);
    for (std::size_t i = 0; i != rest.size(); ++i) rest[i] *= 1.0 - painted(i, fit.classes.bias[k]);
    end = layer;
  }
}

}  // namespace

std::vector<std::vector<std::uint8_t>> sample_indices(const std::vector<Grid<float>>& inputs,
                                                      const std::vector<LayerInput>& ranges) {
  std::vector<std::vector<std::uint8_t>> indices(inputs.size());
  for (std::size_t a = 0; a != inputs.size(); ++a) {
    indices[a].resize(inputs[a].size());
    const double scale = 256.0 / (ranges[a].high - ranges[a].low);
    for (std::size_t i = 0; i != inputs[a].size(); ++i)
      indices[a][i] = static_cast<std::uint8_t>(
          std::clamp((static_cast<double>(inputs[a][i]) - ranges[a].low) * scale, 0.0, 255.0));
  }
  return indices;
}

GroundFit fit_ground(const KnownGround& ground, const GroundFitParameters& parameters,
                     const Grid<std::uint8_t>* learn) {
  constexpr std::size_t fewest = 100;
  const int classes = static_cast<int>(ground.classes.size());
  std::vector<std::uint8_t> labels = ground.labels;
  Grid<std::uint8_t> use(ground.altitude_m.width(), ground.altitude_m.height(), 0);
  for (std::size_t i = 0; i != labels.size(); ++i) {
    if (learn != nullptr && (*learn)[i] == 0) labels[i] = no_class;
    use[i] = labels[i] != no_class ? 1 : 0;
  }
  GroundFit fit;
  if (ground.picture) {
    // Cells in shadow do not show their material.
    Grid<float> brightness(use.width(), use.height());
    for (std::size_t i = 0; i != brightness.size(); ++i) {
      const glm::dvec3 rgb = ground.picture->rgb[i];
      brightness[i] = static_cast<float>((rgb.x + rgb.y + rgb.z) / 3.0);
    }
    fit.sun = find_sun(ground.altitude_m, ground.cell_m, brightness, {}, use,
                       ground.picture->sun_azimuth_deg);
    const Grid<float> light = sunlight(ground.altitude_m, ground.cell_m, fit.sun);
    fit.light = light_answers(ground.picture->rgb, light, labels, classes, use);
    for (std::size_t i = 0; i != labels.size(); ++i)
      if (!(light[i] > 0.05F)) {
        labels[i] = no_class;
        use[i] = 0;
      }
  }
  const std::vector<std::size_t> counts = count_labels(labels, classes);
  std::size_t learned = 0;
  for (const std::size_t c : counts) learned += c;
  const auto occurring =
      std::count_if(counts.begin(), counts.end(), [](std::size_t c) { return c > 0; });
  if (learned < fewest || occurring < 2)
    throw Error(ErrorKind::input, "layers fit",
                fmt::format("{} cells of {} class{} to learn from", learned, occurring,
                            occurring == 1 ? "" : "es"),
                fmt::format("at least {} cells of at least two classes", fewest));
  for (std::size_t a = 0; a != ground.inputs.size(); ++a)
    fit.ranges.push_back(layer_input_range(ground.input_names[a], ground.inputs[a], &use));
  const std::vector<std::vector<std::uint8_t>> samples = sample_indices(ground.inputs, fit.ranges);
  fit.classes = fit_functions(cells_of(samples, labels, classes), parameters, 60'000);
  std::vector<std::uint8_t> leaves = labels;
  if (ground.picture) {
    fit_children(ground, parameters, samples, labels, fit, leaves);
  } else {
    for (int k = 0; k != classes; ++k) {
      const std::uint32_t rgb = ground.classes[static_cast<std::size_t>(k)].rgb;
      fit.parent.push_back(k);
      fit.colours.emplace_back(rgb >> 16U, rgb >> 8U & 255U, rgb & 255U);
      fit.cells.push_back(counts[static_cast<std::size_t>(k)]);
      fit.children.emplace_back();
    }
  }
  if (parameters.functions == FunctionSource::fitted && parameters.model == LayerModel::product)
    match_painted_areas(ground, labels, fit);
  if (parameters.forest_share > 0.0) {
    fit.forest_share = parameters.forest_share;
    fit.forest =
        fit_forest(cells_of(samples, std::move(leaves), static_cast<int>(fit.parent.size())));
  }
  return fit;
}

GroundPrediction predict_ground(const KnownGround& ground, const GroundFit& fit) {
  const std::size_t classes = ground.classes.size();
  const std::size_t leaves = fit.parent.size();
  const std::size_t cells = ground.altitude_m.size();
  GroundPrediction prediction;
  ClassShares of_leaves = seen_leaves(ground, fit);
  prediction.classes = {static_cast<int>(classes), std::vector<float>(cells * classes, 0.0F)};
  if (fit.forest_share > 0.0)
    of_leaves = mix_shares(predict_shares(fit.forest, sample_indices(ground.inputs, fit.ranges)),
                           of_leaves, fit.forest_share);
  for (std::size_t i = 0; i != cells; ++i)
    for (std::size_t j = 0; j != leaves; ++j)
      prediction.classes.values[i * classes + static_cast<std::size_t>(fit.parent[j])] +=
          of_leaves.values[i * leaves + j];
  const int width = ground.altitude_m.width();
  const int height = ground.altitude_m.height();
  prediction.even = Grid<glm::vec3>(width, height);
  prediction.expected = prediction.even;
  const bool lit = ground.picture.has_value();
  const Grid<float> light =
      lit ? sunlight(ground.altitude_m, ground.cell_m, fit.sun) : Grid<float>();
  const double level = level_cosine(fit.sun);
  parallel_rows(height, [&](int y) {
    for (std::size_t i = prediction.even.index(0, y); i != prediction.even.index(0, y + 1); ++i) {
      glm::dvec3 colour(0.0);
      std::array<LightAnswer, 3> answer;
      answer.fill({0.0, 0.0});
      for (std::size_t j = 0; j != leaves; ++j) {
        const auto share = static_cast<double>(of_leaves.values[i * leaves + j]);
        colour += share * fit.colours[j];
        for (std::size_t c = 0; lit && c != 3; ++c) {
          const LightAnswer& of = fit.light[static_cast<std::size_t>(fit.parent[j])][c];
          answer[c].gain += share * of.gain;
          answer[c].base += share * of.base;
        }
      }
      prediction.even[i] = glm::clamp(colour, 0.0, 255.0);
      for (int c = 0; lit && c != 3; ++c)
        colour[c] /=
            levelling(answer[static_cast<std::size_t>(c)], static_cast<double>(light[i]), level);
      prediction.expected[i] = glm::clamp(colour, 0.0, 255.0);
    }
  });
  return prediction;
}

SurfaceLayers surface_layers_of(const KnownGround& ground, const GroundFit& fit,
                                const std::string& name) {
  return leaf_layers(ground, fit, name).layers;
}

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
