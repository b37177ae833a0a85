#include <fmt/core.h>

#include <limits>
#include <memory>
#include <optional>

#include "base/text/json.h"
#include "renderer/image/picture_diff.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

struct DiffOptions {
  std::string a;
  std::string b;
  std::optional<double> max_mean;
  std::optional<double> max_difference;
  bool json = false;
};

// Without a threshold the pictures must be equal; with only one threshold, the other is not
// checked.
DifferenceLimits limits_of(const DiffOptions& options) {
  if (!options.max_mean && !options.max_difference) return {};
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  return {.mean = options.max_mean.value_or(unlimited),
          .max = options.max_difference.value_or(unlimited)};
}

std::string as_json(const PictureDifference& difference, bool same) {
  Json channels = Json::array();
  for (const ChannelDifference& c : difference.channels)
    channels.add(Json::object()
                     .add("name", Json::text(c.name))
                     .add("ids", Json::boolean(c.is_id))
                     .add("mean", Json::number(c.mean))
                     .add("max", Json::number(c.max))
                     .add("rms", Json::number(c.rms))
                     .add("differing_share", Json::number(c.differing_share)));
  return Json::object()
             .add("same", Json::boolean(same))
             .add("width", Json::number(difference.width))
             .add("height", Json::number(difference.height))
             .add("mismatches", Json::texts(difference.mismatches))
             .add("channels", std::move(channels))
             .str() +
         "\n";
}

std::string as_text(const PictureDifference& difference, bool same) {
  std::string out;
  for (const std::string& mismatch : difference.mismatches) out += mismatch + "\n";
  if (!difference.channels.empty())
    out += fmt::format("{:<14} {:>11} {:>11} {:>11} {:>14}\n", "channel", "mean", "max", "rms",
                       "pixels differ");
  for (const ChannelDifference& c : difference.channels)
    out += fmt::format("{:<14} {:>11.4g} {:>11.4g} {:>11.4g} {:>13.4f}%\n", c.name, c.mean, c.max,
                       c.rms, 100.0 * c.differing_share);
  return out + (same ? "same\n" : "different\n");
}

}  // namespace

Action add_diff(CommandOptions& command) {
  const auto options = std::make_shared<DiffOptions>();
  command.add_option("A", options->a, "A picture: OpenEXR, TIFF, PNG or JPEG").required();
  command.add_option("B", options->b, "Another picture of the same size").required();
  command
      .add_option("--max-mean X", options->max_mean,
                  "Largest mean difference of any channel that still counts as equal")
      .not_negative();
  command
      .add_option("--max-difference X", options->max_difference,
                  "Largest difference of any single pixel that still counts as equal")
      .not_negative();
  command.add_flag("--json", options->json, "As JSON");
  command.footer(
      "Exit status 0: equal within the thresholds (without any: equal in every pixel); 1: "
      "different.\n"
      "Values are 0…1 in PNG, TIFF and JPEG, and unscaled in OpenEXR. Class numbers are equal or "
      "not:\n"
      "for them --max-mean is the share of pixels that may differ, and --max-difference does not "
      "apply.\n"
      "\n"
      "  belvedere diff before/panorama.png after/panorama.png --max-mean 0.002");
  return [options] {
    const PictureDifference difference = compare_pictures(options->a, options->b);
    const bool same = is_same(difference, limits_of(*options));
    print_out(options->json ? as_json(difference, same) : as_text(difference, same));
    return same ? 0 : 1;
  };
}

}  // namespace belvedere::tools
