#include "terrain/layers/layer_coverage.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <variant>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/random.h"
#include "terrain/cover/ground_variables.h"
#include "terrain/layers/layer_noise.h"

namespace belvedere {
namespace {

// e^x for x ≤ 0 by sums and products only, so the same on every machine: 2^n times the series of
// 2^f, |f| ≤ 1/2. Relative error below 3e-7; 0 below -80.
float exp_of(float x) {
  if (!(x > -80.F)) return 0.F;
  const float turned = x * 1.44269504F;
  const float whole = std::floor(turned + 0.5F);
  const float f = turned - whole;
  const float series =
      1.F + f * (0.693147181F +
                 f * (0.240226507F +
                      f * (0.0555041087F +
                           f * (0.00961812911F + f * (0.00133335581F + f * 0.000154035304F)))));
  return series *
         std::bit_cast<float>(static_cast<std::uint32_t>(static_cast<int>(whole) + 127) << 23U);
}

// One field of noise for siblings of equal scale, octaves and gain.
struct NoiseField {
  int parent;
  double scale_m;
  int octaves;
  double gain;
  LayerNoiseRows rows;
  std::vector<float> line;
  bool filled = false;  // for the current row
};

// Table positions of one input along a row.
struct Places {
  std::vector<std::uint8_t> sample;
  std::vector<float> part;
};

// Inputs that follow from the gradient of the ground.
constexpr std::array<std::string_view, 4> tilted_names = {"slope", "north", "east", "south"};

double mean_cell(const GeoTransform& transform) {
  return 0.5 * (transform.cell_x + transform.cell_y);
}

// Whether a layer has bumps that are visible at cells of this size.
bool is_raised(const LayerProgram& program, std::size_t layer, double cell_m) {
  const SurfaceLayer& of = program.layers.layers[layer];
  return program.paints[layer] && of.roughness_m > 0.0 && of.roughness_scale_m > cell_m;
}

double tan_of_degrees(double degrees) {
  const exact::Turn turn = exact::turn(to_radians(degrees));
  return turn.sine / turn.cosine;
}

// The evaluation of one rectangle.
class Evaluation {
 public:
  Evaluation(const LayerProgram& program, const std::vector<Grid<float>>& inputs,
             const GeoTransform& transform, const PixelRect& cells, std::uint64_t seed,
             RaisedGround* raised)
      : program_(program),
        layers_(program.layers),
        transform_(transform),
        cells_(cells),
        seed_(seed),
        width_(static_cast<std::size_t>(cells.width())),
        raised_(raised) {
    for (const Grid<float>& input : inputs) inputs_.push_back(&input);
    const std::size_t count = layers_.layers.size();
    field_of_.assign(count, -1);
    for (std::size_t k = 0; k < count; ++k) {
      const SurfaceLayer& layer = layers_.layers[k];
      if (layer.noise.amplitude == 0.0) continue;
      const auto same = std::find_if(fields_.begin(), fields_.end(), [&](const NoiseField& f) {
        return f.parent == layer.parent && f.scale_m == layer.noise.scale_m &&
               f.octaves == layer.noise.octaves && f.gain == layer.noise.gain;
      });
      field_of_[k] = static_cast<int>(same - fields_.begin());
      if (same != fields_.end()) continue;
      const std::string& parent = layer.parent < 0
                                      ? layers_.name
                                      : layers_.layers[static_cast<std::size_t>(layer.parent)].name;
      const std::uint64_t own =
          stream_seed(seed, Stream::class_noise,
                      seed_of_name(parent) ^ std::bit_cast<std::uint64_t>(layer.noise.scale_m));
      fields_.push_back({layer.parent, layer.noise.scale_m, layer.noise.octaves, layer.noise.gain,
                         LayerNoiseRows(layer.noise, own, transform, cells),
                         std::vector<float>(width_)});
    }
    if (raised_ != nullptr) ground_m_ = raised_->height_m;
    evaluate_expressions(0);
    positions_.resize(layers_.inputs.size());
    used_.assign(layers_.inputs.size(), false);
    for (const std::vector<int>& tables : program.table_of)
      for (std::size_t i = 0; i < tables.size(); ++i) used_[i] = used_[i] || tables[i] >= 0;
    for (Places& p : positions_) {
      p.sample.resize(width_);
      p.part.resize(width_);
    }
    coverage_.assign(count, Grid<float>(cells.width(), cells.height()));
    if (layers_.model == LayerModel::additive) scores_.assign(count, std::vector<float>(width_));
  }

  std::vector<Grid<float>> run() {
    const std::size_t count = layers_.layers.size();
    if (layers_.model == LayerModel::additive) {
      rows([&](int y) { additive_row(y); });
      for (std::size_t k = 0; k < count; ++k)
        if (raises(k)) raise(k);
      return std::move(coverage_);
    }
    // Row by row up to the next layer that raises the ground.
    for (std::size_t begin = 0, end = 0; begin != count; begin = end) {
      while (end != count && !raises(end)) ++end;
      const bool up = end != count;
      if (up) ++end;
      rows([&](int y) {
        for (std::size_t k = begin; k != end; ++k) product_row(k, y);
      });
      if (!up) continue;
      raise(end - 1);
      if (end != count) hand_on(end);
    }
    return std::move(coverage_);
  }

 private:
  template <class OfRow>
  void rows(OfRow&& of_row) {
    for (int y = 0; y < cells_.height(); ++y) {
      for (NoiseField& field : fields_) field.filled = false;
      for (std::size_t i = 0; i < positions_.size(); ++i)
        if (used_[i]) find_positions(i, y);
      of_row(y);
    }
  }

  // The conditions of the layers from `first` on, with the current inputs.
  void evaluate_expressions(std::size_t first) {
    if (std::none_of(layers_.layers.begin() + static_cast<std::ptrdiff_t>(first),
                     layers_.layers.end(), [](const auto& l) { return !l.when.empty(); }))
      return;
    std::vector<const Grid<float>*> read;
    for (const int i : program_.input_of_slot)
      read.push_back(i < 0 ? nullptr : inputs_[static_cast<std::size_t>(i)]);
    when_ =
        evaluate_layer_expressions(program_.expressions, read, transform_, cells_, seed_, first);
  }

  bool raises(std::size_t k) const {
    return raised_ != nullptr && is_raised(program_, k, mean_cell(transform_));
  }

  void raise(std::size_t k) {
    const SurfaceLayer& layer = layers_.layers[k];
    LayerNoiseRows bumps(bump_noise(layer.roughness_scale_m), bump_seed(layer, seed_), transform_,
                         cells_);
    std::vector<float> line(width_);
    const auto roughness = static_cast<float>(layer.roughness_m);
    for (int y = 0; y < cells_.height(); ++y) {
      bumps.fill(cells_.y0 + y, line.data());
      const float* c = coverage_[k].row(y);
      float* height = raised_->height_m.row(y);
      for (std::size_t x = 0; x < width_; ++x) height[x] += c[x] * roughness * line[x];
    }
  }

  // Inputs of the layers from `first` on, from the raised height.
  void hand_on(std::size_t first) {
    for (std::size_t i = 0; i < inputs_.size(); ++i)
      if (program_.inputs[i] == "altitude") inputs_[i] = &raised_->height_m;
    if (!raised_->slope_north_east.empty()) {
      tilt();
      for (std::size_t i = 0; i < inputs_.size(); ++i)
        for (std::size_t t = 0; t < tilted_names.size(); ++t)
          if (program_.inputs[i] == tilted_names[t]) inputs_[i] = &tilted_[t];
    }
    evaluate_expressions(first);
  }

  // Slope and exposures of the smooth ground with the slopes of the bumps so far.
  void tilt() {
    const Grid<float>& slope = raised_->slope_north_east[0];
    const Grid<float>& north = raised_->slope_north_east[1];
    const Grid<float>& east = raised_->slope_north_east[2];
    tilted_.assign(tilted_names.size(), Grid<float>(cells_.width(), cells_.height()));
    const auto bump = [&](int x, int y) {
      return static_cast<double>(raised_->height_m.clamped(x, y) - ground_m_.clamped(x, y));
    };
    for (int y = 0; y < cells_.height(); ++y)
      for (int x = 0; x < cells_.width(); ++x) {
        const auto change = [&](double ahead, double behind, bool one_sided, double cell) {
          return (ahead - behind) / (one_sided ? cell : 2.0 * cell);
        };
        const double rise_east = change(bump(x + 1, y), bump(x - 1, y),
                                        x == 0 || x + 1 == cells_.width(), transform_.cell_x);
        const double rise_north = change(bump(x, y - 1), bump(x, y + 1),
                                         y == 0 || y + 1 == cells_.height(), transform_.cell_y);
        std::array<double, 3> facing = {static_cast<double>(slope(x, y)),
                                        static_cast<double>(north(x, y)),
                                        static_cast<double>(east(x, y))};
        if (rise_east != 0.0 || rise_north != 0.0) {
          // A facing is the fall towards it over the slope, which fades on level ground.
          const double steep = tan_of_degrees(facing[0]);
          const double fall_north = facing[1] * (steep + exposure_fade) - rise_north;
          const double fall_east = facing[2] * (steep + exposure_fade) - rise_east;
          const double raised = std::sqrt(fall_north * fall_north + fall_east * fall_east);
          facing = {to_degrees(exact::atan(raised)), fall_north / (raised + exposure_fade),
                    fall_east / (raised + exposure_fade)};
        }
        tilted_[0](x, y) = static_cast<float>(facing[0]);
        tilted_[1](x, y) = static_cast<float>(facing[1]);
        tilted_[2](x, y) = static_cast<float>(facing[2]);
        tilted_[3](x, y) = -tilted_[1](x, y);
      }
  }

  void find_positions(std::size_t input, int y) {
    const LayerInput& range = layers_.inputs[input];
    const auto low = static_cast<float>(range.low);
    const auto scale = static_cast<float>(256.0 / (range.high - range.low));
    const float* values = inputs_[input]->row(y);
    Places& positions = positions_[input];
    for (std::size_t x = 0; x < width_; ++x) {
      const float at = std::clamp((values[x] - low) * scale - 0.5F, 0.F, 255.F);
      const int sample = static_cast<int>(at);
      positions.sample[x] = static_cast<std::uint8_t>(sample);
      positions.part[x] = at - static_cast<float>(sample);
    }
  }

  const float* noise_row(std::size_t layer, int y) {
    if (field_of_[layer] < 0) return nullptr;
    NoiseField& field = fields_[static_cast<std::size_t>(field_of_[layer])];
    if (!field.filled) field.rows.fill(cells_.y0 + y, field.line.data());
    field.filled = true;
    return field.line.data();
  }

  // f(x, value of the function at cell x) for each cell.
  template <class F>
  void each_value(std::size_t layer, std::size_t input, int y, F&& f) {
    const LayerFunction& function = layers_.layers[layer].functions[input];
    if (const int t = program_.table_of[layer][input]; t >= 0) {
      const auto& samples = program_.tables[static_cast<std::size_t>(t)].samples;
      const std::uint8_t* sample = positions_[input].sample.data();
      const float* part = positions_[input].part.data();
      for (std::size_t x = 0; x < width_; ++x) {
        const std::array<float, 2>& s = samples[sample[x]];
        f(x, s[0] + part[x] * s[1]);
      }
    } else if (std::holds_alternative<LayerHat>(function)) {
      const float* values = inputs_[input]->row(y);
      for (std::size_t x = 0; x < width_; ++x)
        f(x, static_cast<float>(layer_function_value(function, layers_.inputs[input], layers_.model,
                                                     static_cast<double>(values[x]))));
    }
  }

  void product_row(std::size_t k, int y) {
    const SurfaceLayer& layer = layers_.layers[k];
    float* out = coverage_[k].row(y);
    const float* parent =
        layer.parent < 0 ? nullptr : coverage_[static_cast<std::size_t>(layer.parent)].row(y);
    const bool lies_bare =
        parent != nullptr && std::all_of(parent, parent + width_, [](float c) { return c == 0.F; });
    if (lies_bare) return;  // grids begin as 0
    std::fill_n(out, width_, 1.F);
    for (std::size_t i = 0; i < layer.functions.size(); ++i)
      each_value(k, i, y, [&](std::size_t x, float value) { out[x] *= value; });
    if (!layer.when.empty()) {
      const std::uint8_t* when = when_[k].row(y);
      for (std::size_t x = 0; x < width_; ++x) out[x] = when[x] != 0 ? out[x] : 0.F;
    }
    const auto bias = static_cast<float>(layer.noise.bias);
    const auto amplitude = static_cast<float>(layer.noise.amplitude);
    const bool nothing = std::all_of(out, out + width_, [](float p) { return p == 0.F; });
    if (const float* noise = nothing ? nullptr : noise_row(k, y))
      for (std::size_t x = 0; x < width_; ++x) out[x] *= bias + amplitude * noise[x];
    else
      for (std::size_t x = 0; x < width_; ++x) out[x] *= bias;
    for (std::size_t x = 0; x < width_; ++x) out[x] = std::clamp(out[x], 0.F, 1.F);
    if (parent != nullptr)
      for (std::size_t x = 0; x < width_; ++x) out[x] *= parent[x];
  }

  // Shares first, in `coverage_`: softmax of siblings times their parent's share. Then coverages,
  // from the bottom up.
  void additive_row(int y) {
    const std::size_t count = layers_.layers.size();
    for (std::size_t k = 0; k < count; ++k) {
      const SurfaceLayer& layer = layers_.layers[k];
      float* score = scores_[k].data();
      std::fill_n(score, width_, static_cast<float>(layer.noise.bias));
      for (std::size_t i = 0; i < layer.functions.size(); ++i)
        each_value(k, i, y, [&](std::size_t x, float value) { score[x] += value; });
      const auto amplitude = static_cast<float>(layer.noise.amplitude);
      if (const float* noise = noise_row(k, y))
        for (std::size_t x = 0; x < width_; ++x) score[x] += amplitude * noise[x];
      if (layer.when.empty()) continue;
      const std::uint8_t* when = when_[k].row(y);
      for (std::size_t x = 0; x < width_; ++x) score[x] = when[x] != 0 ? score[x] : -1e30F;
    }
    std::vector<float> left(width_, 1.F);  // of the ground: what painted layers leave
    std::vector<float> top(width_), sum(width_);
    for (int parent = -1; parent < static_cast<int>(count); ++parent) {
      std::vector<std::size_t> siblings;
      for (std::size_t k = 0; k < count; ++k)
        if (layers_.layers[k].parent == parent) siblings.push_back(k);
      if (siblings.empty()) continue;
      std::fill(top.begin(), top.end(), -1e29F);
      std::fill(sum.begin(), sum.end(), 0.F);
      for (const std::size_t k : siblings)
        for (std::size_t x = 0; x < width_; ++x) top[x] = std::max(top[x], scores_[k][x]);
      for (const std::size_t k : siblings)
        for (std::size_t x = 0; x < width_; ++x)
          sum[x] += scores_[k][x] = exp_of(scores_[k][x] - top[x]);
      const float* whole =
          parent < 0 ? nullptr : coverage_[static_cast<std::size_t>(parent)].row(y);
      for (const std::size_t k : siblings) {
        float* share = coverage_[k].row(y);
        for (std::size_t x = 0; x < width_; ++x)
          share[x] =
              sum[x] > 0.F ? scores_[k][x] / sum[x] * (whole != nullptr ? whole[x] : 1.F) : 0.F;
      }
    }
    for (std::size_t k = 0; k < count; ++k)
      if (program_.paints[k])
        for (std::size_t x = 0; x < width_; ++x) left[x] -= coverage_[k](static_cast<int>(x), y);
    // The remainder of the rounded shares is dropped.
    for (float& l : left) l = l > 1e-5F ? l : 0.F;
    for (std::size_t k = 0; k < count; ++k) {
      float* c = coverage_[k].row(y);
      const int p = layers_.layers[k].parent;
      const float* parent = p < 0 ? nullptr : coverage_[static_cast<std::size_t>(p)].row(y);
      for (std::size_t x = 0; x < width_; ++x) {
        const float all = c[x] + left[x];
        if (program_.paints[k]) left[x] = all;
        const float covered = all > 0.F ? c[x] / all : 0.F;
        c[x] = parent != nullptr ? std::min(covered, parent[x]) : covered;
      }
    }
  }

  const LayerProgram& program_;
  const SurfaceLayers& layers_;
  const GeoTransform& transform_;
  PixelRect cells_;
  std::uint64_t seed_;
  std::size_t width_;
  std::vector<const Grid<float>*> inputs_;  // of the program; some are those of raised ground later
  RaisedGround* raised_;                    // null: no bumps
  Grid<float> ground_m_;                    // without bumps
  std::vector<Grid<float>> tilted_;         // inputs of raised ground, as tilted_names
  std::vector<NoiseField> fields_;
  std::vector<int> field_of_;
  std::vector<Grid<std::uint8_t>> when_;
  std::vector<Places> positions_;
  std::vector<bool> used_;
  std::vector<std::vector<float>> scores_;
  std::vector<Grid<float>> coverage_;
};

glm::vec3 encoded(std::uint32_t rgb) {
  return {static_cast<float>(rgb >> 16U & 255U), static_cast<float>(rgb >> 8U & 255U),
          static_cast<float>(rgb & 255U)};
}

}  // namespace

LayerProgram compile_layers(const SurfaceLayers& layers) {
  const std::string where = layers.name.empty() ? "layers" : layers.name;
  check_surface_layers(layers, where);
  LayerProgram program;
  program.layers = layers;
  program.expressions = compile_layer_expressions(layers, where);
  for (const LayerInput& input : layers.inputs) program.inputs.push_back(input.name);
  const std::vector<bool> needed = program.expressions.all_needs();
  for (std::size_t v = 0; v < ground_variables().size(); ++v) {
    const GroundVariable& variable = ground_variables()[v];
    program.input_of_slot.push_back(-1);
    if (v >= needed.size() || !needed[v] || variable.input == LayerInputKind::none) continue;
    const auto found = std::find(program.inputs.begin(), program.inputs.end(), variable.name);
    program.input_of_slot.back() = static_cast<int>(found - program.inputs.begin());
    if (found == program.inputs.end()) program.inputs.emplace_back(variable.name);
  }
  for (const SurfaceLayer& layer : layers.layers) {
    program.table_of.emplace_back(layers.inputs.size(), -1);
    for (std::size_t i = 0; i < layers.inputs.size(); ++i) {
      const auto* samples = std::get_if<LayerSamples>(&layer.functions[i]);
      if (samples == nullptr) continue;
      program.table_of.back()[i] = static_cast<int>(program.tables.size());
      LayerProgram::Table& table = program.tables.emplace_back();
      const auto value = [&](std::size_t s) {
        return samples->at_0 + samples->samples[s] / 255.0 * (samples->at_255 - samples->at_0);
      };
      for (std::size_t s = 0; s < 256; ++s)
        table.samples[s] = {static_cast<float>(value(s)),
                            s < 255 ? static_cast<float>(value(s + 1) - value(s)) : 0.F};
    }
    program.paints.push_back(true);
    if (layer.parent >= 0 && layers.model == LayerModel::additive)
      program.paints[static_cast<std::size_t>(layer.parent)] = false;
  }
  return program;
}

std::vector<Grid<float>> layer_coverage(const LayerProgram& program,
                                        const std::vector<Grid<float>>& inputs,
                                        const GeoTransform& transform, const PixelRect& cells,
                                        std::uint64_t seed, RaisedGround* raised) {
  if (inputs.size() != program.inputs.size())
    throw Error(ErrorKind::bug, "layer_coverage", "the inputs differ from the program's");
  return Evaluation(program, inputs, transform, cells, seed, raised).run();
}

int handed_on(const LayerProgram& program, double cell_m) {
  if (program.layers.model != LayerModel::product) return 0;
  int rough = 0;
  int reach = 0;
  for (std::size_t k = 0; k < program.layers.layers.size(); ++k) {
    const SurfaceLayer& layer = program.layers.layers[k];
    bool reads = !layer.when.empty();
    for (std::size_t i = 0; i < layer.functions.size(); ++i)
      reads = reads || (!std::holds_alternative<std::monostate>(layer.functions[i]) &&
                        std::find(tilted_names.begin(), tilted_names.end(),
                                  program.layers.inputs[i].name) != tilted_names.end());
    if (reads) reach = rough;
    if (is_raised(program, k, cell_m)) ++rough;
  }
  return reach;
}

std::vector<Grid<float>> layer_shares(const LayerProgram& program,
                                      const std::vector<Grid<float>>& coverage) {
  std::vector<Grid<float>> shares(coverage.size() + 1);
  if (coverage.empty()) return shares;
  Grid<float> open(coverage[0].width(), coverage[0].height(),
                   1.F);  // share not covered by upper layers
  for (std::size_t k = coverage.size(); k-- > 0;) {
    shares[k + 1] = Grid<float>(open.width(), open.height());
    if (!program.paints[k]) continue;
    for (std::size_t i = 0; i < open.size(); ++i) {
      shares[k + 1][i] = open[i] * coverage[k][i];
      open[i] *= 1.F - coverage[k][i];
    }
  }
  shares[0] = std::move(open);
  return shares;
}

Grid<glm::vec3> layer_colour(const LayerProgram& program, const std::vector<Grid<float>>& coverage,
                             LayersShown shown) {
  if (coverage.empty()) return {};
  Grid<glm::vec3> colour(coverage[0].width(), coverage[0].height(),
                         encoded(program.layers.ground_rgb));
  for (std::size_t k = 0; k < coverage.size(); ++k) {
    if (!program.paints[k] ||
        (shown == LayersShown::dry && layer_class(program.layers, k) == LandCoverClass::water))
      continue;
    const glm::vec3 own = encoded(program.layers.layers[k].rgb);
    for (std::size_t i = 0; i < colour.size(); ++i) colour[i] += coverage[k][i] * (own - colour[i]);
  }
  return colour;
}

std::vector<Grid<float>> class_shares(const LayerProgram& program,
                                      const std::vector<Grid<float>>& shares) {
  std::vector<Grid<float>> out(static_cast<std::size_t>(land_cover_class_count));
  if (shares.empty() || shares[0].empty()) return out;
  for (Grid<float>& grid : out) grid = Grid<float>(shares[0].width(), shares[0].height());
  const auto add = [&](std::optional<LandCoverClass> id, const Grid<float>& share) {
    Grid<float>& sum = out[static_cast<std::size_t>(id.value_or(LandCoverClass::sky))];
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += share[i];
  };
  add(program.layers.ground_painted_as, shares[0]);
  for (std::size_t k = 0; k + 1 < shares.size(); ++k)
    add(layer_class(program.layers, k), shares[k + 1]);
  return out;
}

std::vector<double> share_outside(const LayerProgram& program,
                                  const std::vector<Grid<float>>& inputs) {
  std::vector<double> out;
  for (std::size_t i = 0; i < program.layers.inputs.size(); ++i) {
    const LayerInput& range = program.layers.inputs[i];
    std::size_t outside = 0;
    for (const float value : inputs[i]) {
      const auto v = static_cast<double>(value);
      outside += v < range.low || v > range.high ? 1U : 0U;
    }
    out.push_back(inputs[i].empty()
                      ? 0.0
                      : static_cast<double>(outside) / static_cast<double>(inputs[i].size()));
  }
  return out;
}

}  // namespace belvedere
