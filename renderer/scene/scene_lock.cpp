#include "renderer/scene/scene_lock.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>

#include "base/config.h"
#include "base/error.h"
#include "base/text/json.h"
#include "base/text/missing_file.h"
#include "renderer/image/provenance.h"
#include "renderer/scene/scene_schema.h"
#include "terrain/io/http_access.h"
#include "terrain/io/raster_file.h"

namespace belvedere {
namespace {

InputHash hash_address(const std::string& address) {
  static std::mutex mutex;
  static std::map<std::string, InputHash> known;
  const std::lock_guard lock(mutex);
  if (const auto found = known.find(address); found != known.end()) return found->second;
  ContentHash hash;
  const std::uint64_t bytes =
      read_address(address, [&](std::string_view piece) { hash.add(piece); });
  return known[address] = {bytes, hash.digits()};
}

}  // namespace

InputHash hash_input(const std::string& path) {
  if (is_address(path)) return hash_address(path);
  InputHash out{.bytes = 0, .hash = hash_file(path)};
  std::error_code problem;
  out.bytes = std::filesystem::file_size(path, problem);
  if (problem) throw Error(ErrorKind::input, path, "the file has no size: " + problem.message());
  return out;
}

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

namespace {

constexpr int lock_format = 1;

constexpr const char* head =
    "# Inputs and hashes of the pixels made from them, written by `belvedere lock`. `belvedere "
    "verify` renders again and compares;\n"
    "# `belvedere lock --update` rewrites this file.\n";

const ConfigValue& value_at(const ConfigValue& table, const char* key, const std::string& name) {
  return required(table, key, name, "a lock written by belvedere lock");
}

std::string text_at(const ConfigValue& table, const char* key, const std::string& name) {
  return as_string(value_at(table, key, name), name);
}

int pixels_at(const ConfigValue& table, const char* key, const std::string& name) {
  return static_cast<int>(as_number(value_at(table, key, name), name, 1.0, 1 << 20));
}

LockedInput parse_input(const ConfigValue& value, const std::string& name) {
  const ConfigTable& table = as_table(value, name);
  allow_only(table, {"file", "absent", "bytes", "hash"}, name);
  LockedInput input{.file = text_at(value, "file", name), .absent = false, .bytes = 0, .hash = {}};
  if (const ConfigValue* absent = find(table, "absent")) input.absent = as_bool(*absent, name);
  if (input.absent) return input;
  input.bytes = static_cast<std::uint64_t>(as_integer(value_at(value, "bytes", name), name));
  input.hash = text_at(value, "hash", name);
  return input;
}

SceneLock parse_strictly(const std::string& text, const std::string& name) {
  const ConfigValue root = parse_config(text, name);
  // A later format has other keys, so this is reported first.
  if (const std::int64_t version = as_integer(value_at(root, "version", name), name);
      version != lock_format)
    throw Error(ErrorKind::input, name, fmt::format("is a lock of format {}", version),
                fmt::format("format {}", lock_format));
  const ConfigTable& table = as_table(root, name);
  allow_only(table,
             {"version", "program", "scene", "width", "height", "settings", "inputs", "products"},
             name);
  SceneLock lock{.program = text_at(root, "program", name),
                 .scene = text_at(root, "scene", name),
                 .width = pixels_at(root, "width", name),
                 .height = pixels_at(root, "height", name),
                 .settings = as_strings(value_at(root, "settings", name), name),
                 .inputs = {},
                 .products = {}};
  if (const ConfigValue* inputs = find(table, "inputs"))
    for (const ConfigValue& input : as_array(*inputs, name))
      lock.inputs.push_back(parse_input(input, name));
  for (const ConfigEntry& product : as_table(value_at(root, "products", name), name)) {
    LockedProduct& out = lock.products.emplace_back();
    out.file = product.key;
    for (const ConfigEntry& channel : as_table(product.value, name))
      out.channels.push_back({channel.key, as_string(channel.value, name)});
  }
  return lock;
}

}  // namespace

std::string write_lock(const SceneLock& lock) {
  std::string settings;
  for (const std::string& setting : lock.settings)
    settings += (settings.empty() ? "" : ", ") + json_quoted(setting);
  std::string out = head;
  out += fmt::format(
      "version = {}\nprogram = {}\nscene = {}\nwidth = {}\nheight = {}\nsettings = [{}]\n",
      lock_format, json_quoted(lock.program), json_quoted(lock.scene), lock.width, lock.height,
      settings);
  std::vector<LockedInput> inputs = lock.inputs;
  std::sort(inputs.begin(), inputs.end(),
            [](const LockedInput& a, const LockedInput& b) { return a.file < b.file; });
  for (const LockedInput& input : inputs) {
    out += fmt::format("\n[[inputs]]\nfile = {}\n", json_quoted(input.file));
    out += input.absent
               ? std::string("absent = true\n")
               : fmt::format("bytes = {}\nhash = {}\n", input.bytes, json_quoted(input.hash));
  }
  if (lock.products.empty()) out += "\n[products]\n";
  std::vector<LockedProduct> products = lock.products;
  std::sort(products.begin(), products.end(),
            [](const LockedProduct& a, const LockedProduct& b) { return a.file < b.file; });
  for (const LockedProduct& product : products) {
    out += fmt::format("\n[products.{}]\n", json_quoted(product.file));
    for (const ChannelHash& channel : product.channels)
      out += fmt::format("{} = {}\n", json_quoted(channel.channel), json_quoted(channel.hash));
  }
  return out;
}

SceneLock parse_lock(const std::string& text, const std::string& name) {
  try {
    return parse_strictly(text, name);
  } catch (const Error& error) {
    // Locks are not written by hand, so an error in one is an error of the data.
    if (error.kind() != ErrorKind::usage) throw;
    throw Error(ErrorKind::input, error.where(), error.found(),
                "a lock written by belvedere lock --update");
  }
}

SceneLock read_lock(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    throw missing_file(path, "a lock made by belvedere lock SCENE");
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return parse_lock(text.str(), path);
}

}  // namespace belvedere
