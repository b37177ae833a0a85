#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "base/text/text_encoding.h"
#include "renderer/exemplar/classes_by_paint.h"
#include "renderer/exemplar/complete_sky.h"
#include "renderer/exemplar/name_questions.h"
#include "renderer/image/icc/painting_file.h"
#include "renderer/image/image_io.h"
#include "renderer/image/label_image.h"
#include "renderer/style/fit/style_painting.h"
#include "renderer/style/fit_style.h"
#include "renderer/style/style_file.h"
#include "tools/cli/commands.h"
#include "tools/cli/studio/painting_work.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"
#include "tools/report/style_pictures.h"

namespace belvedere::tools {
namespace {

constexpr std::size_t inferred_groups = 30;  // as few as hold one class each: nobody corrects them

struct StyleFitOptions : RunOptions {
  std::string painting, classes, out, report, name, origin, licence;
};

Grid<std::uint8_t> read_classes(const StyleFitOptions& options) {
  return read_class_mask(options.classes, {far_air_label});
}

// The classes that `exemplar segment` infers.
Grid<std::uint8_t> inferred_classes(const std::string& painting, const Grid<glm::vec3>& picture,
                                    const Grid<float>& alpha) {
  const PaintingSegments segments = segment_painting(picture, alpha, usual_theta, painting);
  const NamedGroups groups = name_groups(segments, inferred_groups, {});
  return complete_sky(class_mask(segments, groups.of_pieces, groups.classes));
}

std::string as_text(const StyleFitOptions& options, const Style& style, std::size_t bytes) {
  std::string out = fmt::format("{}: {} bytes\n", options.out, bytes);
  for (const std::string& note : style.notes) out += "  " + note + "\n";
  out += fmt::format(
      "  broken paint {:.2f}, vapour {:.2f}, hue by light {:.2f}, {:.1f} units per pixel\n",
      style.broken, style.vapour, style.hue_by_light, style.units_per_px);
  return out;
}

Json as_json(const StyleFitOptions& options, const Style& style, std::size_t bytes) {
  return Json::object()
      .add("out", Json::text(options.out))
      .add("bytes", Json::number(static_cast<double>(bytes)))
      .add("notes", Json::texts(style.notes))
      .add("broken", Json::number(style.broken))
      .add("vapour", Json::number(style.vapour))
      .add("hue_by_light", Json::number(style.hue_by_light))
      .add("units_per_px", Json::number(style.units_per_px));
}

// A painting, its classes and the style that is fitted to them.
struct FittedStyle {
  Grid<glm::vec3> picture;
  Grid<std::uint8_t> mask;
  Palette reference;
  Style style;
};

FittedStyle fit(const StyleFitOptions& options, Progress& progress) {
  progress.begin("reading", 0.0);
  Grid<float> alpha;
  FittedStyle out;
  out.picture = read_painting(options.painting, progress, &alpha);
  if (!options.classes.empty()) out.mask = read_classes(options);
  StyleFitParameters parameters;
  parameters.name =
      options.name.empty() ? std::filesystem::path(options.out).stem().string() : options.name;
  parameters.origin = options.origin;
  parameters.licence = options.licence;
  out.reference = read_palette("summer");
  out.style = fit_painting(out.picture, alpha, out.mask, options.painting, parameters, progress);
  return out;
}

int run(const StyleFitOptions& options) {
  if (lower_extension(options.out) != ".toml")
    throw Error(ErrorKind::usage, "--out", options.out, "a .toml file");
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const FittedStyle fitted = fit(options, progress);
  const Style& style = fitted.style;
  const std::string text = style_text(style);
  write_text_file(options.out, text);
  if (!options.report.empty()) {
    progress.begin("writing the report", 0.0);
    write_style_page(
        options.report, file_name(options.painting), fitted.picture, fitted.mask, style,
        fitted.reference,
        fmt::format("belvedere style fit {}{} --out {}", file_name(options.painting),
                    options.classes.empty() ? "" : " --classes " + file_name(options.classes),
                    file_name(options.out)));
  }
  progress.end();
  print_result(options, as_json(options, style, text.size()), as_text(options, style, text.size()));
  return 0;
}

}  // namespace

Style fit_painting(const Grid<glm::vec3>& picture, const Grid<float>& alpha,
                   Grid<std::uint8_t>& mask, const std::string& name,
                   const StyleFitParameters& parameters, Progress& progress) {
  const bool inferred = mask.empty();
  if (inferred) {
    progress.begin("segmenting", 0.0);
    mask = inferred_classes(name, picture, alpha);
  }
  for (std::size_t i = 0; i < alpha.size() && alpha.same_size(mask); ++i)
    if (alpha[i] < 1.0F) mask[i] = unused_label;
  Style style = fit_style(picture, mask, read_palette("summer"), parameters, progress);
  if (inferred)
    style.notes.insert(style.notes.begin(),
                       "no mask was given: classes are inferred from position, colour and strokes");
  return style;
}

void write_fitted_style(const std::string& painting, const std::string& out, Progress& progress) {
  StyleFitOptions options;
  options.painting = painting;
  options.out = out;
  write_text_file(out, style_text(fit(options, progress).style));
}

Action add_style_fit(CommandOptions& command) {
  const auto options = std::make_shared<StyleFitOptions>();
  command
      .add_option("PAINTING PICTURE", options->painting,
                  "Scan of a landscape painting: PNG, TIFF or JPEG, at least 500 pixels wide")
      .required()
      .files(FileUse::input);
  command
      .add_option("--classes MASK", options->classes,
                  "Mask of class numbers (see `exemplar segment`), 200 for distant ranges in haze "
                  "colour, 255 for unused pixels. Default: inferred classes")
      .files(FileUse::input);
  command.add_option("--out STYLE", options->out, "Style file to write: .toml, about 20 kB")
      .required()
      .files(FileUse::writes);
  command
      .add_option("--report DIR", options->report,
                  "Also write a page: colours, strokes to scale, what was derived and from what")
      .files(FileUse::folder);
  command.add_option("--name NAME", options->name,
                     "Name of the style. Default: the name of the file");
  command.add_option("--origin TEXT", options->origin,
                     "Painter, title, year and source of the picture, stored in the file");
  command.add_option("--licence TEXT", options->licence,
                     "Licence of the picture, stored in the file");
  add_run_options(command, *options, "byte");
  command.footer(
      "Fits colours by class and light, air, strokes and sky of a painting and writes them to a "
      "file, which may be\n"
      "edited. The painting is not needed afterwards. Rough masks are enough: polygons well inside "
      "rock, forest, meadow, sky.\n\n"
      "  belvedere style fit painting.jpg --classes mask.png --out painting.toml --report report");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
