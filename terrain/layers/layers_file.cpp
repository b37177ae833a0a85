#include "terrain/layers/layers_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/config.h"
#include "base/error.h"
#include "base/text/config_reader.h"
#include "base/text/json.h"
#include "base/text/text_encoding.h"
#include "terrain/cover/ground_variables.h"
#include "terrain/cover/layer_inputs.h"

namespace belvedere {
namespace {

std::string to_base64(const std::uint8_t* bytes, std::size_t count) {
  return base64({reinterpret_cast<const char*>(bytes), count});
}

// 2…256 bytes; nothing for malformed text.
std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text) {
  const std::optional<std::string> bytes = text.size() > 344 ? std::nullopt : base64_bytes(text);
  if (!bytes || bytes->size() < 2 || bytes->size() > 256) return std::nullopt;
  return std::vector<std::uint8_t>(bytes->begin(), bytes->end());
}

// Properties that only surface layers have.
struct Reader : LayersReader {
  std::uint32_t colour(const ConfigValue& value) const {
    const std::string& text = as_string(value, where);
    as_colour(value, where);
    return static_cast<std::uint32_t>(std::stoul(text.substr(1), nullptr, 16));
  }

  LayerInput input(const ConfigValue& value) const {
    allow_only(as_table(value, where), {"name", "low", "high"}, where);
    const auto get = [&](const char* key) -> const ConfigValue& {
      return required(value, key, where, "an input's name, low and high");
    };
    const ConfigValue& name = get("name");
    require_layer_input(as_string(name, where), config_where(where, name.position));
    LayerInput read{as_string(name, where), as_number(get("low"), where),
                    as_number(get("high"), where)};
    if (!(read.low < read.high))
      fail(value.position, fmt::format("{} from {} to {}", read.name, read.low, read.high),
           "low < high");
    return read;
  }

  LayerFunction function(const ConfigValue& value, LayerModel model) const {
    const ConfigTable& table = as_table(value, where);
    if (const ConfigValue* values = find(table, "values")) return numbers(*values, table, model);
    const ConfigValue* samples = find(table, "samples");
    if (samples == nullptr) {
      allow_only(table, {"low", "high", "width", "low_width", "high_width"}, where);
      constexpr double far = std::numeric_limits<double>::infinity();
      const double width = number_or(table, "width", 0.0);
      const LayerHat hat{number_or(table, "low", -far), number_or(table, "high", far),
                         number_or(table, "low_width", width),
                         number_or(table, "high_width", width)};
      if (!(hat.low <= hat.high))
        fail(value.position, fmt::format("function from {} to {}", hat.low, hat.high),
             "low ≤ high");
      if (!(hat.low_width >= 0.0) || !(hat.high_width >= 0.0))
        fail(value.position, "negative width", "0 or more");
      return hat;
    }
    allow_only(table, {"samples", "from", "to"}, where);
    LayerSamples read{number_or(table, "from", 0.0), number_or(table, "to", 1.0), {}, {}};
    if (model == LayerModel::product &&
        (std::min(read.at_0, read.at_255) < 0.0 || std::max(read.at_0, read.at_255) > 1.0))
      fail(value.position, fmt::format("samples from {} to {}", read.at_0, read.at_255),
           "0…1 in a product");
    const auto bytes = from_base64(as_string(*samples, where));
    if (!bytes)
      fail(samples->position, "samples are not bytes in base64",
           "2 … 256 bytes, as 4 … 344 characters");
    if (bytes->size() == 256) {
      std::copy(bytes->begin(), bytes->end(), read.samples.begin());
    } else {
      read.samples = samples_of_knots(*bytes);
      read.knots = *bytes;
    }
    return read;
  }

  // Values as plain numbers; in a file they are bytes between `from` and `to`.
  LayerSamples numbers(const ConfigValue& value, const ConfigTable& table, LayerModel model) const {
    allow_only(table, {"values", "from", "to"}, where);
    const ConfigArray& array = as_array(value, where);
    std::vector<double> values;
    values.reserve(array.size());
    for (const ConfigValue& number : array) values.push_back(as_number(number, where));
    if (values.size() < 2 || values.size() > 256)
      fail(value.position, fmt::format("{} values", values.size()), "2 … 256 numbers");
    if (!std::all_of(values.begin(), values.end(), [](double v) { return std::abs(v) < 1e9; }))
      fail(value.position, "values beyond ±1e9", "smaller numbers");
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const bool product = model == LayerModel::product;
    const double from = number_or(table, "from", product ? 0.0 : *low);
    const double to = number_or(table, "to", product ? 1.0 : *high);
    if (!std::isfinite(to - from)) fail(value.position, "bounds that are not finite", "numbers");
    const double least = std::min(from, to);
    const double most = std::max(from, to);
    if (product && (least < 0.0 || most > 1.0))
      fail(value.position, fmt::format("values from {} to {}", from, to), "0…1 in a product");
    const double step = (most - least) / 255.0;  // numbers may be rounded
    if (!(*low >= least - step) || !(*high <= most + step))
      fail(value.position, fmt::format("values from {} to {}", *low, *high),
           fmt::format("{}…{}", least, most));
    std::vector<std::uint8_t> bytes;
    bytes.reserve(values.size());
    for (const double v : values)
      bytes.push_back(static_cast<std::uint8_t>(
          most > least ? std::floor(255.0 * std::clamp((v - from) / (to - from), 0.0, 1.0) + 0.5)
                       : 0.0));
    LayerSamples read{from, to, samples_of_knots(bytes), {}};
    read.knots = std::move(bytes);
    return read;
  }

  LayerNoise noise(const ConfigValue& value) const {
    const ConfigTable& table = as_table(value, where);
    allow_only(table, {"scale_m", "octaves", "gain", "amplitude", "bias"}, where);
    LayerNoise read;
    read.scale_m = number_or(table, "scale_m", read.scale_m);
    if (const ConfigValue* octaves = find(table, "octaves")) {
      const std::int64_t count = as_integer(*octaves, where);
      if (count < 1 || count > 12) fail(octaves->position, describe(*octaves), "1…12");
      read.octaves = static_cast<int>(count);
    }
    read.amplitude = number_or(table, "amplitude", read.amplitude);
    read.bias = number_or(table, "bias", read.bias);
    read.gain = number_or(table, "gain", read.gain);
    if (!(read.scale_m > 0.0))
      fail(value.position, fmt::format("noise of {} m", read.scale_m), "more than 0 m");
    return read;
  }
};

// A layer as in the file, before parents are resolved.
struct ReadLayer {
  SurfaceLayer layer;
  std::string parent;  // empty: the ground
  ConfigPosition position, parent_place, when_place;
};

ReadLayer read_layer(const Reader& reader, const ConfigValue& value, const SurfaceLayers& file) {
  const ConfigTable& table = as_table(value, reader.where);
  allow_only(table,
             {"name", "parent", "class", "colour", "roughness", "noise", "functions", "when"},
             reader.where);
  ReadLayer read;
  read.position = value.position;
  read.layer.name =
      as_string(required(value, "name", reader.where, "a name of the layer"), reader.where);
  if (read.layer.name.empty()) reader.fail(value.position, "layer with an empty name", "a name");
  if (const ConfigValue* parent = find(table, "parent")) {
    read.parent = as_string(*parent, reader.where);
    read.parent_place = parent->position;
  }
  if (const ConfigValue* painted = find(table, "class"))
    read.layer.painted_as = as_ground_class(*painted, reader.where);
  if (const ConfigValue* colour = find(table, "colour")) {
    read.layer.rgb = reader.colour(*colour);
  } else if (read.layer.painted_as) {
    read.layer.rgb = class_info(*read.layer.painted_as).rgb;
  }
  if (const ConfigValue* roughness = find(table, "roughness")) {
    const ConfigTable& of = as_table(*roughness, reader.where);
    allow_only(of, {"height_m", "length_m"}, reader.where);
    read.layer.roughness_m = reader.number_or(of, "height_m", read.layer.roughness_m);
    read.layer.roughness_scale_m = reader.number_or(of, "length_m", read.layer.roughness_scale_m);
    if (!(read.layer.roughness_m >= 0.0) || !(read.layer.roughness_scale_m > 0.0))
      reader.fail(roughness->position,
                  fmt::format("roughness with height {} m and length {} m", read.layer.roughness_m,
                              read.layer.roughness_scale_m),
                  "a height of 0 m or more, a length above 0 m");
  }
  if (const ConfigValue* noise = find(table, "noise")) read.layer.noise = reader.noise(*noise);
  read.layer.functions.resize(file.inputs.size());
  if (const ConfigValue* functions = find(table, "functions"))
    for (const ConfigEntry& entry : as_table(*functions, reader.where)) {
      const auto input = std::find_if(file.inputs.begin(), file.inputs.end(),
                                      [&](const LayerInput& i) { return i.name == entry.key; });
      if (input == file.inputs.end()) {
        std::vector<std::string> known;
        for (const LayerInput& i : file.inputs) known.push_back(i.name);
        reader.fail_unknown(entry.key_position, "input of this file", entry.key, known);
      }
      read.layer.functions[static_cast<std::size_t>(input - file.inputs.begin())] =
          reader.function(entry.value, file.model);
    }
  if (const ConfigValue* when = find(table, "when")) {
    read.layer.when = reader.expression(*when);
    read.when_place = when->position;
  }
  return read;
}

// The layers depth first, siblings in the order of the file, with their parents; and the positions
// of their expressions.
void order_layers(const Reader& reader, const std::vector<ReadLayer>& read, SurfaceLayers& file,
                  std::vector<ConfigPosition>& when_places) {
  std::vector<std::string> names;
  for (const ReadLayer& layer : read) {
    if (std::find(names.begin(), names.end(), layer.layer.name) != names.end())
      reader.fail(layer.position, "second layer named \"" + layer.layer.name + "\"",
                  "unique names");
    names.push_back(layer.layer.name);
  }
  std::vector<int> parents;
  for (const ReadLayer& layer : read) {
    const auto found = std::find(names.begin(), names.end(), layer.parent);
    if (!layer.parent.empty() && found == names.end())
      reader.fail_unknown(layer.parent_place, "layer", layer.parent, names);
    parents.push_back(layer.parent.empty() ? -1 : static_cast<int>(found - names.begin()));
  }
  // Children last in, first out: a stack of pending layers keeps depth first without recursion.
  std::vector<std::pair<int, int>> open;  // layer of the file, its parent in the result
  const auto push_children = [&](int of, int at) {
    for (int i = static_cast<int>(read.size()) - 1; i >= 0; --i)
      if (parents[static_cast<std::size_t>(i)] == of) open.emplace_back(i, at);
  };
  std::vector<bool> reached(read.size(), false);
  push_children(-1, -1);
  while (!open.empty()) {
    const auto [from, parent] = open.back();
    open.pop_back();
    const ReadLayer& layer = read[static_cast<std::size_t>(from)];
    reached[static_cast<std::size_t>(from)] = true;
    file.layers.push_back(layer.layer);
    file.layers.back().parent = parent;
    when_places.push_back(layer.when_place);
    push_children(from, static_cast<int>(file.layers.size()) - 1);
  }
  for (std::size_t i = 0; i < read.size(); ++i) {
    if (reached[i]) continue;
    // Follow parents until a layer repeats: that one is in the cycle, not only under it.
    std::vector<bool> seen(read.size(), false);
    std::size_t at = i;
    while (!seen[at]) {
      seen[at] = true;
      at = static_cast<std::size_t>(parents[at]);
    }
    std::string circle = read[at].layer.name;
    std::size_t next = at;
    do {
      next = static_cast<std::size_t>(parents[next]);
      circle += " → " + read[next].layer.name;
    } while (next != at);
    reader.fail(read[at].parent_place, "layer is its own ancestor: " + circle,
                "parents that lead to the ground");
  }
}

std::string coloured(std::uint32_t rgb) { return fmt::format("\"#{:06x}\"", rgb & 0xffffffU); }

// The bytes of a function as the numbers that they mean, with as many digits as tell them apart.
std::string plain_numbers(const LayerSamples& samples) {
  const double step = (samples.at_255 - samples.at_0) / 255.0;
  int digits = 0;
  double smallest = 1.0;
  while (smallest > 0.5 * std::abs(step)) {
    smallest *= 0.1;
    ++digits;
  }
  std::vector<std::string> numbers;
  for (const std::uint8_t byte : samples.knots) {
    std::string text = fmt::format("{:.{}f}", samples.at_0 + step * byte, digits);
    if (digits > 0) {
      text.resize(text.find_last_not_of('0') + 1);
      if (text.back() == '.') text.pop_back();
    }
    numbers.push_back(std::move(text));
  }
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

std::string function_text(const LayerFunction& function) {
  if (const auto* hat = std::get_if<LayerHat>(&function)) {
    std::vector<std::string> parts;
    if (std::isfinite(hat->low)) parts.push_back(fmt::format("low = {}", hat->low));
    if (std::isfinite(hat->high)) parts.push_back(fmt::format("high = {}", hat->high));
    if (hat->low_width == hat->high_width) {
      if (hat->low_width != 0.0) parts.push_back(fmt::format("width = {}", hat->low_width));
    } else {
      parts.push_back(
          fmt::format("low_width = {}, high_width = {}", hat->low_width, hat->high_width));
    }
    return fmt::format("{{ {} }}", fmt::join(parts, ", "));
  }
  const auto& samples = std::get<LayerSamples>(function);
  const std::string range = samples.at_0 == 0.0 && samples.at_255 == 1.0
                                ? ""
                                : fmt::format("from = {}, to = {}, ", samples.at_0, samples.at_255);
  // Bytes whose numbers would not tell them apart stay bytes.
  const double step = std::abs(samples.at_255 - samples.at_0) / 255.0;
  const double largest = std::max(std::abs(samples.at_255), std::abs(samples.at_0));
  if (!samples.knots.empty() && step > 1e-9 * std::max(largest, 1.0) && largest < 1e9)
    return fmt::format("{{ {}values = {} }}", range, plain_numbers(samples));
  return fmt::format("{{ {}samples = \"{}\" }}", range,
                     samples.knots.empty()
                         ? to_base64(samples.samples.data(), samples.samples.size())
                         : to_base64(samples.knots.data(), samples.knots.size()));
}

std::string layer_text(const SurfaceLayers& file, const SurfaceLayer& layer) {
  std::string out = fmt::format("\n[[layers]]\nname = {}\n", json_quoted(layer.name));
  if (layer.parent >= 0)
    out += fmt::format("parent = {}\n",
                       json_quoted(file.layers[static_cast<std::size_t>(layer.parent)].name));
  if (layer.painted_as) out += fmt::format("class = \"{}\"\n", class_name(*layer.painted_as));
  out += fmt::format("colour = {}\n", coloured(layer.rgb));
  const SurfaceLayer usual;
  if (layer.roughness_m != usual.roughness_m || layer.roughness_scale_m != usual.roughness_scale_m)
    out += fmt::format("roughness = {{ height_m = {}, length_m = {} }}\n", layer.roughness_m,
                       layer.roughness_scale_m);
  const LayerNoise& n = layer.noise;
  if (n.scale_m != usual.noise.scale_m || n.octaves != usual.noise.octaves ||
      n.amplitude != usual.noise.amplitude || n.bias != usual.noise.bias ||
      n.gain != usual.noise.gain)
    out += fmt::format("noise = {{ scale_m = {}, octaves = {}, {}amplitude = {}, bias = {} }}\n",
                       n.scale_m, n.octaves,
                       n.gain != usual.noise.gain ? fmt::format("gain = {}, ", n.gain) : "",
                       n.amplitude, n.bias);
  if (!layer.when.empty()) out += fmt::format("when = {}\n", json_quoted(layer.when));
  bool first = true;
  for (std::size_t i = 0; i < layer.functions.size(); ++i) {
    if (std::holds_alternative<std::monostate>(layer.functions[i])) continue;
    if (first) out += "[layers.functions]\n";
    first = false;
    out += fmt::format("{} = {}\n", file.inputs[i].name, function_text(layer.functions[i]));
  }
  return out;
}

SurfaceLayers read_document(const ConfigValue& document, const std::string& where) {
  const Reader reader{{where}};
  const LayersDocument common =
      read_layers_document(reader, document, {"model", "ground", "inputs"});
  const ConfigTable& root = as_table(document, where);
  SurfaceLayers file;
  file.name = common.name;
  file.parameters = common.parameters;
  file.terms = common.terms;
  RulePlaces positions;
  positions.terms = common.term_places;
  if (const ConfigValue* model = find(root, "model")) {
    const std::string& word = as_string(*model, where);
    if (word != "product" && word != "additive")
      reader.fail_unknown(model->position, "model", word, {"product", "additive"});
    file.model = word == "product" ? LayerModel::product : LayerModel::additive;
  }
  if (const ConfigValue* ground = find(root, "ground")) {
    const ConfigTable& of = as_table(*ground, where);
    allow_only(of, {"colour", "class"}, where);
    if (const ConfigValue* painted = find(of, "class")) {
      file.ground_painted_as = as_ground_class(*painted, where);
      file.ground_rgb = class_info(*file.ground_painted_as).rgb;
    }
    if (const ConfigValue* colour = find(of, "colour")) file.ground_rgb = reader.colour(*colour);
  }
  if (const ConfigValue* inputs = find(root, "inputs"))
    for (const ConfigValue& value : as_array(*inputs, where)) {
      LayerInput input = reader.input(value);
      for (const LayerInput& other : file.inputs)
        if (other.name == input.name)
          reader.fail(value.position, "the input \"" + input.name + "\" is repeated",
                      "each input once");
      file.inputs.push_back(std::move(input));
    }
  std::vector<ReadLayer> read;
  for (const ConfigValue& value : layers_of(reader, document))
    read.push_back(read_layer(reader, value, file));
  order_layers(reader, read, file, positions.conditions);
  compile_layer_expressions(file, where, positions);
  check_surface_layers(file, where);
  return file;
}

}  // namespace

SurfaceLayers parse_surface_layers(std::string_view text, const std::string& where) {
  return read_document(parse_config(text, where), where);
}

SurfaceLayers read_surface_layers(const std::string& path) {
  return read_document(read_config(path), path);
}

std::string surface_layers_text(const SurfaceLayers& layers) {
  check_surface_layers(layers, layers.name.empty() ? "layers" : layers.name);
  std::string out =
      "# Surface layers: what covers the ground, said by what is known of each place "
      "(docs/layers.md).\nversion = 1\n";
  if (!layers.name.empty()) out += fmt::format("name = {}\n", json_quoted(layers.name));
  out +=
      fmt::format("model = \"{}\"\n", layers.model == LayerModel::product ? "product" : "additive");
  out += layers.ground_painted_as
             ? fmt::format("ground = {{ class = \"{}\", colour = {} }}\n",
                           class_name(*layers.ground_painted_as), coloured(layers.ground_rgb))
             : fmt::format("ground = {{ colour = {} }}\n", coloured(layers.ground_rgb));
  if (layers.layers.empty()) out += "layers = []\n";
  for (const LayerInput& input : layers.inputs)
    out += fmt::format("\n[[inputs]]\nname = \"{}\"\nlow = {}\nhigh = {}\n", input.name, input.low,
                       input.high);
  if (!layers.parameters.empty()) out += "\n[parameters]\n";
  for (const auto& [name, value] : layers.parameters) out += fmt::format("{} = {}\n", name, value);
  if (!layers.terms.empty()) out += "\n[terms]\n";
  for (const auto& [name, text] : layers.terms)
    out += fmt::format("{} = {}\n", name, json_quoted(text));
  for (const SurfaceLayer& layer : layers.layers) out += layer_text(layers, layer);
  return out;
}

}  // namespace belvedere
