#include "renderer/scene/edit/scene_edit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "renderer/scene/edit/edited_text.h"
#include "renderer/scene/scene_file.h"
#include "tests/files.h"
#include "tests/paths.h"
#include "tests/renderer/scene/written_scene.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using test::usage_error;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

SceneEdit set(std::string key, std::string value) {
  return {.key = std::move(key), .value = std::move(value)};
}
SceneEdit removal(std::string key) { return {.key = std::move(key), .value = std::nullopt}; }
SceneEdit append(std::string key, std::string value) {
  return {.key = std::move(key), .value = std::move(value), .append = true};
}

std::string edited(const std::string& text, const std::vector<SceneEdit>& edits) {
  return edit_scene_text(text, "s.toml", edits);
}

struct Change {
  const char* what;
  std::string before;
  std::vector<SceneEdit> edits;
  std::string after;
};

void expect_changes(const std::vector<Change>& changes) {
  for (const Change& change : changes)
    EXPECT_EQ(edited(change.before, change.edits), change.after) << change.what;
}

TEST(SceneEdit, ReplacesValues) {
  expect_changes({
      {"a number",
       "[camera]\ntilt_deg = 1 # steep\n",
       {set("camera.tilt_deg", "2.5")},
       "[camera]\ntilt_deg = 2.5 # steep\n"},
      {"an array of many lines",
       "[generalize]\nforeground = [\n  1, # low\n  2,\n]\nscale=1\n",
       {set("generalize.foreground", "[3, 4]")},
       "[generalize]\nforeground = [3, 4]\nscale=1\n"},
      {"one element of it",
       "[generalize]\nforeground = [\n  1, # low\n  2,\n]\n",
       {set("generalize.foreground.1", "9")},
       "[generalize]\nforeground = [\n  1, # low\n  9,\n]\n"},
      {"a text of many lines",
       "title = \"\"\"\nA\nseed = 1\n\"\"\"\nseed = 2\n",
       {set("title", "\"B\""), set("seed", "3")},
       "title = \"B\"\nseed = 3\n"},
      {"a dotted key",
       "[deform]\nbend.radius_m = 3\n",
       {set("deform.bend.radius_m", "4")},
       "[deform]\nbend.radius_m = 4\n"},
      {"in an inline table",
       "[land_cover]\nsettings = { a = 1, b.c = 2 } # x\n",
       {set("land_cover.settings.b.c", "3")},
       "[land_cover]\nsettings = { a = 1, b.c = 3 } # x\n"},
      {"a quoted key",
       "[ \"camera\" ]\n'tilt_deg'=1\n",
       {set("camera.tilt_deg", "2")},
       "[ \"camera\" ]\n'tilt_deg'=2\n"},
      {"in an element",
       "[[exemplar]]\nseed = 1\n[[exemplar]]\nseed = 2\n",
       {set("exemplar.1.seed", "3")},
       "[[exemplar]]\nseed = 1\n[[exemplar]]\nseed = 3\n"},
      {"lines that end in CR LF, the last in nothing",
       "seed = 1\r\n[sun]\r\nazimuth_deg = 2",
       {set("sun.azimuth_deg", "3")},
       "seed = 1\r\n[sun]\r\nazimuth_deg = 3"},
      {"the short form of a table",
       "style = \"monet\"\n",
       {set("style.file", "\"a.style\"")},
       "style = \"a.style\"\n"},
      {"beside the short form",
       "style = \"monet\"\nseed = 1\n",
       {set("style.sky", "0.5")},
       "style.file = \"monet\"\nstyle.sky = 0.5\nseed = 1\n"},
      {"by the short form",
       "[style]\nfile = \"monet\"\n",
       {set("style", "\"rubens\"")},
       "[style]\nfile = \"rubens\"\n"},
      {"a table with a header, member by member",
       "[land_cover.settings]\n# low\na = 1 # one\nb = 2\n\n[sun]\n",
       {set("land_cover.settings", "{ c = 3, a = 4 }")},
       "[land_cover.settings]\n# low\na = 4 # one\nc = 3\n\n[sun]\n"},
      {"a list with headers, element by element",
       "[[exemplar]]\nseed = 1 # one\n[[exemplar]]\nseed = 2\n[[exemplar]]\nseed = 3\n",
       {set("exemplar", "[{ seed = 4 }, { seed = 5 }]")},
       "[[exemplar]]\nseed = 4 # one\n[[exemplar]]\nseed = 5\n"},
  });
}

// The column where comments stand in one; else the distance to the value.
TEST(SceneEdit, KeepsThePlaceOfComments) {
  const std::string text = "[air]\nfrom_m = 34000  # from\nhaze = 1 # haze\n";
  expect_changes({
      {"shorter", text, {set("air.from_m", "3")}, "[air]\nfrom_m = 3  # from\nhaze = 1 # haze\n"},
      {"longer",
       text,
       {set("air.haze", "0.25")},
       "[air]\nfrom_m = 34000  # from\nhaze = 0.25 # haze\n"},
  });
  const std::string columns = "[air]\nfrom_m = 34000   # from\nscale_m = 6      # scale\n";
  expect_changes({
      {"in the column",
       columns,
       {set("air.from_m", "3")},
       "[air]\nfrom_m = 3       # from\nscale_m = 6      # scale\n"},
      {"pushed out",
       columns,
       {set("air.scale_m", "1234567")},
       "[air]\nfrom_m = 34000   # from\nscale_m = 1234567 # scale\n"},
      {"and back", columns, {set("air.scale_m", "1234567"), set("air.scale_m", "6")}, columns},
  });
}

TEST(SceneEdit, AddsKeys) {
  expect_changes({
      {"after the last of the table",
       "[sun]\n  azimuth_deg = 1 # west\n  # below\n\n[air]\n",
       {set("sun.altitude_deg", "2")},
       "[sun]\n  azimuth_deg = 1 # west\n  altitude_deg = 2\n  # below\n\n[air]\n"},
      {"at the top",
       "version = 1\n\n[sun]\n",
       {set("seed", "2")},
       "version = 1\nseed = 2\n\n[sun]\n"},
      {"below a header alone",
       "[sun]\n[air]\nhaze = 1\n",
       {set("sun.altitude_deg", "2")},
       "[sun]\naltitude_deg = 2\n[air]\nhaze = 1\n"},
      {"in a new table at the end",
       "seed = 1\n",
       {set("sun.altitude_deg", "2")},
       "seed = 1\n\n[sun]\naltitude_deg = 2\n"},
      {"without a line break at the end",
       "seed = 1\r\n[sun]\r\naltitude_deg = 1",
       {set("sun.azimuth_deg", "2"), set("air.haze", "3")},
       "seed = 1\r\n[sun]\r\naltitude_deg = 1\r\nazimuth_deg = 2\r\n\r\n[air]\r\nhaze = 3"},
      {"in an empty text",
       "",
       {set("seed", "2"), set("sun.altitude_deg", "3")},
       "seed = 2\n\n[sun]\naltitude_deg = 3\n"},
      {"in a new table below its parent",
       "[deform]\nexaggeration = 1\n\n# how\n[camera]\ntilt_deg = 1\n",
       {set("deform.bend.radius_m", "2")},
       "[deform]\nexaggeration = 1\n\n[deform.bend]\nradius_m = 2\n\n# how\n[camera]\ntilt_deg = "
       "1\n"},
      {"in a table that only has children",
       "seed = 1\n\n# bent\n[deform.bend]\nradius_m = 2\n",
       {set("deform.exaggeration", "3")},
       "seed = 1\n\n[deform]\nexaggeration = 3\n\n# bent\n[deform.bend]\nradius_m = 2\n"},
      {"beside a dotted key",
       "[deform]\nbend.radius_m = 3\nexaggeration = 1\n",
       {set("deform.bend.crest_m", "4")},
       "[deform]\nbend.radius_m = 3\nbend.crest_m = 4\nexaggeration = 1\n"},
      {"beside a dotted table at the top",
       "sun.altitude_deg = 3\nseed = 1\n",
       {set("sun.azimuth_deg", "4"), set("air.haze", "5")},
       "sun.altitude_deg = 3\nsun.azimuth_deg = 4\nseed = 1\n\n[air]\nhaze = 5\n"},
      {"in an inline table",
       "[land_cover]\nsettings = { a = 1 } # x\nerode = {}\n",
       {set("land_cover.settings.b", "2"), set("land_cover.erode.rock", "3")},
       "[land_cover]\nsettings = { a = 1, b = 2 } # x\nerode = { rock = 3 }\n"},
      {"in an inline table with dotted keys",
       "deform = { bend.radius_m = 1 }\n",
       {set("deform.bend.crest_m", "2")},
       "deform = { bend.radius_m = 1, bend.crest_m = 2 }\n"},
      {"below an inline table",
       "deform = { exaggeration = 1 }\n",
       {set("deform.bend.crest_m", "2"), set("deform.handles.0.radius_m", "3")},
       "deform = { exaggeration = 1, bend = { crest_m = 2 }, handles = [{ radius_m = 3 }] }\n"},
      {"in the table of an element",
       "[[a]]\nb = 1\n[[a]]\nb = 2\n",
       {set("a.0.c.d", "3")},
       "[[a]]\nb = 1\n[a.c]\nd = 3\n[[a]]\nb = 2\n"},
      {"one element of an array that only has defaults",
       "[generalize]\nscale = 1\n",
       {set("generalize.mask_slope_deg.1", "40")},
       "[generalize]\nscale = 1\nmask_slope_deg = [0, 40]\n"},
      {"a name with a space",
       "[land_cover]\nrock = \"granite\"\n",
       {set("land_cover.settings.odd name", "1")},
       "[land_cover]\nrock = \"granite\"\n\n[land_cover.settings]\n\"odd name\" = 1\n"},
  });
}

TEST(SceneEdit, AddsElements) {
  const std::string handle = "{ position = [1, 2], radius_m = 3000 }";
  const std::string lines = "[[deform.handles]]\nposition = [1, 2]\nradius_m = 3000\n";
  expect_changes({
      {"the first",
       "[deform]\nbend.radius_m = 1\n\n[sun]\naltitude_deg = 1\n",
       {append("deform.handles", handle)},
       "[deform]\nbend.radius_m = 1\n\n" + lines + "\n[sun]\naltitude_deg = 1\n"},
      {"at the end", "seed = 1\n", {append("deform.handles", handle)}, "seed = 1\n\n" + lines},
      {"after a single one",
       lines + "\n[sun]\n",
       {append("deform.handles", handle)},
       lines + "\n" + lines + "\n[sun]\n"},
      {"as close as the others",
       lines + lines + "[sun]\n",
       {append("deform.handles", handle)},
       lines + lines + lines + "[sun]\n"},
      {"after the tables of the last one",
       "[[a]]\nb = 1\n[a.c]\nd = 2\n\n# e\n[e]\n",
       {append("a", "{ b = 3 }")},
       "[[a]]\nb = 1\n[a.c]\nd = 2\n\n[[a]]\nb = 3\n\n# e\n[e]\n"},
      {"by one of its keys",
       "seed = 1\n",
       {set("deform.handles.0.radius_m", "2")},
       "seed = 1\n\n[[deform.handles]]\nradius_m = 2\n"},
      {"inline",
       "[deform]\nhandles = [{ radius_m = 1 }]\n",
       {append("deform.handles", handle)},
       "[deform]\nhandles = [{ radius_m = 1 }, " + handle + "]\n"},
      {"inline by one of its keys",
       "[deform]\nhandles = []\n",
       {set("deform.handles.0.radius_m", "2")},
       "[deform]\nhandles = [{ radius_m = 2 }]\n"},
      {"on lines of their own",
       "[a]\nb = [\n  1, # one\n  2  # two\n]\n",
       {append("a.b", "3"), append("a.b", "4")},
       "[a]\nb = [\n  1, # one\n  2,  # two\n  3,\n  4\n]\n"},
      {"with a comma at the end",
       "[a]\nb = [\n  1,\n]\n",
       {append("a.b", "2")},
       "[a]\nb = [\n  1,\n  2,\n]\n"},
      {"before a closing bracket on the same line",
       "[a]\nb = [\n  1]\n",
       {append("a.b", "2")},
       "[a]\nb = [\n  1,\n  2]\n"},
  });
}

TEST(SceneEdit, Removes) {
  const std::string list =
      "# All of them.\n[[a]]\nb = 0\n\n[[a]]\nb = 1\n[a.c]\nd = 1\n# of d\n\n[[a]]\nb = 2\n";
  expect_changes({
      {"a key with its comment",
       "# s\n[sun]\n# a\naltitude_deg = 1 # b\nazimuth_deg = 2\n",
       {removal("sun.altitude_deg")},
       "# s\n[sun]\n# a\nazimuth_deg = 2\n"},
      {"the last key of a table",
       "seed = 1\n\n[sun]\naltitude_deg = 1\n\n[air]\nhaze = 1\n",
       {removal("sun.altitude_deg")},
       "seed = 1\n\n[air]\nhaze = 1\n"},
      {"the last key of a table with comments",
       "# s\n\n# t\n[sun]\naltitude_deg = 1\n[air] # a\nhaze = 1\n[camera]\n# c\ntilt_deg = 2\n",
       {removal("sun.altitude_deg"), removal("air.haze"), removal("camera.tilt_deg")},
       "# s\n\n# t\n[sun]\n[air] # a\n[camera]\n# c\n"},
      {"the last key of the last table",
       "seed = 1\n\n[sun]\naltitude_deg = 1",
       {removal("sun.altitude_deg")},
       "seed = 1"},
      {"the last key of nested tables",
       "seed = 1\n[deform]\n[deform.bend]\nradius_m = 1\n",
       {removal("deform.bend.radius_m")},
       "seed = 1\n"},
      {"the last key of a table with a meaning",
       "[terrain.synthetic]\nwidth = 64\n",
       {removal("terrain.synthetic.width")},
       "[terrain.synthetic]\n"},
      {"the last key of an element",
       "[[exemplar]]\nseed = 1\n",
       {removal("exemplar.0.seed")},
       "[[exemplar]]\n"},
      {"the last member of an inline table",
       "seed = 1\nsun = { altitude_deg = 1 }\n",
       {removal("sun.altitude_deg")},
       "seed = 1\n"},
      {"members of inline tables",
       "a = { b = 1, c = 2, d = 3, e = 4 } # f\n",
       {removal("a.b"), removal("a.d"), removal("a.e")},
       "a = { c = 2 } # f\n"},
      {"a table",
       "# d\n[deform]\nx = 1\n\n# b\n[deform.bend]\n# r\nradius_m = 1\n\n[sun]\n",
       {removal("deform.bend")},
       "# d\n[deform]\nx = 1\n\n[sun]\n"},
      {"a table of dotted keys",
       "[deform]\nbend.radius_m = 1\nx = 1\nbend.crest_m = 1\n",
       {removal("deform.bend")},
       "[deform]\nx = 1\n"},
      {"the first element",
       list,
       {removal("a.0")},
       "# All of them.\n[[a]]\nb = 1\n[a.c]\nd = 1\n# of d\n\n[[a]]\nb = 2\n"},
      {"one element with its tables",
       list,
       {removal("a.1")},
       "# All of them.\n[[a]]\nb = 0\n\n[[a]]\nb = 2\n"},
      {"the last element",
       list,
       {removal("a.2")},
       "# All of them.\n[[a]]\nb = 0\n\n[[a]]\nb = 1\n[a.c]\nd = 1\n# of d\n"},
      {"a list", "seed = 1\n\n" + list, {removal("a")}, "seed = 1\n"},
      {"an element with its comment",
       "x = 1\n# zero\n[[a]]\nb = 0\n# one\n[[a]]\nb = 1\n",
       {removal("a.0")},
       "x = 1\n# one\n[[a]]\nb = 1\n"},
      {"elements of arrays",
       "a = [1, 2, 3]\nb = [\n  1, # one\n  2, # two\n  3 # three\n]\n",
       {removal("a.0"), removal("a.1"), removal("b.2"), removal("b.0")},
       "a = [2]\nb = [\n  2 # two\n]\n"},
      {"what is missing", "seed = 1\n", {removal("sun"), removal("sun.time")}, "seed = 1\n"},
  });
}

TEST(SceneEdit, AlternativesOfAKeyAreRemoved) {
  expect_changes({
      {"one",
       "[sun]\ntime = \"2024-06-21T17:30:00Z\" # solstice\n",
       {set("sun.azimuth_deg", "90")},
       "[sun]\nazimuth_deg = 90\n"},
      {"several",
       "sun = { azimuth_deg = 1, altitude_deg = 2 }\n",
       {set("sun.time", "2024-06-21T17:30:00Z")},
       "sun = { time = 2024-06-21T17:30:00Z }\n"},
      {"in an element",
       "[[light.regions]]\nposition = [1, 2]\nradius_m = 3\n",
       {set("light.regions.0.file", "\"a.geojson\"")},
       "[[light.regions]]\nfile = \"a.geojson\"\n"},
      {"which is removed again",
       "[sun]\ntime = \"2024-06-21T17:30:00Z\"\n",
       {set("sun.azimuth_deg", "200"), removal("sun.time")},
       "[sun]\nazimuth_deg = 200\n"},
  });
}

TEST(SceneEdit, RefusesWhatItCannotWrite) {
  const auto refused = [](const std::string& text, const SceneEdit& edit) {
    return usage_error([&] { edited(text, {edit}); });
  };
  EXPECT_THAT(refused("seed = = 1\n", set("seed", "2")), StartsWith("s.toml:1:8: "));
  EXPECT_THAT(refused("seed = 1\n", set("seed", "red")),
              AllOf(StartsWith("seed: the value red is not valid"), HasSubstr("TOML")));
  EXPECT_THAT(refused("seed = 1\n", set("seed", "2\nversion = 3")), HasSubstr("is not one value"));
  EXPECT_THAT(refused("seed = 1\n", set("seed.x", "2")),
              StartsWith("seed.x: nothing can be set below x, which is the number 1"));
  EXPECT_THAT(refused("seed = 1\n", set("sun..x", "2")), StartsWith("sun..x: a part of the key"));
  EXPECT_THAT(refused("[[exemplar]]\nseed = 1\n", set("exemplar.seed", "2")),
              StartsWith("exemplar.seed: \"seed\" is not an index of a list of 1"));
  EXPECT_THAT(refused("[[exemplar]]\nseed = 1\n", set("exemplar.2.seed", "2")),
              StartsWith("exemplar.2.seed: \"2\" is not an index of a list of 1"));
  EXPECT_THAT(refused("[[exemplar]]\nseed = 1\n", removal("exemplar.1")),
              AllOf(StartsWith("exemplar.1: \"1\" is not an index"), HasSubstr("0 … 0")));
  EXPECT_THAT(refused("seed = 1\n", append("seed", "2")),
              StartsWith("seed: nothing can be appended to the number 1"));
  // The comment would hide the closing brace.
  EXPECT_THAT(refused("sun = { altitude_deg = 1 }\n", set("sun.altitude_deg", "1 # low")),
              AllOf(StartsWith("sun.altitude_deg: the text of s.toml cannot be changed"),
                    HasSubstr("change the text itself")));
}

std::vector<fs::path> scene_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(test::source_folder() + "/scenes"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

LoadedScene read(const std::string& text, std::vector<std::string> settings = {}) {
  return parse_scene(text, "s.toml", ".", {.data_folders = {}, .settings = std::move(settings)});
}

// What a text says, or what is wrong with it.
struct Meaning {
  std::optional<Scene> scene;
  std::string text;

  explicit Meaning(const std::string& toml, std::vector<std::string> settings = {}) {
    try {
      scene = read(toml, std::move(settings)).scene;
      // The order of rules' settings means nothing: an edit keeps that of the text.
      std::sort(scene->land_cover.settings.begin(), scene->land_cover.settings.end());
      text = write_scene(*scene);
    } catch (const Error& error) {
      text = error.found();
    }
  }
};

// For each key, without indices, the values it has in some scene, as --set takes them.
using Values = std::vector<std::pair<std::string, std::vector<std::string>>>;

Values values_of_scenes() {
  std::map<std::string, std::vector<std::string>> values;
  for (const fs::path& file : scene_files()) {
    Scene scene = read(test::read_bytes(file)).scene;
    for (const SceneSection& section : scene_sections())
      for (std::size_t i = 0; i < (section.count == nullptr ? 1 : section.count(scene)); ++i)
        for (const SceneKey& key : section.keys)
          if (const std::string value = value_text(key.field(scene, i)); !value.empty())
            values[join_key(section.name, key.name)].push_back(value);
  }
  return {values.begin(), values.end()};
}

std::multiset<std::string> comments(const std::string& text) {
  std::multiset<std::string> lines;
  for (const TomlPart& part : toml_layout(text))
    if (part.kind == TomlPart::Kind::comment)
      lines.insert(text.substr(part.whole.begin, part.whole.end - part.whole.begin));
  return lines;
}

TomlPath path_of(const std::string& key) {
  TomlPath path;
  for (std::size_t at = 0; at <= key.size(); at = std::min(key.find('.', at), key.size()) + 1)
    path.push_back(key.substr(at, key.find('.', at) - at));
  return path;
}

// Whether all keys of a text are in another one.
bool keeps_keys(const std::string& text, const std::string& other) {
  const EditedText kept(other);
  const std::vector<TomlPart> layout = toml_layout(text);
  return std::all_of(layout.begin(), layout.end(), [&](const TomlPart& part) {
    return part.kind != TomlPart::Kind::value || kept.exists(part.path);
  });
}

class EditedScenes : public testing::TestWithParam<fs::path> {};

// Keys are set to values they have in some scene, added, and removed, 300 times in a row. Each text
// means what --set makes of the text before; no comment is lost; and the way back leads to the same
// bytes, unless alternatives went or a short form became a long one.
TEST_P(EditedScenes, MeanWhatSettingsMeanAndLeadBack) {
  static const Values values = values_of_scenes();
  ASSERT_GT(values.size(), 100U);
  std::string text = test::read_bytes(GetParam());
  Meaning now(text);
  int replaced = 0, added = 0, removed = 0, drawn = 0;
  const auto draw = [&](std::size_t count) {
    return random_index(static_cast<std::uint32_t>(count), 7, ++drawn, 0);
  };
  for (int n = 0; n < 300; ++n) {
    const auto& [name, texts] = values[draw(values.size())];
    const std::size_t dot = name.rfind('.');
    const std::string section_name = name.substr(0, dot == std::string::npos ? 0 : dot);
    const SceneSection& section = *find_section(section_name);
    const std::size_t count = section.count == nullptr ? 1 : section.count(*now.scene);
    const std::size_t i = draw(count + 1);
    const std::string table =
        section.kind == SectionKind::list ? section_name + "." + std::to_string(i) : section_name;
    const std::string key = join_key(table, name.substr(dot == std::string::npos ? 0 : dot + 1));
    const std::string& value = texts[draw(texts.size())];
    const EditedText layout(text);
    const std::optional<std::string> former = layout.value_at(path_of(key));

    if (former && draw(3) == 0) {
      const std::string without = edited(text, {removal(key)});
      EXPECT_FALSE(EditedText(without).exists(path_of(key))) << key;
      EXPECT_EQ(comments(without), comments(text)) << key;
      EXPECT_EQ(Meaning(edited(without, {set(key, *former)})).text, now.text) << key;
      if (Meaning less(without); less.scene) {
        text = without;
        now = less;
        ++removed;
      }
      continue;
    }
    const std::string changed = edited(text, {set(key, value)});
    Meaning meant(changed);
    ASSERT_EQ(meant.text, Meaning(text, {key + "=" + value}).text) << key << " = " << value;
    EXPECT_EQ(comments(changed), comments(text)) << key;
    const bool is_table = !former && layout.exists(path_of(key));
    if (keeps_keys(text, changed) && !is_table && !layout.value_at({"style"})) {
      const bool new_table = section.kind != SectionKind::single && !layout.exists(path_of(table));
      const SceneEdit back = former ? set(key, *former) : removal(new_table ? table : key);
      EXPECT_EQ(edited(changed, {back}), text) << key << " = " << value;
      ++(former ? replaced : added);
    }
    if (!meant.scene) continue;  // a rule forbids it; in the same words
    text = changed;
    now = std::move(meant);
  }
  EXPECT_GT(replaced, 30);
  EXPECT_GT(added, 60);
  EXPECT_GT(removed, 10);
}

INSTANTIATE_TEST_SUITE_P(Of, EditedScenes, testing::ValuesIn(scene_files()),
                         [](const auto& scene) { return scene.param.stem().string(); });

using test::scene_of;
using testing::Contains;
using testing::ElementsAre;
using testing::Key;
using testing::Not;
using testing::Pair;

constexpr auto text = R"(
[land_cover]
settings = { snowline_m = 2500, "odd name" = -1.5 }
[synthesis]
fallback = { shrub = "forest" }
[camera]
position = [1, 2]
look_at = [3, 4.5]
[sun]
azimuth_deg = 200
[[deform.handles]]
position = [5, 6]
[[deform.handles]]
position_lonlat = [7, 8]
move_m = [0, 500]
)";

TEST(SceneValues, AreThoseInEffect) {
  const auto list = scene_values(scene_of(text));
  const std::map<std::string, std::string> values(list.begin(), list.end());
  EXPECT_EQ(values.size(), list.size());
  EXPECT_THAT(values, Contains(Pair("version", "1")));
  EXPECT_THAT(values, Contains(Pair("camera.look_at", "[3, 4.5]")));
  EXPECT_THAT(values, Contains(Pair("camera.projection", "\"perspective\"")));
  EXPECT_THAT(values, Contains(Pair("deform.handles.0.position", "[5, 6]")));
  EXPECT_THAT(values, Contains(Pair("deform.handles.1.move_m", "[0, 500]")));
  EXPECT_THAT(values,
              Contains(Pair("land_cover.settings", R"({ "snowline_m": 2500, "odd name": -1.5 })")));
  EXPECT_THAT(values, Contains(Pair("synthesis.fallback", R"({ "shrub": "forest" })")));
  // Unset, or excluded by what is set.
  for (const char* key :
       {"camera.azimuth_deg", "camera.look_at_altitude_m", "deform.handles.2.move_m",
        "deform.handles.1.position", "margin.legend", "title"})
    EXPECT_THAT(values, Not(Contains(Key(key))));
}

TEST(SceneValues, SetAgainTheyGiveTheSameScene) {
  const Scene scene = scene_of(text);
  std::vector<std::string> settings;
  for (const auto& [key, value] : scene_values(scene, ValueForm::toml))
    settings.push_back(key + "=" + value);
  EXPECT_EQ(write_scene(scene_of("", settings)), write_scene(scene));
}

TEST(SceneValues, OfOneSection) {
  EXPECT_THAT(scene_values(scene_of(text), ValueForm::json, "sun"),
              ElementsAre(Pair("sun.azimuth_deg", "200"), Pair("sun.radius_deg", "1.72")));
  EXPECT_THAT(scene_values(scene_of(text), ValueForm::json, "deform.handles.1"),
              Contains(Pair("deform.handles.1.position_lonlat", "[7, 8]")));
}

}  // namespace
}  // namespace belvedere
