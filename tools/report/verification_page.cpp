#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/text/markup.h"
#include "renderer/image/image_io.h"
#include "renderer/image/picture_diff.h"
#include "renderer/image/picture_formats.h"
#include "renderer/image/srgb.h"
#include "tools/report/data_uri.h"
#include "tools/report/report_folder.h"
#include "tools/report/report_pictures.h"
#include "tools/report/verification.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

constexpr int longest_px = 1000;  // of a picture on the page

constexpr const char* verification_style =
    "body{font:16px/1.45 system-ui,sans-serif;margin:2rem auto;max-width:1040px;padding:0 1rem;color:#222;background:#fafaf7}"
    "h2{font-size:1.2rem;margin-top:2.2rem}figure{margin:0 0 1rem}img{max-width:100%;display:block}figcaption{font-size:.85rem;color:#555}"
    "table{border-collapse:collapse;font-size:.85rem}td,th{padding:.2rem .8rem;border-bottom:1px solid #ddd;text-align:left}"
    "pre{background:#eee;padding:.6rem;white-space:pre-wrap}.same{color:#2a6b2a}.differs{color:#a33}";

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

// The scene's panorama in encoded colours, from whichever of its files is there; empty where none is.
Grid<glm::vec3> panorama_of(const Verification& scene, const fs::path& folder) {
  for (const bool linear : {false, true})
    for (const std::string& product : scene.products) {
      const fs::path path = folder / product;
      if (!product.starts_with("panorama.") || !is_there(path) || format_of_file(path.string()).linear != linear) continue;
      Grid<glm::vec3> picture = read_picture(path.string());
      for (glm::vec3& colour : picture)
        for (int c = 0; linear && c < 3; ++c)
          colour[c] = static_cast<float>(std::clamp(srgb_encoded(std::clamp(colour[c], 0.F, 1.F)), 0.0, 1.0));
      return picture;
    }
  return {};
}

std::string figure(const Grid<glm::vec3>& picture, const std::string& caption, const std::string& scratch_folder) {
  return fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
                     png_address(reduced_picture(picture, longest_px), scratch_folder), markup_text(caption), markup_text(caption));
}

// The largest difference of the three colours, white from a tenth of the scale up.
Grid<glm::vec3> difference_picture(const Grid<glm::vec3>& a, const Grid<glm::vec3>& b) {
  constexpr float white = .1F;
  Grid<float> largest(a.width(), a.height());
  for (std::size_t i = 0; i < largest.size(); ++i)
    largest[i] = std::max({std::abs(a[i].x - b[i].x), std::abs(a[i].y - b[i].y), std::abs(a[i].z - b[i].z)});
  return heat_picture(largest, white);
}

std::string pictures(const Verification& scene, const VerificationPage& page) {
  const Grid<glm::vec3> now = panorama_of(scene, scene.folder);
  if (now.empty()) return {};
  std::string out = figure(now, "as it is rendered now", page.scratch_folder);
  const Grid<glm::vec3> before = page.against.empty() ? Grid<glm::vec3>() : panorama_of(scene, fs::path(page.against) / scene.name);
  if (before.empty()) return out;
  out += figure(before, "as it was", page.scratch_folder);
  if (before.width() == now.width() && before.height() == now.height())
    out +=
        figure(difference_picture(now, before), "difference: black where equal, white from a tenth of the scale up", page.scratch_folder);
  return out;
}

// How far products are from those of an earlier run, where that is at hand.
std::string measured(const Verification& scene, const VerificationPage& page) {
  if (page.against.empty()) return {};
  std::string rows;
  for (const std::string& product : scene.products) {
    const fs::path before = fs::path(page.against) / scene.name / product;
    if (channels_that_differ(scene, product).empty() || !is_there(before)) continue;
    const PictureDifference difference = compare_pictures(before.string(), (fs::path(scene.folder) / product).string());
    for (const std::string& mismatch : difference.mismatches) rows += html_row({markup_text(product), markup_text(mismatch), "", "", ""});
    for (const ChannelDifference& one : difference.channels)
      if (one.differing_share > 0.0)
        rows += html_row({markup_text(product), markup_text(one.name), fmt::format("{:.4g}", one.mean), fmt::format("{:.4g}", one.max),
                          fmt::format("{:.4f} %", 100.0 * one.differing_share)});
  }
  if (rows.empty()) return {};
  return "<table>" + html_row({"against the earlier run", "channel", "mean difference", "largest", "pixels that differ"}, "th") + rows +
         "</table>\n";
}

std::string section(const Verification& scene, const VerificationPage& page) {
  std::string out = fmt::format("<section><h2 class=\"{}\">{}</h2>\n", scene.same() ? "same" : "differs", markup_text(scene.scene));
  if (scene.error_status != 0) return out + "<pre>" + markup_text(scene.error) + "</pre></section>\n";
  out += fmt::format("<p>{}×{} pixels, {} inputs as in the lock. {}</p>\n", scene.width, scene.height, scene.inputs,
                     scene.same() ? "All channels are the same." : "");
  for (const std::string& note : scene.notes) out += "<p>" + markup_text(note) + "</p>\n";
  if (scene.same()) return out + "</section>\n";
  std::string rows;
  for (const LockDifference& one : scene.differences)
    rows += html_row({markup_text(one.file), markup_text(one.channel), markup_text(one.locked), markup_text(one.found)});
  out += "<table>" + html_row({"product", "channel", "in the lock", "now"}, "th") + rows + "</table>\n";
  return out + measured(scene, page) + pictures(scene, page) + "</section>\n";
}

}  // namespace

std::string verification_page(const std::vector<Verification>& all, const VerificationPage& page) {
  const auto same = std::count_if(all.begin(), all.end(), [](const Verification& one) { return one.same(); });
  std::string body;
  for (const bool good : {false, true})
    for (const Verification& scene : all)
      if (scene.same() == good) body += section(scene, page);
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>belvedere verify</title>\n<style>{}</style></head>\n"
      "<body><h1>Scenes and their locks</h1>\n<p>{} of {} scenes are the same.</p>\n{}</body></html>\n",
      verification_style, same, all.size(), body);
}

}  // namespace belvedere::tools
