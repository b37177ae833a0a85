#include "tools/report/verification.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/text/text_encoding.h"
#include "renderer/image/image_io.h"
#include "renderer/image/picture_diff.h"
#include "renderer/image/picture_formats.h"
#include "renderer/image/srgb.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

// In attributes: XML 1.0 cannot represent other control characters at all.
std::string xml_escaped(const std::string& text) {
  std::string out;
  for (const char c : markup_text(text)) {
    const bool control = static_cast<unsigned char>(c) < 0x20;
    out += c == '\n' ? "&#10;" : std::string(1, control ? '?' : c);
  }
  return out;
}

std::string test_case(const Verification& scene, const std::string& name,
                      const std::string& inside) {
  const std::string head = fmt::format("    <testcase classname=\"{}\" name=\"{}\"",
                                       xml_escaped(scene.name), xml_escaped(name));
  return inside.empty() ? head + "/>\n" : head + ">\n      " + inside + "\n    </testcase>\n";
}

std::string product_case(const Verification& scene, const std::string& product) {
  std::vector<LockDifference> differences;
  std::copy_if(scene.differences.begin(), scene.differences.end(), std::back_inserter(differences),
               [&](const LockDifference& one) { return one.file == product; });
  if (differences.empty()) return test_case(scene, product, "");
  std::string words = describe(differences);
  for (const std::string& note : scene.notes) words += "\n  note: " + note;
  return test_case(scene, product,
                   fmt::format("<failure type=\"difference\" message=\"{}\">{}</failure>",
                               xml_escaped("differs in " + channels_that_differ(scene, product)),
                               xml_escaped(words.substr(1))));
}

}  // namespace

int exit_status(const std::vector<Verification>& all) {
  for (const Verification& one : all)
    if (one.error_status != 0) return one.error_status;
  return std::all_of(all.begin(), all.end(), [](const Verification& one) { return one.same(); })
             ? 0
             : 1;
}

std::string channels_that_differ(const Verification& verification, const std::string& product) {
  std::string out;
  for (const LockDifference& one : verification.differences)
    if (one.file == product)
      out += (out.empty() ? "" : " ") + (one.channel.empty() ? one.found : one.channel);
  return out;
}

std::string one_line(const Verification& verification) {
  if (verification.error_status != 0)
    return fmt::format("{}: not compared: {}", verification.scene, verification.error);
  std::string out =
      fmt::format("{}: {}×{}: ", verification.scene, verification.width, verification.height);
  if (verification.same()) return out + "the same";
  std::string list;
  for (const std::string& product : verification.products)
    if (const std::string channels = channels_that_differ(verification, product); !channels.empty())
      list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", product, channels);
  for (const std::string& note : verification.notes) list += "; " + note;
  return out + "differs in " + list;
}

std::string verification_junit(const std::vector<Verification>& all) {
  std::string suites;
  std::size_t tests = 0;
  std::size_t failures = 0;
  std::size_t errors = 0;
  for (const Verification& scene : all) {
    const bool failed = scene.error_status != 0;
    const auto differing = static_cast<std::size_t>(std::count_if(
        scene.products.begin(), scene.products.end(),
        [&](const std::string& product) { return !channels_that_differ(scene, product).empty(); }));
    const std::size_t cases = failed ? 1 : 1 + scene.products.size();
    suites += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.1f}\">\n",
        xml_escaped(scene.scene), cases, differing, failed ? 1 : 0, scene.seconds);
    if (failed)
      suites += test_case(scene, "inputs",
                          fmt::format("<error type=\"exit status {}\" message=\"{}\"/>",
                                      scene.error_status, xml_escaped(scene.error)));
    else
      suites += test_case(scene, "inputs", "");
    if (!failed)
      for (const std::string& product : scene.products) suites += product_case(scene, product);
    suites += "  </testsuite>\n";
    tests += cases;
    failures += differing;
    errors += failed ? 1 : 0;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"belvedere verify\" "
      "tests=\"{}\" failures=\"{}\" "
      "errors=\"{}\">\n{}</testsuites>\n",
      tests, failures, errors, suites);
}

namespace {

namespace fs = std::filesystem;

constexpr int longest_px = 1000;  // of a picture on the page

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

// The scene's panorama in encoded colours, from whichever of its files exists; empty where none
// does.
Grid<glm::vec3> panorama_of(const Verification& scene, const fs::path& folder) {
  for (const bool linear : {false, true})
    for (const std::string& product : scene.products) {
      const fs::path path = folder / product;
      if (!product.starts_with("panorama.") || !is_there(path) ||
          format_of_file(path.string()).linear != linear)
        continue;
      Grid<glm::vec3> picture = read_picture(path.string());
      for (glm::vec3& colour : picture)
        for (int c = 0; linear && c < 3; ++c)
          colour[c] = static_cast<float>(
              std::clamp(srgb_encoded(std::clamp(colour[c], 0.F, 1.F)), 0.0, 1.0));
      return picture;
    }
  return {};
}

// The largest difference of the three colours, white from a tenth of the scale up.
Grid<glm::vec3> difference_picture(const Grid<glm::vec3>& a, const Grid<glm::vec3>& b) {
  constexpr float white = .1F;
  Grid<float> largest(a.width(), a.height());
  for (std::size_t i = 0; i < largest.size(); ++i)
    largest[i] =
        std::max({std::abs(a[i].x - b[i].x), std::abs(a[i].y - b[i].y), std::abs(a[i].z - b[i].z)});
  return heat_picture(largest, white);
}

void add_pictures(Report& report, const Verification& scene, const std::string& against) {
  const auto add = [&report](const Grid<glm::vec3>& picture, const std::string& caption) {
    report.picture("", reduced_picture(picture, longest_px), caption);
    report.next_row();
  };
  const Grid<glm::vec3> now = panorama_of(scene, scene.folder);
  if (now.empty()) return;
  add(now, "as rendered now");
  const Grid<glm::vec3> before =
      against.empty() ? Grid<glm::vec3>() : panorama_of(scene, fs::path(against) / scene.name);
  if (before.empty()) return;
  add(before, "before");
  if (before.width() == now.width() && before.height() == now.height())
    add(difference_picture(now, before),
        "difference: black where equal, white from a tenth of the scale up");
}

// Differences from an earlier run, if available.
void add_measured(Report& report, const Verification& scene, const std::string& against) {
  if (against.empty()) return;
  ReportTable table({{"product", "relative to the earlier run"},
                     {"channel", "channel"},
                     {"mean", "mean difference", ".4g"},
                     {"most", "largest", ".4g"},
                     {"differing", "pixels that differ", ".4%"}});
  for (const std::string& product : scene.products) {
    const fs::path before = fs::path(against) / scene.name / product;
    if (channels_that_differ(scene, product).empty() || !is_there(before)) continue;
    const PictureDifference difference =
        compare_pictures(before.string(), (fs::path(scene.folder) / product).string());
    for (const std::string& mismatch : difference.mismatches)
      table.row(product, mismatch, "", "", "");
    for (const ChannelDifference& one : difference.channels)
      if (one.differing_share > 0.0)
        table.row(product, one.name, one.mean, one.max, one.differing_share);
  }
  if (!table.empty()) report.table(table);
}

void add_scene(Report& report, const Verification& scene, const std::string& against) {
  report.section(scene.name, scene.scene, {}, scene.same() ? "good" : "bad");
  if (scene.error_status != 0) {
    report.listing(scene.error);
    return;
  }
  report.text(fmt::format("{}×{} pixels, {} inputs as in the lock. {}", scene.width, scene.height,
                          scene.inputs, scene.same() ? "All channels are the same." : ""));
  for (const std::string& note : scene.notes) report.text(note);
  if (scene.same()) return;
  ReportTable table({{"product", "product"},
                     {"channel", "channel"},
                     {"locked", "in the lock"},
                     {"found", "now"}});
  for (const LockDifference& one : scene.differences)
    table.row(one.file, one.channel, one.locked, one.found);
  report.table(table);
  add_measured(report, scene, against);
  add_pictures(report, scene, against);
}

}  // namespace

std::string verification_page(const std::vector<Verification>& all, const VerificationPage& page) {
  Report report(page.scratch_folder, Report::Pictures::inside);
  for (const bool good : {false, true})
    for (const Verification& scene : all)
      if (scene.same() == good) add_scene(report, scene, page.against);
  const auto same =
      std::count_if(all.begin(), all.end(), [](const Verification& one) { return one.same(); });
  return report.page({.title = "Scenes and their locks",
                      .lead = fmt::format("{} of {} scenes are the same.", same, all.size()),
                      .command = {}});
}

}  // namespace belvedere::tools
