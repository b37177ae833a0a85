#include <fmt/core.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/text/json.h"
#include "texture/composite/composite_figures.h"
#include "texture/statistical/model_file.h"
#include "texture/statistical/texture_figures.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/cli/texture/texture_pictures.h"
#include "tools/options/options.h"
#include "tools/options/run_options.h"

namespace belvedere::tools {
namespace {

struct TextureJudgeOptions : RunOptions {
  std::string model, crop;
  std::vector<std::string> pictures;
};

struct Judgement {
  std::string name;
  TextureFigures figures;
  std::optional<LayoutFigures> layout;  // halves lie elsewhere in the crop than it does
  int copy_px = -1;                     // -1: not asked for
};

Json as_json(const Judgement& judged) {
  Json out = with_figures(Json::object().add("picture", Json::text(judged.name)), judged.figures);
  if (judged.layout) out.add("by_height", Json::number(judged.layout->profile)).add("far_pairs", Json::number(judged.layout->far_pairs));
  if (judged.copy_px >= 0) out.add("longest_copy_px", Json::number(judged.copy_px));
  return out;
}

std::string as_text(const Judgement& judged) {
  const std::string layout = judged.layout ? fmt::format("{:.3f}   {:.3f}", judged.layout->profile, judged.layout->far_pairs) : "";
  return fmt::format("{:<32} {:.3f}  {:.3f}  {:.2f}  {:.3f}   {:.3f}  {:.3f}   {:<13}  {}\n", judged.name, judged.figures.selected,
                     judged.figures.held_out, judged.figures.worst, judged.figures.beyond, judged.figures.drawn, judged.figures.turned,
                     layout, judged.copy_px < 0 ? "" : fmt::format("{}", judged.copy_px));
}

int run(const TextureJudgeOptions& options) {
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const CliqueModel model = read_model(options.model);
  const TextureCrop crop = read_crop(options.crop, "");
  const LearnParameters parameters;
  progress.begin("comparing", static_cast<double>(options.pictures.size()));
  std::vector<Judgement> all = {{"(the crop's own halves)", halves_figures(crop.picture, model, parameters), {}}};
  for (const std::string& name : options.pictures) {
    const Grid<Rgb8> picture = read_crop(name, "").picture;
    all.push_back({name, texture_figures(crop.picture, crop.states, picture, model, parameters), layout_figures(crop.picture, picture),
                   longest_copy_px(crop.picture, picture)});
    progress.advance(1.0);
  }
  progress.end();
  if (options.json) {
    Json list = Json::array();
    for (const Judgement& judged : all) list.add(as_json(judged));
    print_out(list.str() + "\n");
  } else {
    std::string out = fmt::format("{:<32} {:<5}  {:<5}  {:<4} {:<6}  {:<5}  {:<6}  {:<6}  {:<5}  {}\n", "L1 to the crop, 0…2", "held",
                                  "other", "worst", "beyond", "drawn", "turned", "height", "far", "copy px");
    for (const Judgement& judged : all) out += as_text(judged);
    print_out(out);
  }
  return 0;
}

}  // namespace

Action add_texture_judge(CommandOptions& command) {
  const auto options = std::make_shared<TextureJudgeOptions>();
  command.add_option("MODEL", options->model, "The crop's model: says which statistics it holds and which it was not told")
      .required()
      .type_name("MODEL");
  command.add_option("CROP", options->crop, "The crop that the model was learned from").required().type_name("PICTURE");
  command.add_option("PICTURE", options->pictures, "Textures to be judged, made by whatever program").required().type_name("PICTURE …");
  add_run_options(command, *options, "figure");
  command.footer(
      "Says how far textures are from a crop: of the pairs that the model holds, of all others within reach, of five pixels at once "
      "(beyond\n"
      "pairs), of where in height colours lie and of pairs 16 to 128 pixels apart (far), which a composite keeps and one texture does "
      "not,\n"
      "and the largest square that is copied from the crop pixel by pixel. The crop's own halves are the floor that nature "
      "sets.\n\n"
      "  belvedere texture judge meadow.model meadow.png meadow_wide.png other_program.png");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
