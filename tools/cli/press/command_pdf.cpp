#include <fmt/core.h>

#include <memory>
#include <utility>

#include "base/error.h"
#include "renderer/image/rows/picture_files.h"
#include "renderer/press/print_pdf.h"
#include "tools/cli/commands.h"
#include "tools/cli/press/press_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
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
  const std::size_t by = text.find('x');
  try {
    std::size_t end_width = 0;
    std::size_t end_height = 0;
    const glm::dvec2 size = {
        std::stod(text, &end_width),
        by == std::string::npos ? 0.0 : std::stod(text.substr(by + 1), &end_height)};
    if (end_width == by && by + 1 + end_height == text.size() && size.x >= 10.0 && size.y >= 10.0)
      return size;
  } catch (const std::exception&) {  // no numbers: refused below
  }
  throw Error(ErrorKind::usage, "--paper", fmt::format("\"{}\"", text),
              "A4, A3, A2, A1, A0, letter, tabloid, each with -landscape, or WIDTHxHEIGHT in mm");
}

std::string as_text(const std::string& file, const PdfReport& report, bool press) {
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
      .add_option("--ink-limit", pdf.ink_limit_percent,
                  "Total ink above which pixels are counted; 0: the profile's limit")
      .type_name("PERCENT")
      .range(0.0, 400.0);
  command.add_option("--bits", pdf.bits, "Bits per channel").one_of({8, 16}).show_default();
  command
      .add_option("--width-mm", pdf.width_mm,
                  "Width of the picture in print. Default: by its resolution")
      .type_name("MM")
      .range(10.0, 20000.0);
  command
      .add_option("--labels", pdf.labels,
                  "An SVG over the whole picture, as belvedere labels writes it: stays vectors")
      .type_name("FILE")
      .files(FileUse::input);
  command
      .add_option("--bleed", pdf.pages.bleed_mm, "Bleed: the edge of the picture that is cut away")
      .type_name("MM")
      .range(0.0, 50.0);
  command.add_flag("--marks", pdf.pages.marks, "Crop marks");
  command
      .add_option("--paper", options->paper,
                  "Splits it into pages of this size: A4, A3, A3-landscape … or WIDTHxHEIGHT in mm")
      .type_name("SIZE");
  command.add_option("--margin", pdf.pages.margin_mm, "Margin around each page")
      .type_name("MM")
      .range(0.0, 100.0)
      .show_default();
  command.add_option("--overlap", pdf.pages.overlap_mm, "Overlap of pages, for gluing")
      .type_name("MM")
      .range(0.0, 100.0)
      .show_default();
  command.add_option("--title", pdf.title, "Title of the document").type_name("TEXT");
  command.add_option("--out", options->out, "The PDF")
      .required()
      .type_name("FILE")
      .files(FileUse::writes);
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
    print_out(as_text(options->out, report, !options->pdf.press.empty()));
    return 0;
  };
}

}  // namespace belvedere::tools
