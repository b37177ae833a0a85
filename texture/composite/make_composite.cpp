#include "texture/composite/make_composite.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/config.h"
#include "base/error.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "base/text/text_encoding.h"

namespace belvedere {
namespace {

constexpr int version = 1;
constexpr double code_bits = 24.0;  // from the smallest share, 2^-24, to 1
constexpr double code_steps = 65534.0;

// A share as two bytes: its logarithm in steps of .025 %; 0 is 0.
std::uint16_t encode(float share) {
  if (!(share > 0.F)) return 0;
  const double step =
      1.0 + code_steps * (1.0 + exact::log2(static_cast<double>(share)) / code_bits);
  return static_cast<std::uint16_t>(std::clamp(std::floor(step + .5), 1.0, code_steps + 1.0));
}
float decode(std::uint16_t code) {
  return code == 0 ? 0.F
                   : static_cast<float>(exact::exp2(((code - 1.0) / code_steps - 1.0) * code_bits));
}

std::string shares_text(const std::vector<float>& shares) {
  std::string bytes;
  for (const float share : shares) {
    const std::uint16_t code = encode(share);
    bytes += static_cast<char>(code & 0xffU);
    bytes += static_cast<char>(code >> 8);
  }
  return base64(bytes);
}

constexpr const char* made_by = "a composite written by `belvedere composite learn`";

// As many shares as expected, in tables of `table` values that sum to 1.
std::vector<float> shares_of(const ConfigValue& map, const char* key, const std::string& name,
                             std::size_t count, std::size_t table) {
  const ConfigValue& at = required(map, key, name, made_by);
  const std::optional<std::string> bytes = base64_bytes(as_string(at, name));
  if (!bytes || bytes->size() != 2 * count)
    refuse_value(at, name, fmt::format("\"{}\" is damaged, or has another number of labels", key),
                 "the unchanged text");
  std::vector<float> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto low = static_cast<std::uint8_t>((*bytes)[2 * i]);
    const auto high = static_cast<std::uint8_t>((*bytes)[2 * i + 1]);
    out[i] = decode(static_cast<std::uint16_t>(low | high << 8));
  }
  for (std::size_t first = 0; first < count; first += table) {
    double sum = 0.0;
    for (std::size_t i = 0; i < table; ++i) sum += static_cast<double>(out[first + i]);
    if (!(std::abs(sum - 1.0) < .01))
      refuse_value(at, name, fmt::format("table {} of \"{}\" is damaged", first / table, key),
                   "shares that sum to 1");
  }
  return out;
}

CompositeModel composite_of(const ConfigValue& root, const std::string& name) {
  const ConfigValue* of =
      root.is_table() ? find(as_table(root, name), "belvedere_composite") : nullptr;
  if (of == nullptr)
    throw Error(ErrorKind::usage, name, "not a composite",
                "a file written by `belvedere composite learn`");
  if (const std::int64_t found = as_integer(*of, name); found != version)
    throw Error(ErrorKind::usage, config_where(name, of->position),
                fmt::format("version {} of composites", found), fmt::format("{}", version));
  const ConfigTable& table = as_table(root, name);
  allow_only(table,
             {"belvedere_composite", "crop_size", "crop_hash", "map", "labels", "transition"},
             name);
  CompositeModel out;
  out.crop_hash = as_string(required(root, "crop_hash", name, made_by), name);
  const std::vector<double> sides =
      as_numbers(required(root, "crop_size", name, made_by), name, 2, 1.0, 1 << 20);
  const ConfigValue& list = required(root, "labels", name, made_by);
  for (const ConfigValue& label : as_array(list, name)) {
    allow_only(as_table(label, name), {"name", "model"}, name);
    const std::string& called = as_string(required(label, "name", name, made_by), name);
    if (std::any_of(out.labels.begin(), out.labels.end(),
                    [&](const CompositeLabel& l) { return l.name == called; }))
      refuse_value(label, name, fmt::format("the label {} is given twice", json_quoted(called)),
                   "each label once");
    out.labels.push_back({called, parse_model(required(label, "model", name, made_by), name)});
  }
  if (out.labels.size() < 2 || out.labels.size() > max_labels)
    refuse_value(list, name, fmt::format("{} labels", out.labels.size()),
                 fmt::format("2 to {}", max_labels));
  if (const ConfigValue* transition = find(table, "transition"))
    out.transition = parse_model(*transition, name);

  const std::size_t n = out.labels.size();
  out.map.labels = static_cast<int>(n);
  out.map.crop_width = static_cast<int>(sides[0]);
  out.map.crop_height = static_cast<int>(sides[1]);
  const ConfigValue& map = required(root, "map", name, made_by);
  allow_only(as_table(map, name), {"pairs", "rings", "profile"}, name);
  out.map.pairs =
      shares_of(map, "pairs", name, std::size_t{label_scales} * label_offsets * n * n, n * n);
  out.map.rings =
      shares_of(map, "rings", name, std::size_t{label_scales} * ring_patterns, ring_patterns);
  out.map.profile = shares_of(map, "profile", name, label_strips * n, n);
  return out;
}

}  // namespace

std::string composite_text(const CompositeModel& model) {
  std::string out =
      "# A map of labels and a texture for each; `belvedere composite make` paints with it.\n";
  out += fmt::format("belvedere_composite = {}\n", version);
  out += fmt::format("crop_size = [{}, {}]\ncrop_hash = {}\n", model.map.crop_width,
                     model.map.crop_height, json_quoted(model.crop_hash));
  out +=
      "\n[map]  # shares, two bytes each: pairs of labels, patterns of borders, labels by height\n";
  out += fmt::format("pairs = \"{}\"\nrings = \"{}\"\nprofile = \"{}\"\n",
                     shares_text(model.map.pairs), shares_text(model.map.rings),
                     shares_text(model.map.profile));
  for (const CompositeLabel& label : model.labels)
    out += fmt::format("\n[[labels]]\nname = {}\n[labels.model]\n{}", json_quoted(label.name),
                       model_text(label.model));
  if (model.transition) out += "\n[transition]  # along borders\n" + model_text(*model.transition);
  return out;
}

CompositeModel parse_composite(const std::string& text, const std::string& name) {
  return composite_of(parse_config(text, name), name);
}
CompositeModel read_composite(const std::string& path) {
  return composite_of(read_config(path), path);
}

namespace {

// Colours of a label, in cells of 8 × 8 × 8 levels.
class ColourSet {
 public:
  ColourSet() : known_(cells * cells * cells, 0U) {}

  void add(const Rgb8& colour) {
    Cell& cell = cells_at(colour);
    for (std::size_t c = 0; c < 3; ++c) cell.sum[c] += colour[c];
    ++cell.count;
  }
  // To be called last: selects the cells that count, and their neighbours.
  void finish() {
    constexpr std::uint32_t min = 2;  // pixels of a colour that is not an outlier
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const Cell& cell = sums_[i];
      if (cell.count < min) continue;
      Rgb8 mean{};
      for (std::size_t c = 0; c < 3; ++c)
        mean[c] = static_cast<std::uint8_t>((cell.sum[c] + cell.count / 2) / cell.count);
      means_.push_back(mean);
      for_neighbours(i, [&](std::size_t n) { known_[n] = 1; });
    }
    sums_.clear();
  }
  bool has(const Rgb8& colour) const { return known_[cell_of(colour)] != 0; }
  const std::vector<Rgb8>& colours() const { return means_; }

 private:
  struct Cell {
    std::array<std::uint64_t, 3> sum{};
    std::uint32_t count = 0;
  };
  static constexpr std::size_t cells = 32;

  static std::size_t cell_of(const Rgb8& c) {
    return (static_cast<std::size_t>(c[0]) >> 3) +
           cells * ((static_cast<std::size_t>(c[1]) >> 3) +
                    cells * (static_cast<std::size_t>(c[2]) >> 3));
  }
  Cell& cells_at(const Rgb8& colour) { return sums_[cell_of(colour)]; }
  template <class F>
  static void for_neighbours(std::size_t cell, F&& f) {
    const auto side = static_cast<int>(cells);
    const int x = static_cast<int>(cell % cells);
    const int y = static_cast<int>(cell / cells % cells);
    const int z = static_cast<int>(cell / (cells * cells));
    for (int w = std::max(0, z - 1); w <= std::min(side - 1, z + 1); ++w)
      for (int v = std::max(0, y - 1); v <= std::min(side - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(side - 1, x + 1); ++u)
          f(static_cast<std::size_t>(u + side * (v + side * w)));
  }

  std::vector<Cell> sums_ = std::vector<Cell>(cells * cells * cells);
  std::vector<std::uint8_t> known_;
  std::vector<Rgb8> means_;
};

int distance_squared(const Rgb8& a, const Rgb8& b) {
  int sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += (int{a[c]} - int{b[c]}) * (int{a[c]} - int{b[c]});
  return sum;
}

}  // namespace

void snap_colours(Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels,
                  const Grid<std::uint8_t>& zone, int reach) {
  const int count = 1 + *std::max_element(labels.begin(), labels.end());
  std::vector<ColourSet> sets(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < picture.size(); ++i)
    if (zone[i] == 0) sets[labels[i]].add(picture[i]);
  for (ColourSet& set : sets) set.finish();
  parallel_rows(picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (zone(x, y) == 0) continue;
      std::uint32_t here = 0;
      for (int v = std::max(0, y - reach); v <= std::min(labels.height() - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min(labels.width() - 1, x + reach); ++u)
          here |= 1U << labels(u, v);
      Rgb8& colour = picture(x, y);
      const Rgb8* nearest = nullptr;
      int min = 0;
      bool known = false;
      for (int label = 0; label < count && !known; ++label) {
        if ((here >> label & 1U) == 0) continue;
        const ColourSet& set = sets[static_cast<std::size_t>(label)];
        known = set.has(colour);
        if (known) break;
        for (const Rgb8& c : set.colours())
          if (const int d = distance_squared(c, colour); nearest == nullptr || d < min) {
            nearest = &c;
            min = d;
          }
      }
      if (!known && nearest != nullptr) colour = *nearest;
    }
  });
}

Grid<Rgb8> make_composite(const CompositeModel& model, const Grid<std::uint8_t>& labels,
                          const TextureParameters& parameters, Progress& progress) {
  check_texture_size(labels.width(), labels.height());
  Grid<Rgb8> out(labels.width(), labels.height());
  std::vector<std::uint8_t> there(256, 0U);
  for (const std::uint8_t label : labels) there[label] = 1;
  for (std::size_t label = model.labels.size(); label < there.size(); ++label)
    if (there[label] != 0)
      throw Error(ErrorKind::bug, "make_composite", "a label that is not in the model");
  for (std::size_t label = 0; label < model.labels.size(); ++label) {
    if (there[label] == 0) continue;
    Grid<std::uint8_t> mask(labels.width(), labels.height());
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = labels[i] == label ? 1 : 0;
    const Grid<Rgb8> made =
        make_texture_under(model.labels[label].model, mask, parameters, progress);
    for (std::size_t i = 0; i < mask.size(); ++i)
      if (mask[i] != 0) out[i] = made[i];
  }
  if (!model.transition) return out;
  const Grid<std::uint8_t> zone = near_borders(labels, remade_border_px);
  if (std::none_of(zone.begin(), zone.end(), [](std::uint8_t z) { return z != 0; })) return out;
  out = fill_texture(out, zone, *model.transition, of_seam(parameters), progress);
  snap_colours(out, labels, zone, remade_border_px);
  return out;
}

namespace {

// The paint of a rectangle of the map, each label under its mask, before borders are repainted.
Grid<Rgb8> fill_labels(const CompositeModel& model, const CompositeRecord& record,
                       const Grid<std::uint8_t>& labels, PixelRect rect,
                       const TextureParameters& parameters) {
  Grid<Rgb8> out(labels.width(), labels.height());
  for (std::size_t label = 0; label < model.labels.size(); ++label) {
    PixelRect box{labels.width(), labels.height(), 0, 0};
    for (int y = 0; y < labels.height(); ++y)
      for (int x = 0; x < labels.width(); ++x)
        if (labels(x, y) == label)
          box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
                 std::max(box.y1, y + 1)};
    if (box.empty()) continue;
    const PixelRect asked = grown(moved(box, rect.x0, rect.y0), endless_margin_px);
    const TexturePiece piece =
        make_piece(model.labels[label].model, record.labels[label], asked, parameters);
    for (int y = box.y0; y < box.y1; ++y)
      for (int x = box.x0; x < box.x1; ++x)
        if (labels(x, y) == label)
          out(x, y) = piece.picture(rect.x0 + x - piece.piece.x0, rect.y0 + y - piece.piece.y0);
  }
  return out;
}

}  // namespace

CompositeRecord record_composite(const CompositeModel& model, const TextureParameters& parameters,
                                 Progress& progress) {
  CompositeRecord record;
  progress.begin("preparing textures", static_cast<double>(model.labels.size()));
  for (const CompositeLabel& label : model.labels) {
    record.labels.push_back(record_texture(label.model, parameters));
    progress.advance(1.0);
  }
  return record;
}

Grid<Rgb8> make_composite_window(const CompositeModel& model, const CompositeRecord& record,
                                 const Grid<std::uint8_t>& labels, PixelRect window,
                                 const TextureParameters& parameters, Progress& progress,
                                 TexturePosition at) {
  check_texture_size(window.width(), window.height());
  const PixelRect map = moved({0, 0, labels.width(), labels.height()}, at.x, at.y);
  if (intersection(window, map) != window)
    throw Error(ErrorKind::usage, "the window", "it extends beyond the map", "a part of the map");
  for (const std::uint8_t label : labels)
    if (label >= model.labels.size())
      throw Error(ErrorKind::bug, "make_composite_window", "a label that is not in the model");
  const PixelRect tiles{tile_below(window.x0), tile_below(window.y0), tile_below(window.x1 - 1) + 1,
                        tile_below(window.y1 - 1) + 1};
  progress.begin("making a window", static_cast<double>(tiles.width()) * tiles.height());
  Grid<Rgb8> out(window.width(), window.height());
  for (int ty = tiles.y0; ty < tiles.y1; ++ty)
    for (int tx = tiles.x0; tx < tiles.x1; ++tx) {
      const PixelRect tile = {tx * endless_tile_px, ty * endless_tile_px,
                              (tx + 1) * endless_tile_px, (ty + 1) * endless_tile_px};
      const PixelRect around = intersection(grown(tile, composite_margin_px), map);
      const Grid<std::uint8_t> own = part_of(labels, moved(around, -at.x, -at.y));
      Grid<Rgb8> made = fill_labels(model, record, own, around, parameters);
      const Grid<std::uint8_t> zone = near_borders(own, remade_border_px);
      if (model.transition &&
          std::any_of(zone.begin(), zone.end(), [](std::uint8_t z) { return z != 0; })) {
        const Grid<std::uint8_t> all(around.width(), around.height(), 1);
        made = fill_among(made, zone, all, {around.x0, around.y0}, *model.transition,
                          of_seam(parameters));
        snap_colours(made, own, zone, remade_border_px);
      }
      const PixelRect part = intersection(tile, window);
      for (int y = part.y0; y < part.y1; ++y)
        std::copy_n(made.row(y - around.y0) + (part.x0 - around.x0), part.width(),
                    out.row(y - window.y0) + (part.x0 - window.x0));
      progress.advance(1.0);
    }
  return out;
}

}  // namespace belvedere
