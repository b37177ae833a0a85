#include <fmt/core.h>

#include <algorithm>

#include "base/text/markup.h"
#include "tools/report/verification.h"

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

}  // namespace belvedere::tools
