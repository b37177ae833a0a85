#include "terrain/layers/layers_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

constexpr char head[] = "version = 1\n[[inputs]]\nname = \"altitude\"\nlow = 0\nhigh = 4000\n";

void expect_fault(const std::string& text, const std::string& position, const std::string& found) {
  const Error error = test::error_of([&] { parse_surface_layers(text, "x.toml"); });
  EXPECT_EQ(error.kind(), ErrorKind::usage);
  EXPECT_EQ(error.where(), position);
  EXPECT_THAT(error.found(), HasSubstr(found));
}

// Every kind of function, both widths, names that need escapes, numbers with all their bits.
SurfaceLayers rich() {
  SurfaceLayers layers;
  layers.name = "a \"rich\" file \\ with\ttabs";
  layers.ground_rgb = 0x123456;
  layers.ground_painted_as = LandCoverClass::rock;
  layers.inputs = {{"altitude", 1.0 / 3.0, 3812.7}, {"slope", 0.0, 61.25}, {"rain", 400.0, 1e4}};
  layers.parameters = {{"treeline_m", 1800.1}, {"small", 1e-9}};
  layers.terms = {{"high", "altitude - treeline_m + 100 * n210"}};
  LayerSamples samples;
  for (std::size_t i = 0; i < 256; ++i)
    samples.samples[i] = static_cast<std::uint8_t>(random_bits(3, static_cast<std::int64_t>(i), 0));
  SurfaceLayer grass;
  grass.name = "grass";
  grass.painted_as = LandCoverClass::alpine_grass;
  grass.rgb = 0x00ff07;
  grass.roughness_m = 0.25;
  grass.roughness_scale_m = 2.0;
  grass.noise = {120.5, 7, 0.1, 0.7, 0.85};
  grass.functions = {LayerHat{100.0, 2500.0, 20.0, 200.0}, samples, {}};
  SurfaceLayer dry = grass;
  dry.name = "dry";
  dry.parent = 0;
  dry.painted_as.reset();
  dry.when = "high > small";
  dry.functions = {{},
                   LayerHat{-std::numeric_limits<double>::infinity(), 30.0, 3.0, 3.0},
                   LayerHat{1.0, 2.0, 0.0, 0.0}};
  samples.at_0 = 0.125;
  samples.at_255 = 1.0 / 7.0;
  SurfaceLayer snow;
  snow.name = "snow";
  snow.functions = {samples, {}, {}};
  layers.layers = {grass, dry, snow};
  return layers;
}

void expect_equal(const SurfaceLayers& a, const SurfaceLayers& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.model, b.model);
  EXPECT_EQ(a.ground_rgb, b.ground_rgb);
  EXPECT_EQ(a.ground_painted_as, b.ground_painted_as);
  EXPECT_EQ(a.parameters, b.parameters);
  EXPECT_EQ(a.terms, b.terms);
  ASSERT_EQ(a.inputs.size(), b.inputs.size());
  for (std::size_t i = 0; i < a.inputs.size(); ++i) {
    EXPECT_EQ(a.inputs[i].name, b.inputs[i].name);
    EXPECT_EQ(a.inputs[i].low, b.inputs[i].low);
    EXPECT_EQ(a.inputs[i].high, b.inputs[i].high);
  }
  ASSERT_EQ(a.layers.size(), b.layers.size());
  for (std::size_t k = 0; k < a.layers.size(); ++k) {
    const SurfaceLayer& p = a.layers[k];
    const SurfaceLayer& q = b.layers[k];
    SCOPED_TRACE(p.name);
    EXPECT_EQ(p.name, q.name);
    EXPECT_EQ(p.parent, q.parent);
    EXPECT_EQ(p.painted_as, q.painted_as);
    EXPECT_EQ(p.rgb, q.rgb);
    EXPECT_EQ(p.roughness_m, q.roughness_m);
    EXPECT_EQ(p.roughness_scale_m, q.roughness_scale_m);
    EXPECT_EQ(p.noise.scale_m, q.noise.scale_m);
    EXPECT_EQ(p.noise.octaves, q.noise.octaves);
    EXPECT_EQ(p.noise.amplitude, q.noise.amplitude);
    EXPECT_EQ(p.noise.bias, q.noise.bias);
    EXPECT_EQ(p.noise.gain, q.noise.gain);
    EXPECT_EQ(p.when, q.when);
    ASSERT_EQ(p.functions.size(), q.functions.size());
    for (std::size_t i = 0; i < p.functions.size(); ++i) {
      ASSERT_EQ(p.functions[i].index(), q.functions[i].index());
      if (const auto* hat = std::get_if<LayerHat>(&p.functions[i])) {
        const auto& other = std::get<LayerHat>(q.functions[i]);
        EXPECT_EQ(hat->low, other.low);
        EXPECT_EQ(hat->high, other.high);
        EXPECT_EQ(hat->low_width, other.low_width);
        EXPECT_EQ(hat->high_width, other.high_width);
      } else if (const auto* samples = std::get_if<LayerSamples>(&p.functions[i])) {
        const auto& other = std::get<LayerSamples>(q.functions[i]);
        EXPECT_EQ(samples->at_0, other.at_0);
        EXPECT_EQ(samples->at_255, other.at_255);
        EXPECT_EQ(samples->samples, other.samples);
        EXPECT_EQ(samples->knots, other.knots);
      }
    }
  }
}

TEST(LayersFile, ReadsBackWhatItWrites) {
  const SurfaceLayers layers = rich();
  const std::string text = surface_layers_text(layers);
  const SurfaceLayers back = parse_surface_layers(text, "x.toml");
  expect_equal(layers, back);
  EXPECT_EQ(surface_layers_text(back), text);
  SurfaceLayers additive = layers;
  additive.model = LayerModel::additive;
  std::get<LayerSamples>(additive.layers[0].functions[1]).at_0 = -7.5;
  expect_equal(additive, parse_surface_layers(surface_layers_text(additive), "x.toml"));
}

// 256 bytes of 0, 1, 2 … by another program (Python's base64 begins AAECAwQF and ends +/w==).
TEST(LayersFile, SamplesAreBase64) {
  SurfaceLayers layers;
  layers.inputs = {{"slope", 0.0, 90.0}};
  LayerSamples ramp;
  for (std::size_t i = 0; i < 256; ++i) ramp.samples[i] = static_cast<std::uint8_t>(i);
  layers.layers.resize(1);
  layers.layers[0].name = "ramp";
  layers.layers[0].functions = {ramp};
  const std::string text = surface_layers_text(layers);
  EXPECT_THAT(text, HasSubstr("samples = \"AAECAwQFBgcICQoLDA0ODxAREhMUFRYXGBkaGxwdHh8gISIjJCUm"));
  EXPECT_THAT(text, HasSubstr("8PHy8/T19vf4+fr7/P3+/w==\""));
}

// Functions of few values are plain numbers in the unit of the function.
TEST(LayersFile, KnotsArePlainNumbers) {
  const auto read = [](const std::string& model, const std::string& function) {
    return parse_surface_layers("version = 1\nmodel = \"" + model +
                                    "\"\n[[inputs]]\nname = \"slope\"\nlow = 0\nhigh = 90\n" +
                                    "[[layers]]\nname = \"a\"\nfunctions = { slope = " + function +
                                    " }\n",
                                "x.toml");
  };
  const SurfaceLayers hill = read("product", "{ values = [0, 0.5, 1, 0.25] }");
  for (const auto& [slope, value] :
       {std::pair{45.0, 0.75}, {30.0, 0.5}, {15.0, 0.25}, {75.0, 0.625}})
    EXPECT_NEAR(
        layer_function_value(hill.layers[0].functions[0], hill.inputs[0], hill.model, slope), value,
        0.005)
        << slope;
  EXPECT_THAT(surface_layers_text(hill), HasSubstr("values = [0, 0.502, 1, 0.251]"));
  const SurfaceLayers sum = read("additive", "{ values = [-2, 1.5, 3] }");
  EXPECT_NEAR(layer_function_value(sum.layers[0].functions[0], sum.inputs[0], sum.model, 45.0), 1.5,
              0.02);
  const std::string text = surface_layers_text(sum);
  EXPECT_THAT(text, HasSubstr("from = -2, to = 3, values = [-2, 1.5"));
  EXPECT_EQ(surface_layers_text(parse_surface_layers(text, "x.toml")), text);
  // Numbers that are rounded beyond their bounds read back.
  SurfaceLayers rounded = sum;
  std::get<LayerSamples>(rounded.layers[0].functions[0]).at_255 = 7.2176;
  const SurfaceLayers again = parse_surface_layers(surface_layers_text(rounded), "x.toml");
  EXPECT_EQ(std::get<LayerSamples>(again.layers[0].functions[0]).knots,
            std::get<LayerSamples>(sum.layers[0].functions[0]).knots);
  EXPECT_THROW(read("product", "{ values = [0, 1.5] }"), Error);
  EXPECT_THROW(read("product", "{ values = [1] }"), Error);
  EXPECT_THROW(read("product", "{ values = [0, 1], samples = \"AP8=\" }"), Error);
}

// Fewer values lie at even distances from end to end, with straight lines between them.
TEST(LayersFile, FewKnotsSayAllSamples) {
  // 0 and 255: Python's base64 of those two bytes.
  const std::string ramp =
      std::string(head) +
      "[[layers]]\nname = \"a\"\nfunctions = { altitude = { samples = \"AP8=\" } }\n";
  const SurfaceLayers two = parse_surface_layers(ramp, "x.toml");
  const auto& samples = std::get<LayerSamples>(two.layers[0].functions[0]);
  EXPECT_EQ(samples.knots, (std::vector<std::uint8_t>{0, 255}));
  for (int i = 0; i < 256; ++i)
    EXPECT_NEAR(samples.samples[static_cast<std::size_t>(i)], 255.0 * layer_sample_place(i), 0.5)
        << i;
  for (const std::size_t count : {2U, 3U, 4U, 31U, 32U, 33U, 255U}) {
    LayerSamples function;
    for (std::size_t j = 0; j < count; ++j)
      function.knots.push_back(static_cast<std::uint8_t>(
          random_bits(4, static_cast<std::int64_t>(j), static_cast<std::int64_t>(count))));
    function.samples = samples_of_knots(function.knots);
    SurfaceLayers layers = two;
    layers.layers[0].functions[0] = function;
    const std::string text = surface_layers_text(layers);
    const auto read =
        std::get<LayerSamples>(parse_surface_layers(text, "x.toml").layers[0].functions[0]);
    EXPECT_EQ(read.knots, function.knots) << count;
    EXPECT_EQ(read.samples, function.samples) << count;
    // Halfway between two knots samples are on the line: exact in whole numbers.
    for (int i = 0; i < 256; ++i) {
      const double at = layer_sample_place(i) * static_cast<double>(count - 1);
      const auto first = static_cast<std::size_t>(at);
      const double low = function.knots[first];
      const double high = function.knots[std::min(first + 1, count - 1)];
      ASSERT_NEAR(function.samples[static_cast<std::size_t>(i)],
                  low + (at - static_cast<double>(first)) * (high - low), 0.5001);
    }
  }
}

TEST(LayersFile, OrdersLayersDepthFirst) {
  const SurfaceLayers layers = parse_surface_layers(
      "version = "
      "1\n[[layers]]\nname=\"c\"\nparent=\"b\"\n[[layers]]\nname=\"a\"\n[[layers]]\nname=\"b\"\n[["
      "layers]]\nname=\"d\"\nparent=\"a\"\n",
      "x.toml");
  ASSERT_EQ(layers.layers.size(), 4U);
  EXPECT_EQ(layers.layers[0].name, "a");
  EXPECT_EQ(layers.layers[1].name, "d");
  EXPECT_EQ(layers.layers[1].parent, 0);
  EXPECT_EQ(layers.layers[2].name, "b");
  EXPECT_EQ(layers.layers[3].name, "c");
  EXPECT_EQ(layers.layers[3].parent, 2);
}

TEST(LayersFile, FaultsNameTheirPlace) {
  expect_fault(
      "version = "
      "1\n[[layers]]\nname=\"a\"\nparent=\"b\"\n[[layers]]\nname=\"b\"\nparent=\"a\"\n[[layers]]"
      "\nname=\"c\"\nparent=\"a\"\n",
      "x.toml:4:8", "own ancestor: a → b → a");
  expect_fault("version = 1\n[[layers]]\nname=\"a\"\nparent=\"gras\"\n[[layers]]\nname=\"grass\"\n",
               "x.toml:4:8", "did you mean \"grass\"");
  expect_fault("version = 1\n[[layers]]\nname=\"a\"\nclass = \"forrest\"\n", "x.toml:4:9",
               "did you mean \"forest\"");
  expect_fault("version = 1\n[[inputs]]\nname = \"altitud\"\nlow = 0\nhigh = 1\n", "x.toml:3:8",
               "did you mean \"altitude\"");
  expect_fault(
      std::string(head) + "[[layers]]\nname=\"a\"\n[layers.functions]\naltitute = { low = 3 }\n",
      "x.toml:9:1", "did you mean \"altitude\"");
  expect_fault(
      std::string(head) +
          "[[layers]]\nname=\"a\"\n[layers.functions]\naltitude = { samples = \"AAE_\" }\n",
      "x.toml:9:24", "not bytes in base64");
  expect_fault(std::string(head) + "[[layers]]\nname=\"a\"\nwhen = \"slop > 3\"\n", "x.toml:8:9",
               "did you mean \"slope\"");
  expect_fault(std::string(head) + "[[layers]]\nname=\"a\"\ncolour = \"red\"\n", "x.toml:8:10",
               "red");
  expect_fault(std::string(head) + "[[layers]]\nname=\"a\"\n[[layers]]\nname=\"a\"\n", "x.toml:8:1",
               "second layer");
  expect_fault("version = 1\nmodel = \"sum\"\nlayers = []\n", "x.toml:2:9", "unknown model");
  expect_fault("version = 1\nlayers = []\n[parameters]\nslope = 3\n", "x.toml:4:1",
               "already in use");
  expect_fault(std::string(head) + "[[layers]]\nname=\"a\"\nnoise = { octaves = 13 }\n",
               "x.toml:8:21", "13");
  expect_fault("version = 2\nlayers = []\n", "x.toml:1:11", "2");
}

}  // namespace
}  // namespace belvedere
