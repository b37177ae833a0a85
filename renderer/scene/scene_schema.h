#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "renderer/scene/scene.h"

namespace belvedere {

// The one table of the keys of a scene file. Validation, defaults, the JSON Schema, the written
// reference and write_scene all read it; a new key is one row in the scene_table_*.cpp of its part
// and nothing else.

// The value of a key inside a Scene. Its C++ type decides the type in the file; defaults are those
// of a fresh Scene.
using SceneField =
    std::variant<bool*, std::optional<bool>*, int*, std::uint64_t*, double*, float*, std::string*,
                 std::optional<double>*, std::optional<glm::dvec2>*, std::array<double, 2>*,
                 std::optional<std::array<double, 4>>*, std::vector<glm::dvec2>*,
                 std::vector<float>*, std::optional<LandCoverClass>*, std::vector<LandCoverClass>*,
                 std::vector<std::string>*, std::vector<std::pair<std::string, double>>*,
                 std::vector<std::pair<LandCoverClass, LandCoverClass>>*>;

// Kind of content of a string, by which it is checked.
enum class TextKind {
  plain,     // any words
  choice,    // one of `choices`
  file,      // a file beside the scene or in a --data folder
  built_in,  // a name from the embedded folder `choices_from`, or a .toml or .csv file
  crs,       // a coordinate reference system; GDAL checks it when data are read
  time,      // ISO 8601 with zone
  date,      // month and day, "10-05"
};

struct SceneRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool above_min = false;  // min itself is not allowed
};

struct SceneKey {
  std::string_view name;
  // The key's place in a scene; `i` counts elements where the section is a list.
  SceneField (*field)(Scene& scene, std::size_t i);
  SceneRange range = {};          // of numbers, and of each element of arrays and name tables
  std::string_view unit = {};     // "m", "°", "px"; empty: a plain number
  std::string_view meaning = {};  // one line, for cartographers
  TextKind text = TextKind::plain;
  std::vector<std::string> choices = {};  // of TextKind::choice, of a list of names, and of the
                                          // names in a table of numbers (empty there: any)
  std::string_view choices_from = {};     // embedded folder of TextKind::built_in
  bool required = false;
  bool lonlat = false;            // a pair of longitude and latitude
  bool raster = false;            // a file that may also lie on a server
  std::string_view derived = {};  // of an optional number or flag: what is used where the key is
                                  // absent or "auto"; empty: not applicable
};

enum class SectionKind {
  single,    // [camera]
  optional,  // [terrain.synthetic]: its presence has a meaning
  list,      // [[exemplar]]
};

struct SceneSection {
  std::string_view name;  // dotted; empty for the top-level keys
  SectionKind kind = SectionKind::single;
  std::string_view meaning = {};
  std::vector<SceneKey> keys = {};
  std::size_t (*count)(const Scene& scene) = nullptr;  // of optional (0 or 1) and list sections
  void (*resize)(Scene& scene, std::size_t count) = nullptr;
};

// Alternatives within a section: if one of `these` is given, none of `those` may be.
struct SceneExclusion {
  std::string_view section;
  std::vector<std::string_view> these;
  std::vector<std::string_view> those;
};

// Builds the table (scene_table.cpp from the parts beside it); all other code calls
// scene_sections().
std::vector<SceneSection> make_scene_sections();
// Parents before children, in the order of the reference.
const std::vector<SceneSection>& scene_sections();
const std::vector<SceneExclusion>& scene_exclusions();
// Null where there is none of that name.
const SceneSection* find_section(std::string_view name);
const SceneKey* find_key(const SceneSection& section, std::string_view name);
// The sections directly below: "sources", "synthetic" for "terrain".
std::vector<const SceneSection*> child_sections(std::string_view parent);
// "camera" and "pitch" to "camera.pitch".
std::string join_key(std::string_view section, std::string_view key);
// "-90 … 90°", "more than 0, at most 1000 m", or empty where there is no limit.
std::string describe_range(const SceneKey& key);
// The type of a key in the file: "a whole number", "two numbers [E, N]", "one of a, b, c", "a class
// name" …
std::string describe_type(const SceneKey& key);
// The names a built_in or choice key accepts.
std::vector<std::string> key_choices(const SceneKey& key);

}  // namespace belvedere
