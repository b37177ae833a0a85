#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/config.h"
#include "base/error.h"
#include "base/text/json.h"
#include "base/text/missing_file.h"
#include "renderer/scene/scene_lock.h"

namespace belvedere {
namespace {

constexpr int lock_format = 1;

constexpr const char* head =
    "# Inputs and hashes of the pixels made from them, written by `belvedere lock`. `belvedere "
    "verify` renders again and compares;\n"
    "# `belvedere lock --update` rewrites this file.\n";

const ConfigValue& need(const ConfigTable& table, std::string_view key, const std::string& name) {
  const ConfigValue* value = find(table, key);
  if (value == nullptr)
    throw Error(ErrorKind::input, name, fmt::format("{} is missing", key),
                "a lock written by belvedere lock");
  return *value;
}

std::string text_at(const ConfigTable& table, std::string_view key, const std::string& name) {
  return as_string(need(table, key, name), name);
}

int pixels_at(const ConfigTable& table, std::string_view key, const std::string& name) {
  constexpr std::int64_t max = 1 << 20;
  const std::int64_t value = as_integer(need(table, key, name), name);
  if (value < 1 || value > max)
    throw Error(ErrorKind::input, name, fmt::format("{} is {}", key, value),
                fmt::format("1 … {} px", max));
  return static_cast<int>(value);
}

LockedInput parse_input(const ConfigValue& value, const std::string& name) {
  const ConfigTable& table = as_table(value, name);
  allow_only(table, {"file", "absent", "bytes", "hash"}, name);
  LockedInput input{.file = text_at(table, "file", name), .absent = false, .bytes = 0, .hash = {}};
  if (const ConfigValue* absent = find(table, "absent");
      absent != nullptr && as_bool(*absent, name)) {
    input.absent = true;
    return input;
  }
  input.bytes = static_cast<std::uint64_t>(as_integer(need(table, "bytes", name), name));
  input.hash = text_at(table, "hash", name);
  return input;
}

SceneLock parse_strictly(const std::string& text, const std::string& name) {
  const ConfigValue root = parse_config(text, name);
  const ConfigTable& table = as_table(root, name);
  // A later format has other keys, so this is reported first.
  if (const std::int64_t version = as_integer(need(table, "version", name), name);
      version != lock_format)
    throw Error(ErrorKind::input, name, fmt::format("is a lock of format {}", version),
                fmt::format("format {}", lock_format));
  allow_only(table,
             {"version", "program", "scene", "width", "height", "settings", "inputs", "products"},
             name);
  SceneLock lock{.program = text_at(table, "program", name),
                 .scene = text_at(table, "scene", name),
                 .width = pixels_at(table, "width", name),
                 .height = pixels_at(table, "height", name),
                 .settings = {},
                 .inputs = {},
                 .products = {}};
  for (const ConfigValue& setting : as_array(need(table, "settings", name), name))
    lock.settings.push_back(as_string(setting, name));
  if (const ConfigValue* inputs = find(table, "inputs"))
    for (const ConfigValue& input : as_array(*inputs, name))
      lock.inputs.push_back(parse_input(input, name));
  for (const ConfigEntry& product : as_table(need(table, "products", name), name)) {
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
