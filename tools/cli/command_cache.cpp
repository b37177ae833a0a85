#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "base/error.h"
#include "base/text/json.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

using Entries = std::vector<CacheEntry>;

constexpr int seconds_per_day = 86400;

std::string required_folder() {
  std::string folder = user_cache_folder();
  if (folder.empty())
    throw Error(ErrorKind::usage, "cache", "no cache folder for this user",
                "HOME, XDG_CACHE_HOME or BELVEDERE_CACHE in the environment");
  return folder;
}

std::uint64_t sum_of(const Entries& entries) {
  return std::accumulate(
      entries.begin(), entries.end(), std::uint64_t{0},
      [](std::uint64_t sum, const CacheEntry& entry) { return sum + entry.bytes; });
}

std::string describe_bytes(std::uint64_t bytes) {
  constexpr double mib = 1024.0 * 1024.0;
  return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / mib);
}

std::string describe_age(std::int64_t age_s) {
  const double seconds = static_cast<double>(age_s);
  return age_s < 2 * seconds_per_day ? describe_seconds(seconds)
                                     : fmt::format("{:.0f} days", seconds / seconds_per_day);
}

std::string describe_entries(const Entries& entries) {
  return fmt::format("{} {}, {}", entries.size(), entries.size() == 1 ? "entry" : "entries",
                     describe_bytes(sum_of(entries)));
}

std::string as_text(const std::string& folder, const Entries& entries) {
  std::size_t product_width = 0;
  std::size_t bytes_width = 0;
  std::size_t age_width = 0;
  for (const CacheEntry& entry : entries) {
    product_width = std::max(product_width, entry.product.size());
    bytes_width = std::max(bytes_width, describe_bytes(entry.bytes).size());
    age_width = std::max(age_width, describe_age(entry.age_s).size());
  }
  std::string out;
  for (const CacheEntry& entry : entries)
    out += fmt::format("{:<{}}  {:>{}}  used {:>{}} ago  {}\n", entry.product, product_width,
                       describe_bytes(entry.bytes), bytes_width, describe_age(entry.age_s),
                       age_width, entry.subject);
  return out + fmt::format("{}: {}; it may grow to {}\n", folder, describe_entries(entries),
                           describe_bytes(default_cache_limit(folder)));
}

Json as_json(const Entries& entries) {
  Json list = Json::array();
  for (const CacheEntry& entry : entries)
    list.add(Json::object()
                 .add("product", Json::text(entry.product))
                 .add("subject", Json::text(entry.subject))
                 .add("path", Json::text(entry.path))
                 .add("bytes", Json::raw(fmt::format("{}", entry.bytes)))
                 .add("unused_s", Json::raw(fmt::format("{}", entry.age_s))));
  return list;
}

}  // namespace

Action add_cache_list(CommandOptions& command) {
  const auto json = std::make_shared<bool>(false);
  command.add_flag("--json", *json, "As JSON");
  command.footer(
      "The cache holds results that take long and depend on a scene's inputs alone: synthetic "
      "terrain, land cover by\n"
      "rules, generalized ground and its surroundings, example sheets. File names are hashes; this "
      "list describes them.\n"
      "The cache is in ~/.cache/belvedere ($XDG_CACHE_HOME/belvedere, $BELVEDERE_CACHE) and may be "
      "deleted at any\n"
      "time. Commands that take a scene do not use it with --no-cache.\n"
      "\n"
      "  belvedere cache list");
  return [json] {
    const std::string folder = required_folder();
    const Entries entries = cache_entries(folder);
    print_out(*json ? Json::object()
                              .add("folder", Json::text(folder))
                              .add("bytes", Json::raw(fmt::format("{}", sum_of(entries))))
                              .add("limit_bytes",
                                   Json::raw(fmt::format("{}", default_cache_limit(folder))))
                              .add("entries", as_json(entries))
                              .str() +
                          "\n"
                    : as_text(folder, entries));
    return 0;
  };
}

Action add_cache_clear(CommandOptions& command) {
  const auto days = std::make_shared<int>(0);
  command
      .add_option("--older-than DAYS", *days, "Only entries that were not used for this many days")
      .range(0, 36500);
  command.footer(
      "Removed entries are computed again when they are needed.\n"
      "\n"
      "  belvedere cache clear\n"
      "  belvedere cache clear --older-than 30");
  return [days] {
    const Entries removed = clear_cache(required_folder(), std::int64_t{seconds_per_day} * *days);
    print_out(fmt::format("removed {}\n", describe_entries(removed)));
    return 0;
  };
}

}  // namespace belvedere::tools
