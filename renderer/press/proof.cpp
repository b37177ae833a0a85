#include "renderer/press/proof.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "renderer/image/image_io.h"
#include "renderer/image/rows/picture_files.h"
#include "renderer/image/srgb_table.h"

namespace belvedere {
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

}  // namespace belvedere
