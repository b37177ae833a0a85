#include "terrain/layers/fit/ground_fit.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/angle.h"
#include "base/error.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/cover/layer_inputs.h"
#include "terrain/layers/fit/clusters.h"

namespace belvedere {
namespace {

double brightness_at(const RgbPlanes& rgb, std::size_t i) {
  return (static_cast<double>(rgb.r[i]) + static_cast<double>(rgb.g[i]) + static_cast<double>(rgb.b[i])) / 3.0;
}

double level_cosine(const PictureSun& sun) { return exact::sin(to_radians(sun.elevation_deg)); }

// Colour more than lightness, which shading has still a share in.
ClusterPlace colour_place(double r, double g, double b) {
  constexpr double lightness_weight = 0.012;
  constexpr double darkest = 8.0;
  const LabColour lab = lab_of_srgb(std::clamp(r, 0.0, 255.0), std::clamp(g, 0.0, 255.0), std::clamp(b, 0.0, 255.0));
  const double l = std::max(lab.l, darkest);
  return {lab.a / l, lab.b / l, lightness_weight * lab.l};
}

FitCells cells_of(const std::vector<std::vector<std::uint8_t>>& inputs, std::vector<std::uint8_t> labels, int classes) {
  const FitCells all{classes, inputs, std::move(labels)};
  return select_cells(all, draw_labelled(all.labels, all.size()));
}

ClassFunctions fit_functions(const FitCells& cells, const GroundFitParameters& parameters, std::size_t most) {
  if (parameters.functions == FunctionSource::histogram) return histogram_functions(cells);
  if (parameters.model == LayerModel::product) return fit_product(cells, {.most = most});
  return fit_additive(cells, {.roughness = 2e-3, .steps = 120, .most = most});
}

// Divides each class by its colours on level ground: leaf labels of the cells learned from, functions of the leaves within their class.
void fit_children(const KnownGround& ground, const GroundFitParameters& parameters, const std::vector<std::vector<std::uint8_t>>& samples,
                  const std::vector<std::uint8_t>& labels, GroundFit& fit, std::vector<std::uint8_t>& leaves) {
  constexpr std::size_t most_for_means = 6'000;
  constexpr std::size_t most_for_functions = 20'000;
  constexpr double small = 0.05;  // share of the ground below which a class has half as many children
  const RgbPlanes& rgb = ground.picture->rgb;
  const Grid<float> light = sunlight(ground.altitude_m, ground.cell_m, fit.sun);
  const RgbPlanes even = lit_evenly(rgb, light, level_cosine(fit.sun), labels, fit.light);
  const std::vector<std::size_t> counts = count_labels(labels, static_cast<int>(ground.classes.size()));
  std::size_t learned = 0;
  for (const std::size_t c : counts) learned += c;
  leaves.assign(labels.size(), no_class);
  for (std::size_t k = 0; k != ground.classes.size(); ++k) {
    std::vector<std::uint8_t> own(labels.size(), no_class);
    for (std::size_t i = 0; i != labels.size(); ++i)
      if (labels[i] == k) own[i] = 0;
    const auto place_of = [&](std::size_t i) {
      return colour_place(static_cast<double>(even.r[i]), static_cast<double>(even.g[i]), static_cast<double>(even.b[i]));
    };
    std::vector<ClusterPlace> places;
    for (const std::uint32_t i : draw_labelled(own, most_for_means, 10 + k)) places.push_back(place_of(i));
    const bool is_small = static_cast<double>(counts[k]) < small * static_cast<double>(learned);
    const std::vector<ClusterPlace> means =
        cluster_means(places, std::max(1, is_small ? (parameters.children + 1) / 2 : parameters.children), {.part = 10 + k});
    const auto first = static_cast<std::uint8_t>(fit.parent.size());
    const std::size_t count = std::max<std::size_t>(means.size(), 1);
    std::vector<std::array<double, 3>> sums(count, std::array<double, 3>{});
    std::vector<std::size_t> cells(count, 0);
    for (std::size_t i = 0; i != own.size(); ++i) {
      if (own[i] == no_class) continue;
      own[i] = nearest_mean(place_of(i), means);
      leaves[i] = static_cast<std::uint8_t>(first + own[i]);
      sums[own[i]][0] += static_cast<double>(even.r[i]);
      sums[own[i]][1] += static_cast<double>(even.g[i]);
      sums[own[i]][2] += static_cast<double>(even.b[i]);
      ++cells[own[i]];
    }
    for (std::size_t j = 0; j != count; ++j) {
      for (double& v : sums[j]) v = cells[j] > 0 ? v / static_cast<double>(cells[j]) : 128.0;
      fit.parent.push_back(static_cast<int>(k));
      fit.colours.push_back(sums[j]);
      fit.cells.push_back(cells[j]);
    }
    fit.children.emplace_back();
    if (count > 1)
      fit.children.back() = fit_functions(cells_of(samples, std::move(own), static_cast<int>(count)), parameters, most_for_functions);
  }
}

std::uint32_t packed(const std::array<double, 3>& rgb) {
  std::uint32_t value = 0;
  for (const double c : rgb) value = value << 8U | static_cast<std::uint32_t>(std::clamp(c, 0.0, 255.0) + 0.5);
  return value;
}

// Functions that say nothing are left out: those of a product that are 1 throughout, and of a sum those that change a share by less than
// two hundredths of itself from one end to the other.
void set_functions(SurfaceLayer& layer, const ClassFunctions& functions, std::size_t of) {
  constexpr double least_span = 0.02;
  layer.noise.bias = functions.bias[of];
  layer.functions.clear();
  for (const LayerSamples& function : functions.functions[of]) {
    const auto [low, high] = std::minmax_element(function.samples.begin(), function.samples.end());
    const double step = (function.at_255 - function.at_0) / 255.0;
    if (functions.model == LayerModel::product && function.at_255 == 1.0 && *low == 255) {
      layer.functions.emplace_back();
    } else if (functions.model == LayerModel::additive && step * (*high - *low) < least_span) {
      layer.noise.bias += function.at_0 + step * 0.5 * (*low + *high);
      layer.functions.emplace_back();
    } else {
      layer.functions.emplace_back(function);
    }
  }
}

// First leaf of each class, and after the last the number of leaves.
std::vector<std::size_t> first_leaves(const GroundFit& fit) {
  std::vector<std::size_t> first(fit.children.size() + 1, fit.parent.size());
  for (std::size_t j = fit.parent.size(); j-- != 0;) first[static_cast<std::size_t>(fit.parent[j])] = j;
  return first;
}

// The classes' shares, each shared out among its leaves.
ClassShares shared_leaves(const GroundFit& fit, const std::vector<std::vector<std::uint8_t>>& samples) {
  const ClassShares of_classes = predict_shares(fit.classes, samples);
  const std::vector<std::size_t> first = first_leaves(fit);
  const std::size_t leaves = fit.parent.size();
  ClassShares shares{static_cast<int>(leaves), std::vector<float>(of_classes.size() * leaves)};
  for (std::size_t k = 0; k != fit.children.size(); ++k) {
    const std::size_t count = first[k + 1] - first[k];
    const ClassShares within = count > 1 ? predict_shares(fit.children[k], samples) : ClassShares{};
    for (std::size_t i = 0; i != of_classes.size(); ++i)
      for (std::size_t j = 0; j != count; ++j)
        shares.values[i * leaves + first[k] + j] = of_classes.of(i)[k] * (count > 1 ? within.of(i)[j] : 1.0F);
  }
  return shares;
}

// As a file of a product is painted: a class with the colour of its first child, then its other children, each over all that is there and
// never more than their class (P04, P05).
ClassShares painted_leaves(const GroundFit& fit, const std::vector<std::vector<std::uint8_t>>& samples) {
  const ClassShares of_classes = predict_coverage(fit.classes, samples);
  const std::vector<std::size_t> first = first_leaves(fit);
  const std::size_t leaves = fit.parent.size();
  ClassShares shares{static_cast<int>(leaves), std::vector<float>(of_classes.size() * leaves, 0.0F)};
  const auto paint = [&](std::size_t cell, std::size_t leaf, float coverage) {
    float* const of = &shares.values[cell * leaves];
    for (std::size_t j = 0; j != leaves; ++j) of[j] *= 1.0F - coverage;
    of[leaf] += coverage;
  };
  for (const int k_int : fit.classes.order) {
    const auto k = static_cast<std::size_t>(k_int);
    const std::size_t count = first[k + 1] - first[k];
    const ClassShares within = count > 1 ? predict_coverage(fit.children[k], samples) : ClassShares{};
    const std::size_t own = count > 1 ? static_cast<std::size_t>(fit.children[k].order[0]) : 0;
    parallel_ranges(of_classes.size(), std::size_t{16384}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) {
        const float coverage = of_classes.of(i)[k];
        paint(i, first[k] + own, coverage);
        for (std::size_t rank = 1; rank < count; ++rank) {
          const auto j = static_cast<std::size_t>(fit.children[k].order[rank]);
          paint(i, first[k] + j, coverage * within.of(i)[j]);
        }
      }
    });
  }
  return shares;
}

// Scales b of each class so that on the ground learned from it covers what it does there, children and all: a child of coverage C lies over
// what is under its class as well, so that classes with children would come out too large. From the top down, since what lies over a layer
// decides what is seen of it. A sum does so by itself: that is where its likelihood is flat.
void match_painted_areas(GroundFit& fit, const FitCells& all) {
  constexpr std::size_t most = 40'000;
  constexpr int halvings = 16;
  const FitCells cells = select_cells(all, draw_labelled(all.labels, most, 4));
  const std::vector<std::size_t> counts = count_labels(cells.labels, cells.classes);
  ClassFunctions unscaled = fit.classes;
  std::fill(unscaled.bias.begin(), unscaled.bias.end(), 1.0);
  const ClassShares products = predict_coverage(unscaled, cells.inputs);
  std::vector<double> rest(cells.size(), 1.0);
  for (std::size_t rank = fit.classes.order.size(); rank-- > 1;) {
    const auto k = static_cast<std::size_t>(fit.classes.order[rank]);
    const bool divided = !fit.children[k].order.empty();
    const ClassShares within = divided ? predict_coverage(fit.children[k], cells.inputs) : ClassShares{};
    const auto painted = [&](std::size_t i, double bias) {
      const double coverage = bias * static_cast<double>(products.of(i)[k]);
      double left = 1.0 - coverage;
      for (std::size_t r = 1; divided && r != fit.children[k].order.size(); ++r)
        left *= 1.0 - coverage * static_cast<double>(within.of(i)[static_cast<std::size_t>(fit.children[k].order[r])]);
      return 1.0 - left;
    };
    double low = 0.0;
    double high = 1.0;
    for (int step = 0; step != halvings; ++step) {
      const double bias = 0.5 * (low + high);
      const double seen = deterministic_sum(cells.size(), [&](std::size_t i) { return painted(i, bias) * rest[i]; });
      (seen < static_cast<double>(counts[k]) ? low : high) = bias;
    }
    fit.classes.bias[k] = 0.5 * (low + high);
    for (std::size_t i = 0; i != cells.size(); ++i) rest[i] *= 1.0 - painted(i, fit.classes.bias[k]);
  }
}

}  // namespace

std::vector<std::vector<std::uint8_t>> sample_indices(const std::vector<Grid<float>>& inputs, const std::vector<LayerInput>& ranges) {
  std::vector<std::vector<std::uint8_t>> indices(inputs.size());
  for (std::size_t a = 0; a != inputs.size(); ++a) {
    indices[a].resize(inputs[a].size());
    const double scale = 256.0 / (ranges[a].high - ranges[a].low);
    for (std::size_t i = 0; i != inputs[a].size(); ++i)
      indices[a][i] = static_cast<std::uint8_t>(std::clamp((static_cast<double>(inputs[a][i]) - ranges[a].low) * scale, 0.0, 255.0));
  }
  return indices;
}

GroundFit fit_ground(const KnownGround& ground, const GroundFitParameters& parameters, const Grid<std::uint8_t>* learn) {
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
    // Cells that the sun does not reach show nothing of what they are.
    Grid<float> brightness(use.width(), use.height());
    for (std::size_t i = 0; i != brightness.size(); ++i) brightness[i] = static_cast<float>(brightness_at(ground.picture->rgb, i));
    fit.sun = find_sun(ground.altitude_m, ground.cell_m, brightness, {}, use, ground.picture->sun_azimuth_deg);
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
  const auto occurring = std::count_if(counts.begin(), counts.end(), [](std::size_t c) { return c > 0; });
  if (learned < fewest || occurring < 2)
    throw Error(ErrorKind::input, "layers fit",
                fmt::format("{} cells of {} class{} to learn from", learned, occurring, occurring == 1 ? "" : "es"),
                fmt::format("at least {} cells of at least two classes", fewest));
  for (std::size_t a = 0; a != ground.inputs.size(); ++a)
    fit.ranges.push_back(layer_input_range(ground.input_names[a], ground.inputs[a], &use));
  const std::vector<std::vector<std::uint8_t>> samples = sample_indices(ground.inputs, fit.ranges);
  const FitCells cells = cells_of(samples, labels, classes);
  fit.classes = fit_functions(cells, parameters, 60'000);
  std::vector<std::uint8_t> leaves = labels;
  if (ground.picture) {
    fit_children(ground, parameters, samples, labels, fit, leaves);
  } else {
    for (int k = 0; k != classes; ++k) {
      const std::uint32_t rgb = ground.classes[static_cast<std::size_t>(k)].rgb;
      fit.parent.push_back(k);
      fit.colours.push_back({static_cast<double>(rgb >> 16U), static_cast<double>(rgb >> 8U & 255U), static_cast<double>(rgb & 255U)});
      fit.cells.push_back(counts[static_cast<std::size_t>(k)]);
      fit.children.emplace_back();
    }
  }
  if (parameters.functions == FunctionSource::fitted && parameters.model == LayerModel::product) match_painted_areas(fit, cells);
  if (parameters.forest_share > 0.0) {
    fit.forest_share = parameters.forest_share;
    fit.forest = fit_forest(cells_of(samples, std::move(leaves), static_cast<int>(fit.parent.size())));
  }
  return fit;
}

GroundPrediction predict_ground(const KnownGround& ground, const GroundFit& fit) {
  const std::vector<std::vector<std::uint8_t>> samples = sample_indices(ground.inputs, fit.ranges);
  const std::size_t classes = ground.classes.size();
  const std::size_t leaves = fit.parent.size();
  const std::size_t cells = ground.altitude_m.size();
  GroundPrediction prediction;
  ClassShares of_leaves = fit.classes.model == LayerModel::product ? painted_leaves(fit, samples) : shared_leaves(fit, samples);
  prediction.classes = {static_cast<int>(classes), std::vector<float>(cells * classes, 0.0F)};
  if (fit.forest_share > 0.0) {
    of_leaves = mix_shares(predict_shares(fit.forest, samples), of_leaves, fit.forest_share);
  }
  for (std::size_t i = 0; i != cells; ++i)
    for (std::size_t j = 0; j != leaves; ++j)
      prediction.classes.values[i * classes + static_cast<std::size_t>(fit.parent[j])] += of_leaves.values[i * leaves + j];
  const int width = ground.altitude_m.width();
  const int height = ground.altitude_m.height();
  prediction.even = {Grid<float>(width, height), Grid<float>(width, height), Grid<float>(width, height)};
  prediction.expected = prediction.even;
  const bool lit = ground.picture.has_value();
  const Grid<float> light = lit ? sunlight(ground.altitude_m, ground.cell_m, fit.sun) : Grid<float>(width, height, 1.0F);
  const double level = lit ? level_cosine(fit.sun) : 1.0;
  parallel_rows(height, [&](int y) {
    for (std::size_t i = light.index(0, y); i != light.index(0, y + 1); ++i)
      for (std::size_t c = 0; c != 3; ++c) {
        double colour = 0.0;
        LightAnswer answer{0.0, 0.0};
        for (std::size_t j = 0; j != leaves; ++j) {
          const auto share = static_cast<double>(of_leaves.values[i * leaves + j]);
          colour += share * fit.colours[j][c];
          if (!lit) continue;
          const LightAnswer& of = fit.light[static_cast<std::size_t>(fit.parent[j])][c];
          answer.gain += share * of.gain;
          answer.base += share * of.base;
        }
        Grid<float>& even = c == 0 ? prediction.even.r : c == 1 ? prediction.even.g : prediction.even.b;
        Grid<float>& expected = c == 0 ? prediction.expected.r : c == 1 ? prediction.expected.g : prediction.expected.b;
        even[i] = static_cast<float>(std::clamp(colour, 0.0, 255.0));
        expected[i] =
            static_cast<float>(std::clamp(colour / (lit ? levelling(answer, static_cast<double>(light[i]), level) : 1.0), 0.0, 255.0));
      }
  });
  return prediction;
}

SurfaceLayers surface_layers_of(const KnownGround& ground, const GroundFit& fit, const std::string& name) {
  SurfaceLayers layers;
  layers.name = name;
  layers.model = fit.classes.model;
  layers.inputs = fit.ranges;
  const std::size_t leaves = fit.parent.size();
  for (const int k_int : fit.classes.order) {
    const auto k = static_cast<std::size_t>(k_int);
    const auto first = static_cast<std::size_t>(std::find(fit.parent.begin(), fit.parent.end(), k_int) - fit.parent.begin());
    std::size_t count = 0;
    while (first + count != leaves && fit.parent[first + count] == k_int) ++count;
    SurfaceLayer layer;
    layer.name = ground.classes[k].name;
    layer.painted_as = ground.classes[k].painted_as;
    set_functions(layer, fit.classes, k);
    const int index = static_cast<int>(layers.layers.size());
    // In a product the first of the children covers its class wholly: the class's own colour.
    const bool product = layers.model == LayerModel::product;
    const std::size_t own = count > 1 ? first + static_cast<std::size_t>(fit.children[k].order[0]) : first;
    layer.rgb = packed(fit.colours[own]);
    layers.layers.push_back(layer);
    if (index == 0) {
      layers.ground_rgb = layer.rgb;
      layers.ground_painted_as = layer.painted_as;
    }
    for (std::size_t rank = product ? 1 : 0; count > 1 && rank != count; ++rank) {
      const auto j = static_cast<std::size_t>(fit.children[k].order[rank]);
      SurfaceLayer child;
      child.name = fmt::format("{}, colour {}", layer.name, rank + 1);
      child.parent = index;
      child.rgb = packed(fit.colours[first + j]);
      set_functions(child, fit.children[k], j);
      layers.layers.push_back(std::move(child));
    }
  }
  check_surface_layers(layers, name);
  return layers;
}

}  // namespace belvedere
