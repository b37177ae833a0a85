#include "renderer/press/proof.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/parallel.h"
#include "base/text/missing_file.h"
#include "renderer/image/image_io.h"
#include "renderer/image/rows/picture_files.h"
#include "renderer/image/srgb.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

constexpr const char* allowed =
    "an RGB picture (TIFF, PNG, JPEG XL, JPEG), or the folder of a rendered scene";

bool is_inks(const ImageInfo& info) {
  return !info.parts.empty() && !info.parts.front().channels.empty() &&
         info.parts.front().channels.front().name == "C";
}

PressPicture picture_of(const std::string& file, const ImageInfo& info) {
  if (is_inks(info) || is_cmyk_profile(info.icc_profile))
    throw Error(ErrorKind::input, file, "is a CMYK picture", allowed);
  if (info.format == "openexr")
    throw Error(ErrorKind::input, file, "contains linear light instead of device colours", allowed);
  PressPicture out{file, info.width, info.height, info.dots_per_inch, info.icc_profile};
  if (!out.profile.empty() && !is_rgb_profile(out.profile))
    out.profile.clear();  // a grey profile: its numbers are used unchanged
  return out;
}

}  // namespace

PressPicture find_press_picture(const std::string& path) {
  if (!fs::exists(path)) throw missing_file(path, allowed);
  if (!fs::is_directory(path)) return picture_of(path, read_image_info(path));
  for (const std::string& name :
       newest_results(path, {"panorama.tif", "panorama.jxl", "panorama.png"})) {
    const std::string file = (fs::path(path) / name).string();
    const ImageInfo info = read_image_info(file);
    if (!is_inks(info)) return picture_of(file, info);
  }
  throw Error(ErrorKind::input, path, "has no panorama.tif, .jxl or .png in RGB", allowed);
}

namespace {

constexpr double bins_a_delta_e = 100.0;
constexpr std::size_t bins = 20000;  // no two colours are 200 apart
constexpr glm::vec3 warning(0.9F, 0.05F, 0.1F);

// Differences as whole numbers: their sums are the same in any order.
class DeltaCount {
 public:
  void add(const ProofRows& rows) {
    for (std::size_t i = 0; i < rows.delta_e.size(); ++i) {
      const double delta = std::max(0.0, static_cast<double>(rows.delta_e[i]));
      ++counts_[std::min(bins - 1, static_cast<std::size_t>(delta * bins_a_delta_e))];
      sum_ += static_cast<std::uint64_t>(delta * 65536.0);
      highest_ = std::max(highest_, delta);
      outside_ += rows.outside[i];
    }
    pixels_ += rows.delta_e.size();
  }
  void report(ProofReport& out) const {
    out.pixels = pixels_;
    if (pixels_ == 0) return;
    const auto all = static_cast<double>(pixels_);
    out.outside_share = static_cast<double>(outside_) / all;
    out.mean_delta_e = static_cast<double>(sum_) / 65536.0 / all;
    out.highest_delta_e = highest_;
    std::uint64_t within = 0;
    for (std::size_t bin = 0; bin < bins; ++bin) {
      within += counts_[bin];
      if (static_cast<double>(within) < 0.95 * all) continue;
      out.delta_e_95 = std::min(highest_, static_cast<double>(bin + 1) / bins_a_delta_e);
      break;
    }
  }

 private:
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(bins);
  std::uint64_t pixels_ = 0;
  std::uint64_t outside_ = 0;
  std::uint64_t sum_ = 0;
  double highest_ = 0.0;
};

// Encoded sRGB in the writer's form.
Image decoded(Grid<glm::vec3> rows) {
  parallel_rows(rows.height(), [&](int y) {
    for (int x = 0; x < rows.width(); ++x)
      for (int c = 0; c < 3; ++c) rows(x, y)[c] = srgb_decoded_fast(rows(x, y)[c]);
  });
  return rows;
}

// A light grey of the picture, so that the warning is the only colour.
Grid<glm::vec3> warned(const Grid<glm::vec3>& shown, const Grid<std::uint8_t>& outside) {
  Grid<glm::vec3> out(shown.width(), shown.height());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const float grey = 0.2F + 0.8F * (0.3F * shown[i].x + 0.6F * shown[i].y + 0.1F * shown[i].z);
    out[i] = outside[i] != 0 ? warning * (0.4F + 0.6F * grey) : glm::vec3(grey);
  }
  return out;
}

}  // namespace

ProofReport write_proof(const PressPicture& picture, const std::vector<std::uint8_t>& press,
                        const ProofParameters& parameters, double ink_limit_percent,
                        const std::string& stem, Progress& progress) {
  const SoftProof proof(press, parameters, picture.profile);
  InkCount ink(ink_limit_percent > 0.0 ? ink_limit_percent : press_ink_limit_percent(press));
  DeltaCount deltas;
  ProofReport report;
  report.press = profile_name(press);
  const FileNotes notes = {{"belvedere:press", report.press}};
  PictureFiles shown(stem + "_proof", {"png"}, picture.width, picture.height, {},
                     picture.dots_per_inch, notes);
  PictureFiles outside(stem + "_outside", {"png"}, picture.width, picture.height, {},
                       picture.dots_per_inch, notes);
  progress.begin("proofing", picture.height);
  read_picture_rows(picture.file, [&](int, const Grid<glm::vec3>& rows) {
    const ProofRows made = proof.make(rows);
    deltas.add(made);
    ink.add(made.inks);
    outside.write_rows(decoded(warned(made.shown, made.outside)));
    shown.write_rows(decoded(made.shown));
    progress.advance(rows.height());
  });
  shown.finish();
  outside.finish();
  deltas.report(report);
  report.ink = ink.coverage();
  return report;
}

namespace {

std::vector<PaletteColour> colours_of(const Palette& palette) {
  std::vector<PaletteColour> out;
  const auto add = [&](std::string where, glm::vec3 colour) {
    out.push_back({std::move(where), colour, {}, 0.0});
  };
  for (const LandCoverClassInfo& info : land_cover_classes())
    for (const ClassPalette::Stop& stop : palette.classes[static_cast<std::size_t>(info.id)].stops)
      for (std::size_t t = 0; t < ramp_tones.size(); ++t)
        add(fmt::format("{} at {:.0f} m, tone {}", info.name, stop.altitude_m, ramp_tones[t]),
            stop.ramp[t]);
  for (const auto& [height, colour] : palette.sky) add(fmt::format("sky at {}", height), colour);
  add("clouds in light", palette.cloud_light);
  add("clouds in shade", palette.cloud_shade);
  add("haze near", palette.haze_near);
  add("haze far", palette.haze_far);
  add("mist between ranges", palette.range_mist);
  for (std::size_t i = 0; i < palette.growth.leaves.size(); ++i)
    add(fmt::format("leaves {}", i + 1), palette.growth.leaves[i]);
  if (palette.growth.larch_share > 0.0) add("larches", palette.growth.larch);
  return out;
}

}  // namespace

std::vector<PaletteColour> print_palette(const Palette& palette,
                                         const std::vector<std::uint8_t>& press) {
  std::vector<PaletteColour> colours = colours_of(palette);
  Grid<glm::vec3> row(static_cast<int>(colours.size()), 1);
  for (std::size_t i = 0; i < colours.size(); ++i) row[i] = colours[i].colour;
  const ProofRows rows = SoftProof(press, {.device = {RenderingIntent::relative, false}}).make(row);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    colours[i].printed = rows.shown[i];
    colours[i].delta_e = rows.delta_e[i];
  }
  return colours;
}

}  // namespace belvedere
