#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/text/hex_colour.h"
#include "base/text/json.h"
#include "base/text/parse_number.h"
#include "renderer/image/icc/device_colour.h"
#include "renderer/image/icc/press_colour.h"
#include "renderer/image/rows/picture_files.h"
#include "renderer/press/print_pdf.h"
#include "renderer/press/proof.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {

namespace {

// Options shared by commands for printers.
struct PressOptions {
  std::string profile;
  std::string intent = "relative";
  bool no_black_point = false;
  DeviceParameters device() const { return {rendering_intent(intent), !no_black_point}; }
};
// --profile, and with `conversion` also --intent and --no-black-point.
void add_press_options(CommandOptions& command, PressOptions& options, bool conversion) {
  command.add_option("--profile FILE", options.profile, "ICC profile of the printing press, CMYK")
      .required()
      .files(FileUse::input);
  if (!conversion) return;
  command
      .add_option("--intent", options.intent,
                  "Rendering intent for colours that the press cannot print")
      .one_of(rendering_intent_names())
      .show_default();
  command.add_flag("--no-black-point", options.no_black_point,
                   "Keeps the picture's black, even where the press has none as dark");
}

void add_outside(CommandOptions& command, double& delta_e) {
  command.add_option("--outside DE", delta_e, "ΔE2000 above which a colour counts as unprintable")
      .range(0.1, 50.0)
      .show_default();
}

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
  add_outside(command, options->outside_delta_e);
  command
      .add_option("--ink-limit PERCENT", options->ink_limit_percent,
                  "Total ink above which pixels are counted; 0: the profile's limit")
      .range(0.0, 400.0);
  command.add_option("--out DIR", options->out, "Folder for the two pictures")
      .required()
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

namespace {

struct PaletteCheckOptions {
  std::vector<std::string> palettes;
  PressOptions press;
  double outside_delta_e = ProofParameters{}.outside_delta_e;
  bool json = false;
};

Json verdict_json(const std::string& palette, std::size_t all,
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

std::string verdict_text(const std::string& palette, std::size_t all,
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
  add_outside(command, options->outside_delta_e);
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
      text += verdict_text(name, all, colours);
      json.add(verdict_json(name, all, colours));
    }
    print_out(options->json ? json.str() + "\n" : text);
    return all_inside ? 0 : 1;
  };
}

namespace {

struct PdfOptions {
  std::string picture;
  PressOptions press;
  PdfParameters pdf;
  std::string paper;
  std::string out;
  bool quiet = false;
};

// "A3", upright or "A3-landscape", or "420x297" in mm.
glm::dvec2 paper_size(const std::string& text) {
  static const std::vector<std::pair<std::string, glm::dvec2>> sizes = {
      {"A4", {210, 297}},         {"A3", {297, 420}},  {"A2", {420, 594}},
      {"A1", {594, 841}},         {"A0", {841, 1189}}, {"letter", {215.9, 279.4}},
      {"tabloid", {279.4, 431.8}}};
  for (const auto& [name, size] : sizes) {
    if (text == name) return size;
    if (text == name + "-landscape") return {size.y, size.x};
  }
  if (const std::size_t by = text.find('x'); by != std::string::npos) {
    const glm::dvec2 size = {parse_number<double>(text.substr(0, by)).value_or(0.0),
                             parse_number<double>(text.substr(by + 1)).value_or(0.0)};
    if (size.x >= 10.0 && size.y >= 10.0) return size;
  }
  throw Error(ErrorKind::usage, "--paper", fmt::format("\"{}\"", text),
              "A4, A3, A2, A1, A0, letter, tabloid, each with -landscape, or WIDTHxHEIGHT in mm");
}

std::string pdf_text(const std::string& file, const PdfReport& report, bool press) {
  std::string out =
      fmt::format("{}: {} page{}, picture {:.0f} × {:.0f} mm\n", file, report.pages,
                  report.pages == 1 ? "" : "s", report.picture_mm.x, report.picture_mm.y);
  if (press) out += ink_note(file_name(file), report.ink) + "\n";
  return out;
}

}  // namespace

std::function<int()> add_pdf(CommandOptions& command) {
  const auto options = std::make_shared<PdfOptions>();
  PdfParameters& pdf = options->pdf;
  command
      .add_option("PICTURE", options->picture,
                  "A picture in RGB, or the folder of a rendered scene")
      .required();
  add_press_options(command, options->press, true);
  command.option("--profile").required(false);
  command
      .add_option("--ink-limit PERCENT", pdf.ink_limit_percent,
                  "Total ink above which pixels are counted; 0: the profile's limit")
      .range(0.0, 400.0);
  command.add_option("--bits", pdf.bits, "Bits per channel").one_of({8, 16}).show_default();
  command
      .add_option("--width-mm MM", pdf.width_mm,
                  "Width of the picture in print. Default: by its resolution")
      .range(10.0, 20000.0);
  command
      .add_option("--labels FILE", pdf.labels,
                  "An SVG over the whole picture, as belvedere labels writes it: stays vectors")
      .files(FileUse::input);
  command
      .add_option("--bleed MM", pdf.pages.bleed_mm,
                  "Bleed: the edge of the picture that is cut away")
      .range(0.0, 50.0);
  command.add_flag("--marks", pdf.pages.marks, "Crop marks");
  command.add_option(
      "--paper SIZE", options->paper,
      "Splits it into pages of this size: A4, A3, A3-landscape … or WIDTHxHEIGHT in mm");
  command.add_option("--margin MM", pdf.pages.margin_mm, "Margin around each page")
      .range(0.0, 100.0)
      .show_default();
  command.add_option("--overlap MM", pdf.pages.overlap_mm, "Overlap of pages, for gluing")
      .range(0.0, 100.0)
      .show_default();
  command.add_option("--title TEXT", pdf.title, "Title of the document");
  command.add_option("--out FILE", options->out, "The PDF").required().files(FileUse::writes);
  command.add_flag("--quiet", options->quiet, "No progress");
  command.footer(
      "With a press profile the file is PDF/X-4: CMYK, output intent, page boxes. Without one it "
      "is RGB, for\n"
      "office printers.\n"
      "\n"
      "  belvedere pdf out/karwendel --profile PSOcoated_v3.icc --labels out/labels/labels.svg "
      "--bleed 3 --marks --out sheet.pdf\n"
      "  belvedere pdf out/karwendel --paper A4-landscape --marks --out tiles.pdf");
  return [options] {
    const PressPicture picture = find_press_picture(options->picture);
    if (!options->press.profile.empty())
      options->pdf.press = read_press_profile(options->press.profile);
    options->pdf.device = options->press.device();
    if (!options->paper.empty()) options->pdf.pages.paper_mm = paper_size(options->paper);
    TerminalProgress progress(options->quiet);
    const PdfReport report = write_print_pdf(options->out, picture, options->pdf, progress);
    progress.end();
    print_out(pdf_text(options->out, report, !options->pdf.press.empty()));
    return 0;
  };
}

}  // namespace belvedere::tools
