#include "renderer/scene/scene_lock.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include "base/error.h"
#include "renderer/image/provenance.h"
#include "renderer/scene/input_hash.h"
#include "renderer/scene/scene_schema.h"
#include "terrain/io/http_access.h"
#include "terrain/io/input_parts.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

// "terrain.sources.0.file" is the key "file" of the section "terrain.sources".
bool is_raster(const std::string& input_key) {
  std::string section;
  std::string last;
  std::istringstream words(input_key);
  for (std::string word; std::getline(words, word, '.');) {
    if (word.find_first_not_of("0123456789") == std::string::npos) continue;
    section = join_key(section, last);
    last = word;
  }
  const SceneSection* found = find_section(section);
  const SceneKey* key = found == nullptr ? nullptr : find_key(*found, last);
  return key != nullptr && key->raster;
}

// How the scene would name a file that belongs to one it names.
std::string name_of_part(const SceneInput& input, const std::string& part) {
  if (part == input.path) return input.file;
  if (is_address(part)) return part;
  const fs::path from_input =
      fs::absolute(part).lexically_relative(fs::absolute(input.path).parent_path());
  return (fs::path(input.file).parent_path() / from_input).lexically_normal().generic_string();
}

std::string in_words(const LockedInput& input) {
  return input.absent ? std::string("no such file")
                      : fmt::format("{} ({} bytes)", input.hash, input.bytes);
}

template <class T>
std::map<std::string, const T*> by_name(const std::vector<T>& things) {
  std::map<std::string, const T*> out;
  for (const T& thing : things) out[thing.file] = &thing;
  return out;
}

constexpr const char* not_locked = "not in the lock";

}  // namespace

std::string lock_path(const std::string& scene_path) {
  const fs::path path(scene_path);
  return path.extension() == ".toml" ? fs::path(path).replace_extension(".lock").string()
                                     : scene_path + ".lock";
}

std::vector<LockedInput> find_inputs(const LoadedScene& scene) {
  require_scene_files(scene);
  std::map<std::string, LockedInput> found;
  for (const SceneInput& input : scene_inputs(scene)) {
    if (input.path.empty()) {
      found[input.file] = {.file = input.file, .absent = true, .bytes = 0, .hash = {}};
      continue;
    }
    for (const std::string& part :
         is_raster(input.key) ? raster_parts(input.path) : vector_parts(input.path)) {
      const std::string name = name_of_part(input, part);
      if (found.contains(name)) continue;  // two sources of one file
      InputHash hash = hash_input(part);
      found[name] = {
          .file = name, .absent = false, .bytes = hash.bytes, .hash = std::move(hash.hash)};
    }
  }
  std::vector<LockedInput> out;
  for (auto& [name, input] : found) out.push_back(std::move(input));
  return out;
}

std::string hash_scene(const Scene& scene) { return hash_bytes(write_scene(scene)); }

std::vector<std::string> settings_of(const SceneLock& lock) {
  std::vector<std::string> settings = lock.settings;
  settings.push_back(fmt::format("output.width={}", lock.width));
  settings.push_back(fmt::format("output.height={}", lock.height));
  return settings;
}

std::vector<LockDifference> compare_inputs(const std::vector<LockedInput>& locked,
                                           const std::vector<LockedInput>& found) {
  std::vector<LockDifference> out;
  const auto old = by_name(locked);
  const auto now = by_name(found);
  for (const auto& [name, input] : old) {
    const auto at = now.find(name);
    if (at == now.end())
      out.push_back({name, "", in_words(*input), "the scene does not need it"});
    else if (*at->second != *input)
      out.push_back({name, "", in_words(*input), in_words(*at->second)});
  }
  for (const auto& [name, input] : now)
    if (!old.contains(name)) out.push_back({name, "", not_locked, in_words(*input)});
  return out;
}

std::vector<LockDifference> compare_products(const std::vector<LockedProduct>& locked,
                                             const std::vector<LockedProduct>& found) {
  std::vector<LockDifference> out;
  const auto old = by_name(locked);
  const auto now = by_name(found);
  for (const auto& [name, product] : old) {
    const auto at = now.find(name);
    if (at == now.end()) {
      out.push_back({name, "", fmt::format("{} channels", product->channels.size()), "not made"});
      continue;
    }
    std::map<std::string, std::string> hashes;
    for (const ChannelHash& one : at->second->channels) hashes[one.channel] = one.hash;
    for (const ChannelHash& one : product->channels) {
      const auto hash = hashes.find(one.channel);
      if (hash == hashes.end())
        out.push_back({name, one.channel, one.hash, "not made"});
      else if (hash->second != one.hash)
        out.push_back({name, one.channel, one.hash, hash->second});
      if (hash != hashes.end()) hashes.erase(hash);
    }
    for (const auto& [channel, hash] : hashes) out.push_back({name, channel, not_locked, hash});
  }
  for (const auto& [name, product] : now)
    if (!old.contains(name))
      out.push_back({name, "", not_locked, fmt::format("{} channels", product->channels.size())});
  return out;
}

std::string describe(const std::vector<LockDifference>& differences) {
  std::string out;
  for (const LockDifference& one : differences)
    out += fmt::format("\n  {}{}{}: {}{}, now {}", one.file, one.channel.empty() ? "" : " ",
                       one.channel, one.locked, one.locked == not_locked ? "" : " in the lock",
                       one.found);
  return out;
}

void require_locked_inputs(const LoadedScene& scene, const SceneLock& lock,
                           const std::string& scene_path) {
  const std::vector<LockDifference> changed = compare_inputs(lock.inputs, find_inputs(scene));
  if (changed.empty()) return;
  throw Error(
      ErrorKind::input, scene_path,
      fmt::format("{} from {}:{}",
                  changed.size() == 1 ? "an input differs"
                                      : fmt::format("{} inputs differ", changed.size()),
                  lock_path(scene_path), describe(changed)),
      fmt::format(
          "the files as locked; if the new ones are intended, run belvedere lock --update {}",
          scene_path));
}

}  // namespace belvedere
