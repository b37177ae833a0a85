#pragma once

#include "tests/grids.h"
#include "tests/texture/statistical/texture_crops.h"
#include "texture/composite/learn_composite.h"

// A crop of two synthetic textures with known positions: meadow above, grey stripes below a ragged
// border.
namespace belvedere::test {

struct Composite {
  Grid<Rgb8> picture;
  Grid<std::uint8_t> labels;
  std::vector<std::string> names = {"#008000", "#808080"};

  LabelledCrop crop() const { return {picture, none, labels, names}; }
  Grid<std::uint8_t> none{};
};

inline Composite two_textures(int width, int height) {
  Composite out{striped_crop(width, height, 8), Grid<std::uint8_t>(width, height)};
  const Grid<Rgb8> meadow = meadow_crop(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    const double border = .5 * height + 5.0 * gaussian_noise(4, x, 0, 6.0, 1.0);
    out.labels(x, y) = y < border ? 0 : 1;
    if (out.labels(x, y) == 0) out.picture(x, y) = meadow(x, y);
  }
  return out;
}

// Few types, no choice of seeds: sufficient for tests.
inline CompositeParameters quick_learning() {
  CompositeParameters parameters;
  parameters.learn.types = 16;
  parameters.learn.levels = 1;
  parameters.learn.rounds = 6;
  parameters.choose = false;
  return parameters;
}

// The model learnt from them, once.
inline const CompositeModel& two_textures_model() {
  static const CompositeModel model =
      learn_composite(two_textures(200, 150).crop(), quick_learning());
  return model;
}

// Green counts as meadow, grey as stripes.
inline bool is_green(const Rgb8& c) { return c[1] > c[2] + 25; }

}  // namespace belvedere::test
