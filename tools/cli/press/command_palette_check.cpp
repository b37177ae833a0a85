#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/text/hex_colour.h"
#include "base/text/json.h"
#include "renderer/image/icc/press_colour.h"
#include "renderer/press/proof.h"
#include "tools/cli/press/press_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

struct PaletteCheckOptions {
  std::vector<std::string> palettes;
  PressOptions press;
  double outside_delta_e = ProofParameters{}.outside_delta_e;
  bool json = false;
};

Json as_json(const std::string& palette, std::size_t all,
             const std::vector<PaletteColour>& missed) {
  Json colours = Json::array();
  for (const PaletteColour& one : missed)
    colours.add(Json::object()
                    .add("where", Json::text(one.where))
                    .add("colour", Json::text(hex_colour(one.colour)))
                    .add("printed", Json::text(hex_colour(one.printed)))
                    .add("delta_e", Json::number(one.delta_e)));
  return Json::object()
      .add("palette", Json::text(palette))
      .add("colours", Json::number(static_cast<double>(all)))
      .add("outside", colours);
}

std::string as_text(const std::string& palette, std::size_t all,
                    const std::vector<PaletteColour>& missed) {
  std::string out =
      fmt::format("{}: {} of {} colours cannot be printed\n", palette, missed.size(), all);
  for (const PaletteColour& one : missed)
    out += fmt::format("  {:<34} {} prints as {}, ΔE2000 {:.1f}\n", one.where,
                       hex_colour(one.colour), hex_colour(one.printed), one.delta_e);
  return out;
}

}  // namespace

std::function<int()> add_palette_check(CommandOptions& command) {
  const auto options = std::make_shared<PaletteCheckOptions>();
  command.add_option("PALETTE", options->palettes, "Built-in palettes or .toml files").required();
  add_press_options(command, options->press, false);
  command
      .add_option("--outside", options->outside_delta_e,
                  "ΔE2000 above which a colour counts as unprintable")
      .type_name("DE")
      .range(0.1, 50.0)
      .show_default();
  command.add_flag("--json", options->json, "As JSON");
  command.footer(
      "Exit status 0: the press can print all colours; 1: it cannot print some. Beside each is the "
      "nearest printable colour.\n"
      "\n"
      "  belvedere palette check summer winter --profile PSOcoated_v3.icc");
  return [options] {
    const std::vector<std::uint8_t> press = read_press_profile(options->press.profile);
    std::string text;
    Json json = Json::array();
    bool all_inside = true;
    for (const std::string& name : options->palettes) {
      std::vector<PaletteColour> colours = print_palette(read_palette(name), press);
      const std::size_t all = colours.size();
      std::erase_if(colours, [&](const PaletteColour& one) {
        return one.delta_e <= options->outside_delta_e;
      });
      all_inside = all_inside && colours.empty();
      text += as_text(name, all, colours);
      json.add(as_json(name, all, colours));
    }
    print_out(options->json ? json.str() + "\n" : text);
    return all_inside ? 0 : 1;
  };
}

}  // namespace belvedere::tools
