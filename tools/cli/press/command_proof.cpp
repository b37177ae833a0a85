#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "base/text/json.h"
#include "renderer/press/proof.h"
#include "tools/cli/press/press_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

struct ProofOptions {
  std::string picture;
  PressOptions press;
  bool paper = false;
  double outside_delta_e = ProofParameters{}.outside_delta_e;
  double ink_limit_percent = 0.0;
  std::string out;
  bool json = false;
  bool quiet = false;
};

std::string as_json(const ProofReport& report) {
  return Json::object()
             .add("press", Json::text(report.press))
             .add("pixels", Json::number(static_cast<double>(report.pixels)))
             .add("outside_share", Json::number(report.outside_share))
             .add("delta_e_mean", Json::number(report.mean_delta_e))
             .add("delta_e_95", Json::number(report.delta_e_95))
             .add("delta_e_highest", Json::number(report.highest_delta_e))
             .add("ink_limit_percent", Json::number(report.ink.limit_percent))
             .add("ink_highest_percent", Json::number(report.ink.highest_percent))
             .add("ink_mean_percent", Json::number(report.ink.mean_percent))
             .add("ink_above_share", Json::number(report.ink.above_share()))
             .str() +
         "\n";
}

std::string as_text(const ProofReport& report, double outside_delta_e) {
  return fmt::format(
      "press: {}\n"
      "unprintable colours: {:.2f} % of the pixels (ΔE2000 above {:g})\n"
      "picture to print, ΔE2000: mean {:.2f}, 95 % within {:.2f}, highest {:.2f}\n"
      "ink: highest {:.0f} %, mean {:.0f} %; above {:.0f} %: {:.2f} % of the pixels\n",
      report.press, 100.0 * report.outside_share, outside_delta_e, report.mean_delta_e,
      report.delta_e_95, report.highest_delta_e, report.ink.highest_percent,
      report.ink.mean_percent, report.ink.limit_percent, 100.0 * report.ink.above_share());
}

}  // namespace

std::function<int()> add_proof(CommandOptions& command) {
  const auto options = std::make_shared<ProofOptions>();
  command
      .add_option("PICTURE", options->picture,
                  "A picture in RGB, or the folder of a rendered scene")
      .required();
  add_press_options(command, options->press, true);
  command.add_flag("--paper", options->paper, "Simulates the paper's colour and the press's black");
  command
      .add_option("--outside", options->outside_delta_e,
                  "ΔE2000 above which a colour counts as unprintable")
      .type_name("DE")
      .range(0.1, 50.0)
      .show_default();
  command
      .add_option("--ink-limit", options->ink_limit_percent,
                  "Total ink above which pixels are counted; 0: the profile's limit")
      .type_name("PERCENT")
      .range(0.0, 400.0);
  command.add_option("--out", options->out, "Folder for the two pictures")
      .required()
      .type_name("DIR")
      .files(FileUse::folder);
  command.add_flag("--json", options->json, "The figures as JSON");
  command.add_flag("--quiet", options->quiet, "No progress");
  command.footer(
      "Writes panorama_proof.png, a simulation of the print, and panorama_outside.png, the picture "
      "in grey with\n"
      "unprintable colours in red (for another picture, with its name).\n"
      "\n"
      "  belvedere proof out/karwendel --profile PSOcoated_v3.icc --out out/proof");
  return [options] {
    const PressPicture picture = find_press_picture(options->picture);
    const std::vector<std::uint8_t> press = read_press_profile(options->press.profile);
    TerminalProgress progress(options->quiet);
    const std::string stem =
        (std::filesystem::path(options->out) / std::filesystem::path(picture.file).stem()).string();
    const ProofReport report = write_proof(
        picture, press, {options->press.device(), options->paper, options->outside_delta_e},
        options->ink_limit_percent, stem, progress);
    progress.end();
    print_out(options->json ? as_json(report) : as_text(report, options->outside_delta_e));
    return 0;
  };
}

}  // namespace belvedere::tools
