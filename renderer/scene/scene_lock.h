#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/image/picture_hash.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

// What a scene was made from and what came of it, to be kept beside it: whoever renders it elsewhere, or with a later version, learns
// whether it is still the same. `belvedere lock` writes it, --locked and `belvedere verify` read it.

struct LockedInput {
  std::string file;         // as the scene writes it; what belongs to it as if the scene had: "dem/all.vrt" → "dem/tiles/n47.tif"
  bool absent = false;      // an optional one that was not there
  std::uint64_t bytes = 0;  // its size
  std::string hash;         // hash_file of its bytes
  friend bool operator==(const LockedInput&, const LockedInput&) = default;
};

struct LockedProduct {
  std::string file;                   // "guidance.exr"
  std::vector<ChannelHash> channels;  // of its pixels
};

struct SceneLock {
  std::string program;                  // version that made it
  std::string scene;                    // hash of all that the scene says, what it leaves to the program included
  int width = 0;                        // of the picture that is verified, px
  int height = 0;                       // px
  std::vector<std::string> settings;    // key=value, as --set had them
  std::vector<LockedInput> inputs;      // by name
  std::vector<LockedProduct> products;  // by name
};

// A thing that is not as the lock has it. In words: a hash, "no such file", "not in the lock" ….
struct LockDifference {
  std::string file;     // an input or a product
  std::string channel;  // of a product; empty: the whole
  std::string locked;
  std::string found;
};

// "scenes/alps.lock" for "scenes/alps.toml".
std::string lock_path(const std::string& scene_path);
// As TOML: what is the same gives the same text.
std::string write_lock(const SceneLock& lock);
// Error(input) for what is no lock of this version's format. name: of the file, for messages.
SceneLock parse_lock(const std::string& text, const std::string& name);
// The same of a file; Error(input) that says how to make one where there is none.
SceneLock read_lock(const std::string& path);

// The scene's inputs as they are now, with all files behind each raster; Error(input) where one is missing or damaged.
std::vector<LockedInput> find_inputs(const LoadedScene& scene);
// The hash of what the scene says.
std::string hash_scene(const Scene& scene);
// Settings of a lock's picture: its own, then its size.
std::vector<std::string> settings_of(const SceneLock& lock);

std::vector<LockDifference> compare_inputs(const std::vector<LockedInput>& locked, const std::vector<LockedInput>& found);
std::vector<LockDifference> compare_products(const std::vector<LockedProduct>& locked, const std::vector<LockedProduct>& found);
// A line each, "  guidance.exr Z: 0123… in the lock, now 4567…", each after a line break.
std::string describe(const std::vector<LockDifference>& differences);

// Error(input) that names every input which is not as the lock has it. scene_path: of the scene file.
void require_locked_inputs(const LoadedScene& scene, const SceneLock& lock, const std::string& scene_path);

}  // namespace belvedere
