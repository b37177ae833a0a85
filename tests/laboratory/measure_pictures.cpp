// Figures of pictures, for developers of painting methods. Not part of the program; prints JSON.
#include <array>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/text/json.h"
#include "renderer/image/image_io.h"
#include "tests/renderer/exemplar/painting_figures.h"
#include "texture/composite/learn_composite.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/texture_figures.h"
#include "tools/cli/texture/texture_pictures.h"

namespace belvedere {
namespace {

using Words = std::vector<std::string>;

Json paintings(const Words& words) {
  constexpr std::array<std::pair<const char*, double PaintingFigures::*>, 12> names = {
      {{"sharpness", &PaintingFigures::sharpness},
       {"coarse_sharpness", &PaintingFigures::coarse_sharpness},
       {"stroke_length_px", &PaintingFigures::stroke_length_px},
       {"stroke_width_px", &PaintingFigures::stroke_width_px},
       {"direction_run_px", &PaintingFigures::direction_run_px},
       {"coherence", &PaintingFigures::coherence},
       {"unevenness", &PaintingFigures::unevenness},
       {"flat_share", &PaintingFigures::flat_share},
       {"lightness_mean", &PaintingFigures::lightness_mean},
       {"lightness_spread", &PaintingFigures::lightness_spread},
       {"saturation_mean", &PaintingFigures::saturation_mean},
       {"saturation_spread", &PaintingFigures::saturation_spread}}};
  Json all = Json::array();
  for (const std::string& word : words) {
    const std::size_t at = word.rfind('=');
    const Grid<glm::vec3> picture =
        shrink_picture(read_picture(word.substr(0, at)),
                       at == std::string::npos ? 1.0 : std::stod(word.substr(at + 1)));
    const PaintingFigures figures = measure_painting(picture);
    Json one = Json::object()
                   .add("picture", Json::text(word))
                   .add("width", Json::number(picture.width()))
                   .add("height", Json::number(picture.height()));
    for (const auto& [name, figure] : names) one.add(name, Json::number(figures.*figure));
    all.add(one.add("hue_shares", Json::numbers(figures.hue_shares)));
  }
  return all;
}

Json textures(const Words& words) {
  if (words.size() < 3)
    throw Error(ErrorKind::usage, "measure_pictures textures", "too few words",
                "a model, its crop, pictures");
  const CliqueModel model = read_model(words[0]);
  const tools::TextureCrop crop = tools::read_crop(words[1], "");
  Json all = Json::array(
      {tools::with_figures(Json::object().add("picture", Json::text("halves of the crop")),
                           halves_figures(crop.picture, model, {}))});
  for (std::size_t i = 2; i < words.size(); ++i) {
    const Grid<Rgb8> picture = tools::read_crop(words[i], "").picture;
    const LayoutFigures layout = layout_figures(crop.picture, picture);
    all.add(tools::with_figures(Json::object().add("picture", Json::text(words[i])),
                                texture_figures(crop.picture, crop.states, picture, model, {}))
                .add("by_height", Json::number(layout.profile))
                .add("far_pairs", Json::number(layout.far_pairs))
                .add("longest_copy_px", Json::number(longest_copy_px(crop.picture, picture))));
  }
  return all;
}

}  // namespace
}  // namespace belvedere

int main(int count, char** words) {
  try {
    const std::string what = count > 2 ? words[1] : "";
    if (what != "paintings" && what != "textures")
      throw belvedere::Error(belvedere::ErrorKind::usage, "measure_pictures", "missing arguments",
                             "paintings or textures, and pictures");
    const belvedere::Words rest(words + 2, words + count);
    std::puts((what == "paintings" ? belvedere::paintings(rest) : belvedere::textures(rest))
                  .str()
                  .c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
