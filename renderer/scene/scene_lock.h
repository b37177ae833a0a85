#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/image/picture_diff.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

// The inputs of a scene and the hashes of its pixels, kept beside it, so that another machine or a
// later version can check whether the result is still the same. `belvedere lock` writes it;
// --locked and `belvedere verify` read it.

struct LockedInput {
  std::string file;  // as written in the scene; files that belong to it are named as if the scene
                     // named them: "dem/all.vrt" → "dem/tiles/n47.tif"
  bool absent = false;      // an optional file that was missing
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
  std::string scene;                    // hash of all keys of the scene, defaults included
  int width = 0;                        // of the picture that is verified, px
  int height = 0;                       // px
  std::vector<std::string> settings;    // key=value, as given to --set
  std::vector<LockedInput> inputs;      // by name
  std::vector<LockedProduct> products;  // by name
};

// A difference from the lock. In words: a hash, "no such file", "not in the lock" ….
struct LockDifference {
  std::string file;     // an input or a product
  std::string channel;  // of a product; empty: the whole
  std::string locked;
  std::string found;
};

// "scenes/alps.lock" for "scenes/alps.toml".
std::string lock_path(const std::string& scene_path);
// As TOML; equal locks give equal text.
std::string write_lock(const SceneLock& lock);
// Error(input) for text that is not a lock of this version's format. name: of the file, for
// messages.
SceneLock parse_lock(const std::string& text, const std::string& name);
// Reads it from a file; Error(input) where there is none, with how to make one.
SceneLock read_lock(const std::string& path);

// The scene's present inputs, with all files behind each raster; Error(input) where one is missing
// or damaged.
std::vector<LockedInput> find_inputs(const LoadedScene& scene);
// The hash of the scene's keys.
std::string hash_scene(const Scene& scene);
// Settings of a lock's picture: its own, then its size.
std::vector<std::string> settings_of(const SceneLock& lock);

std::vector<LockDifference> compare_inputs(const std::vector<LockedInput>& locked,
                                           const std::vector<LockedInput>& found);
std::vector<LockDifference> compare_products(const std::vector<LockedProduct>& locked,
                                             const std::vector<LockedProduct>& found);
// One line each, "  guidance.exr Z: 0123… in the lock, now 4567…", each after a line break.
std::string describe(const std::vector<LockDifference>& differences);

// Error(input) that lists every input that differs from the lock. scene_path: of the scene file.
void require_locked_inputs(const LoadedScene& scene, const SceneLock& lock,
                           const std::string& scene_path);

// Identifies the content of a file.
struct InputHash {
  std::uint64_t bytes = 0;  // its size
  std::string hash;         // hash_file of its bytes
};

// For a file that a scene reads, by its path or, where servers may be asked, its address. A remote
// file is then downloaded whole, once per process. Error(input) where it cannot be read.
InputHash hash_input(const std::string& path);

}  // namespace belvedere
