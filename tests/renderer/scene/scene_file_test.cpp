#include "renderer/scene/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"
#include "renderer/scene/scene_schema.h"
#include "tests/files.h"
#include "tests/paths.h"
#include "tests/renderer/scene/written_scene.h"

namespace belvedere {
namespace {

using test::refused;
using test::scene_of;

namespace fs = std::filesystem;
using test::input_error;
using test::usage_error;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(SceneFile, ReadsEveryKindOfValue) {
  const Scene scene = scene_of(R"(
title = "Über den Bergen"
seed = 9007199254740991
palette = "winter"
[terrain]
extent = [0, 1, 2e3, 3]
[terrain.synthetic]
width = 64
cell_m = 45
[land_cover]
unknown = "rock"
settings = { treeline = 1900, "odd name" = -1.5 }
[generalize]
foreground = [1, 0.5, 2]
background = [0, 1, 3.25]
keep_lakes = false
[camera]
position_lonlat = [11.4, 47.9]
look_at = [690000, 5249000.5]
look_at_altitude_m = 1200
[sun]
time = 2024-06-21T17:30:00+02:00
[[exemplar]]
seed = 3
[[exemplar]]
picture = "a.png"
classes = "b.png"
altitude_range_m = [-5, 6]
optional = true
[synthesis]
weights = { tone = 5 }
fallback = { shrub = "forest" }
)");
  EXPECT_EQ(scene.title, "Über den Bergen");
  EXPECT_EQ(scene.seed, 9007199254740991U);
  EXPECT_EQ(scene.palette, "winter");
  EXPECT_EQ(scene.terrain.dem.extent, (std::array{0.0, 1.0, 2000.0, 3.0}));
  ASSERT_TRUE(scene.terrain.synthetic);
  EXPECT_EQ(scene.terrain.synthetic->width, 64);
  EXPECT_EQ(scene.terrain.synthetic->cell_m, 45.0);
  EXPECT_EQ(scene.terrain.synthetic->height, SyntheticParameters{}.height);
  EXPECT_EQ(scene.land_cover.unknown, LandCoverClass::rock);
  EXPECT_EQ(scene.land_cover.settings, (std::vector<std::pair<std::string, double>>{
                                           {"treeline", 1900.0}, {"odd name", -1.5}}));
  EXPECT_EQ(scene.generalize.bands.foreground, (std::vector<float>{1.F, .5F, 2.F}));
  EXPECT_EQ(scene.generalize.bands.background, (std::vector<float>{0.F, 1.F, 3.25F}));
  EXPECT_FALSE(scene.generalize.keep_lakes);
  EXPECT_EQ(scene.camera.position_lonlat, glm::dvec2(11.4, 47.9));
  EXPECT_EQ(scene.camera.look_at, glm::dvec2(690000.0, 5249000.5));
  EXPECT_EQ(scene.camera.look_at_altitude_m, 1200.0);
  EXPECT_EQ(scene.sun.time, "2024-06-21T17:30:00+02:00");
  ASSERT_EQ(scene.exemplars.size(), 2U);
  EXPECT_EQ(scene.exemplars[0].seed, 3U);
  EXPECT_EQ(scene.exemplars[1].classes, "b.png");
  EXPECT_EQ(scene.exemplars[1].altitude_range_m, (std::array{-5.0, 6.0}));
  EXPECT_TRUE(scene.exemplars[1].optional);
  EXPECT_EQ(scene.synthesis.weights, (std::vector<std::pair<std::string, double>>{{"tone", 5.0}}));
  EXPECT_EQ(scene.synthesis.fallback.at(0),
            std::pair(LandCoverClass::shrub, LandCoverClass::forest));
}

TEST(SceneFile, VersionIsRequiredAndComesFirst) {
  const auto parse = [](const std::string& text) { parse_scene(text, "s.toml", ".", {}); };
  EXPECT_THAT(usage_error([&] { parse("title = \"x\"\n"); }),
              AllOf(HasSubstr("version is missing"), HasSubstr("version = 1")));
  // The other keys of a later format are not reported.
  EXPECT_THAT(usage_error([&] { parse("future = 1\nversion = 2\n"); }),
              AllOf(StartsWith("s.toml:2:11: version is the number 2")));
}

TEST(SceneFile, UnknownKeysNameThePlaceAndTheNearestKey) {
  EXPECT_THAT(refused("[camera]\n  pich_deg = 3\n"),
              AllOf(StartsWith("s.toml:3:3: unknown key \"camera.pich_deg\""),
                    HasSubstr("did you mean \"pitch_deg\""), HasSubstr("field_of_view_deg")));
  EXPECT_THAT(refused("[camera]\npitch = 3\n"), HasSubstr("did you mean \"pitch_deg\""));
  EXPECT_THAT(refused("[camra]\npitch_deg = 3\n"),
              AllOf(StartsWith("s.toml:2:2: "), HasSubstr("did you mean \"camera\"")));
  EXPECT_THAT(refused("azimuth_deg = 3\n"),
              AllOf(HasSubstr("camera.azimuth_deg"), HasSubstr("sun.azimuth_deg")));
  EXPECT_THAT(refused("[[exemplar]]\nseed = 1\n[[exemplar]]\nsead = 1\n"),
              AllOf(StartsWith("s.toml:5:1: "), HasSubstr("exemplar.1.sead")));
  EXPECT_THAT(refused("[deform.bend]\nradus_m = 1\n"), HasSubstr("did you mean \"radius_m\""));
}

TEST(SceneFile, WrongTypesSayWhatIsAllowed) {
  EXPECT_THAT(refused("[camera]\npitch_deg = \"steep\"\n"),
              AllOf(StartsWith("s.toml:3:13: camera.pitch_deg is the string \"steep\""),
                    HasSubstr("a number"), HasSubstr("-90 … 90°")));
  EXPECT_THAT(refused("[output]\nwidth = 2400.5\n"), HasSubstr("a whole number"));
  EXPECT_THAT(refused("[camera]\nposition = [1, 2, 3]\n"),
              AllOf(HasSubstr("an array of 3"), HasSubstr("[E, N]")));
  EXPECT_THAT(refused("[camera]\nposition = [1, \"2\"]\n"), StartsWith("s.toml:3:16: "));
  EXPECT_THAT(refused("camera = 5\n"), HasSubstr("a table, [camera]"));
  EXPECT_THAT(refused("[exemplar]\nseed = 1\n"), HasSubstr("[[exemplar]]"));
  EXPECT_THAT(refused("[land_cover]\nunknown = \"rok\"\n"),
              AllOf(HasSubstr("did you mean \"rock\""), HasSubstr("glacier")));
  EXPECT_THAT(refused("[land_cover]\nunknown = \"sky\"\n"), HasSubstr("not a class"));
  EXPECT_THAT(refused("[land_cover]\ncolours = \"layers\"\n"),
              AllOf(StartsWith("s.toml:3:11: "), HasSubstr("no layers are given")));
  EXPECT_THAT(refused("[land_cover]\ncolours = \"image\"\n"),
              HasSubstr("land_cover.colour_image = "));
  EXPECT_THAT(refused("[land_cover]\ncolour_image = \"a.tif\"\n"), HasSubstr("does not use it"));
  EXPECT_THAT(refused("[land_cover]\ncolours = \"texture\"\n"), HasSubstr("land_cover.texture = "));
  EXPECT_THAT(refused("[land_cover]\ntexture = \"a.composite\"\n"), HasSubstr("does not use it"));
  EXPECT_THAT(refused("[camera]\nprojection = \"perspectiv\"\n"),
              HasSubstr("did you mean \"perspective\""));
  EXPECT_THAT(refused("palette = \"sumer\"\n"),
              AllOf(HasSubstr("did you mean \"summer\""), HasSubstr("\"winter\"")));
  EXPECT_THAT(refused("[sun]\ntime = \"yesterday\"\n"), HasSubstr("ISO 8601"));
  EXPECT_THAT(refused("[sun]\ntime = 2024-06-21T17:30:00\n"), HasSubstr("zone"));
  EXPECT_THAT(refused("[synthesis]\nfallback = { shrub = \"tree\" }\n"),
              AllOf(StartsWith("s.toml:3:22: "), HasSubstr("not a class")));
  EXPECT_THAT(refused("[synthesis]\nfallback = { shrub = \"shrub\" }\n"),
              HasSubstr("another class"));
  EXPECT_THAT(refused("title = \"a\\u0007b\"\n"), HasSubstr("control characters"));
  EXPECT_THAT(
      refused("[[terrain.sources]]\nfile = \"C:\\new.tif\"\n"),
      AllOf(StartsWith("s.toml:3:8: "),
            HasSubstr("terrain.sources.0.file: \"C:\\new.tif\" was read as C:, a line feed, "
                      "ew.tif"),
            HasSubstr("single quotation marks")));
  EXPECT_THAT(refused("palette = \"my\\towns.toml\"\n"), HasSubstr("a tab"));
}

// Every number of the table, at both its ends and beyond: nan, inf, negative sizes, a width of 10⁹.
// Walks the table, so that a new key without a range fails here.
TEST(SceneFile, EveryNumberHasARange) {
  int checked = 0;
  for (const SceneSection& section : scene_sections())
    for (const SceneKey& key : section.keys) {
      if (describe_type(key) != "a number" && describe_type(key) != "a whole number") continue;
      const bool whole = describe_type(key) == "a whole number";
      const std::string name =
          join_key(section.kind == SectionKind::list ? std::string(section.name) + ".0"
                                                     : std::string(section.name),
                   key.name);
      std::vector<std::string> too_much = {"nan", "inf", "-inf", "-1e300", "1e300", "true"};
      if (whole)
        too_much.insert(too_much.end(), {"9223372036854775807", "-1", "-9223372036854775808"});
      if (key.name == "width" || key.name == "height") {
        if (whole) too_much.push_back("1000000000");
      }
      for (const std::string& value : too_much) {
        const std::string message = refused("", {name + "=" + value});
        EXPECT_THAT(message,
                    AllOf(HasSubstr("--set " + name + "=" + value), HasSubstr(name + " is ")))
            << value;
        EXPECT_THAT(message, HasSubstr(describe_range(key)));
        EXPECT_FALSE(describe_range(key).empty()) << name;
        ++checked;
      }
    }
  EXPECT_GT(checked, 300);
}

TEST(SceneFile, RangesOfPairsListsAndTables) {
  EXPECT_THAT(refused("[camera]\nposition_lonlat = [181, 0]\n"),
              HasSubstr("longitude -180 … 180°"));
  EXPECT_THAT(refused("[camera]\nposition_lonlat = [0, 91]\n"), StartsWith("s.toml:3:23: "));
  EXPECT_THAT(refused("[camera]\nposition = [nan, 0]\n"), HasSubstr("not a number"));
  EXPECT_THAT(refused("[generalize]\nforeground = [1, 6]\n"), HasSubstr("0 … 5"));
  EXPECT_THAT(refused("[generalize]\nforeground = []\n"), HasSubstr("1 to 12 numbers"));
  EXPECT_THAT(refused("[synthesis]\nweights = { tone = -1 }\n"), HasSubstr("0 … 100"));
  EXPECT_THAT(refused("[synthesis]\nweights = { tne = 1 }\n"),
              AllOf(StartsWith("s.toml:3:13: "), HasSubstr("did you mean \"tone\"")));
  EXPECT_THAT(refused("[sampling]\npixel_samples = 5\n"), HasSubstr("1, 4, 9 or 16"));
  EXPECT_THAT(refused("[air]\nscale_m = 0\n"), HasSubstr("more than 0"));
}

TEST(SceneFile, KeysThatExcludeEachOther) {
  EXPECT_THAT(refused("[camera]\nposition = [1, 2]\nposition_lonlat = [1, 2]\n"),
              AllOf(StartsWith("s.toml:4:1: "),
                    HasSubstr("camera.position and camera.position_lonlat exclude each other")));
  EXPECT_THAT(refused("[camera]\nlook_at = [1, 2]\nlook_at_lonlat = [1, 2]\n"),
              HasSubstr("exclude"));
  EXPECT_THAT(refused("[camera]\nlook_at = [1, 2]\nazimuth_deg = 3\n"), HasSubstr("exclude"));
  EXPECT_THAT(refused("[camera]\nlook_at_lonlat = [1, 2]\npitch_deg = 3\n"), HasSubstr("exclude"));
  EXPECT_THAT(refused("[sun]\ntime = \"2024-06-21T17:30:00Z\"\nazimuth_deg = 3\n"),
              HasSubstr("exclude"));
  EXPECT_THAT(refused("[terrain.synthetic]\n[[terrain.sources]]\nfile = \"a.tif\"\n"),
              HasSubstr("exclude"));
  EXPECT_THAT(refused("[[exemplar]]\npicture = \"a.png\"\nguidance = \"a.exr\"\nseed = 3\n"),
              HasSubstr("exemplar.0.seed exclude"));
  EXPECT_NO_THROW(scene_of("[sun]\ntime = \"\"\nazimuth_deg = 3\n"));
}

TEST(SceneFile, FormatsOfThePictureAreThoseOfTheTable) {
  EXPECT_EQ(scene_of("").output.formats, (std::vector<std::string>{"tif", "png", "exr"}));
  EXPECT_EQ(scene_of("[output]\nformats = [\"png\"]\n").output.formats,
            std::vector<std::string>{"png"});
  EXPECT_EQ(scene_of("[output]\nformats = [\"exr\", \"tif\"]\n").output.formats,
            (std::vector<std::string>{"exr", "tif"}));
  EXPECT_THAT(refused("[output]\nformats = [\"png\", \"gif\"]\n"),
              AllOf(StartsWith("s.toml:3:19: "), HasSubstr("gif"), HasSubstr("tif, png, exr")));
  EXPECT_THAT(refused("[output]\nformats = [\"png\", \"png\"]\n"), HasSubstr("twice"));
  EXPECT_THAT(refused("[output]\nformats = []\n"), HasSubstr("a list of tif, png, exr"));
  EXPECT_THAT(refused("[output]\nformats = \"png\"\n"), HasSubstr("a list of"));
}

TEST(SceneFile, KeysThatBelongTogether) {
  EXPECT_THAT(refused("[generalize]\nforeground = [1, 1]\nbackground = [1]\n"),
              StartsWith("s.toml:4:14: "));
  EXPECT_THAT(refused("[generalize]\nforeground_to_m = 90000\nbackground_from_m = 90000\n"),
              HasSubstr("beyond"));
  EXPECT_THAT(refused("[terrain]\nextent = [1, 1, 0, 2]\n"), HasSubstr("no area"));
  EXPECT_THAT(refused("[terrain.synthetic]\nlowest_m = 4000\n"), HasSubstr("not above lowest_m"));
  EXPECT_THAT(refused("[[terrain.sources]]\nband = 2\n"),
              AllOf(StartsWith("s.toml:2:"), HasSubstr("terrain.sources.0.file is missing")));
  EXPECT_THAT(refused("[[land_cover.sources]]\nfile = \"a.tif\"\n"),
              HasSubstr("needs land_cover.legend"));
  EXPECT_THAT(refused("[deform.bend]\nradius_m = 10\n"), HasSubstr("1000"));
  EXPECT_THAT(refused("[camera]\nlook_at_altitude_m = 10\n"), HasSubstr("without a point"));
  EXPECT_THAT(refused("[camera]\nfield_of_view_deg = 200\n"), HasSubstr("cylindrical"));
  EXPECT_NO_THROW(scene_of("[camera]\nfield_of_view_deg = 200\nprojection = \"cylindrical\"\n"));
  EXPECT_THAT(refused("[[exemplar]]\npicture = \"a.png\"\n"),
              HasSubstr("neither guidance nor classes"));
  EXPECT_THAT(refused("[[exemplar]]\nclasses = \"a.png\"\n"), HasSubstr("without a picture"));
  EXPECT_THAT(refused("[[exemplar]]\nmodel = \"a.model\"\n"), HasSubstr("serves"));
  EXPECT_THAT(
      refused("[[exemplar]]\nmodel = \"a.model\"\nserves = [\"rock\"]\npicture = \"a.png\"\n"),
      HasSubstr("together with a model"));
  EXPECT_THAT(refused("[[exemplar]]\nprefer = \"model\"\n"), HasSubstr("without a model"));
  EXPECT_THAT(refused("[[exemplar]]\nlight = \"lit\"\n"), HasSubstr("without a model"));
  const std::string lit =
      "[[exemplar]]\nmodel = \"a.model\"\nserves = [\"rock\"]\nlight = \"lit\"\n";
  EXPECT_THAT(refused(lit), HasSubstr("no other block paints the rest of rock"));
  EXPECT_THAT(refused(lit + lit), HasSubstr("no other block"));
  EXPECT_NO_THROW(scene_of(
      lit + "[[exemplar]]\nmodel = \"b.model\"\nserves = [\"rock\"]\nlight = \"shaded\"\n"));
  EXPECT_NO_THROW(scene_of(lit + "[[exemplar]]\nmodel = \"b.model\"\nserves = [\"rock\"]\n"));
  EXPECT_THAT(refused("[[exemplar]]\nmodel = \"a.composite\"\nlight = \"lit\"\n"),
              HasSubstr("labels are classes"));
  const Scene one_set = scene_of("[generalize]\nforeground = [2, 2]\n");
  EXPECT_EQ(one_set.generalize.bands.background, (std::vector<float>{2.F, 2.F}));  // far as near
  const Scene far_set = scene_of("[generalize]\nbackground = [2, 0]\n");
  EXPECT_EQ(far_set.generalize.bands.foreground, (std::vector<float>{1.F, 1.F}));
  EXPECT_TRUE(scene_of("").terrain.synthetic);
  EXPECT_FALSE(scene_of("[[terrain.sources]]\nfile = \"a.tif\"\n").terrain.synthetic);
}

TEST(SceneFile, SettingsOverride) {
  const std::string text = "[camera]\nlook_at = [1, 2]\npitch_deg = -5\n";
  EXPECT_THAT(refused(text), HasSubstr("exclude"));
  // The command line has precedence, also over alternatives in the file.
  const Scene scene = scene_of(
      "title = \"a\"\n[camera]\nlook_at = [1, 2]\n[sun]\ntime = "
      "\"2024-06-21T17:30:00Z\"\n[[exemplar]]\nseed = 1\n",
      {"camera.pitch_deg=-7.5", "sun.altitude_deg = 12", "output.width=1200", "exemplar.0.seed=3",
       "exemplar.1.width=800", "generalize.foreground.2=0.5", "synthesis.weights.tone=4",
       "title=2024", "palette=winter", "land_cover.unknown=rock", "terrain.extent=[0, 0, 5, 5]",
       "output.width=1300"});
  EXPECT_FALSE(scene.camera.look_at);
  EXPECT_EQ(scene.camera.pitch_deg, -7.5);
  EXPECT_EQ(scene.sun.time, "");
  EXPECT_EQ(scene.sun.altitude_deg, 12.0);
  EXPECT_EQ(scene.output.width, 1300);
  ASSERT_EQ(scene.exemplars.size(), 2U);
  EXPECT_EQ(scene.exemplars[0].seed, 3U);
  EXPECT_EQ(scene.exemplars[1].width, 800);
  EXPECT_EQ(scene.generalize.bands.foreground, (std::vector<float>{1.F, 1.F, .5F, 1.F, 1.F, 1.F}));
  EXPECT_EQ(scene.synthesis.weights.at(0).second, 4.0);
  EXPECT_EQ(scene.title, "2024");
  EXPECT_EQ(scene.palette, "winter");
  EXPECT_EQ(scene.land_cover.unknown, LandCoverClass::rock);
  EXPECT_TRUE(scene.terrain.dem.extent);
}

TEST(SceneFile, BadSettingsNameThemselves) {
  EXPECT_THAT(refused("", {"camera.pich_deg=3"}),
              AllOf(StartsWith("--set camera.pich_deg=3: unknown key"), HasSubstr("pitch")));
  EXPECT_THAT(refused("", {"camera.pitch_deg=95"}),
              AllOf(StartsWith("--set camera.pitch_deg=95: camera.pitch_deg is the number 95"),
                    HasSubstr("-90 … 90°")));
  EXPECT_THAT(refused("", {"camera.pitch_deg"}),
              AllOf(StartsWith("--set camera.pitch_deg: "), HasSubstr("key=value")));
  EXPECT_THAT(refused("", {"=3"}), HasSubstr("key=value"));
  EXPECT_THAT(refused("", {"camera..pitch_deg=3"}), HasSubstr("empty"));
  EXPECT_THAT(refused("", {"exemplar.5.seed=3"}), HasSubstr("is not an index of a list of 0"));
  EXPECT_THAT(refused("", {"exemplar.x.seed=3"}), HasSubstr("is not an index"));
  EXPECT_THAT(refused("title = \"a\"\n", {"title.x=3"}), HasSubstr("nothing can be set below"));
  EXPECT_THAT(refused("", {"camera.position=[1,"}), StartsWith("--set camera.position=[1,: "));
  EXPECT_THAT(refused("", {"camera.look_at=[1,2]", "camera.azimuth_deg=3"}), HasSubstr("exclude"));
  EXPECT_THAT(refused("", {"a.b.c.d.e.f.g.h.i.j=1"}), HasSubstr("too many parts"));
}

TEST(SceneFile, ListsOfClasses) {
  const Scene scene = scene_of(
      "[land_cover]\nsmallest_patch_m2 = 9000\nkeep_patches = []\n[[exemplar]]\npicture = "
      "\"p.png\"\nclasses = \"c.png\"\n"
      "serves = [\"rock\", \"snow\"]\nfound_shadow = \"exclude\"\n[synthesis]\ncolours = "
      "\"painting\"\nharmonize = \"first\"\n");
  EXPECT_EQ(scene.exemplars[0].serves, (std::vector{LandCoverClass::rock, LandCoverClass::snow}));
  EXPECT_TRUE(scene.land_cover.patches.keep.empty());
  EXPECT_EQ(Scene{}.land_cover.patches.keep,
            (std::vector{LandCoverClass::water, LandCoverClass::settlement}));
  const Scene again = parse_scene(write_scene(scene), "again.toml", ".", {}).scene;
  EXPECT_EQ(again.exemplars[0].serves, scene.exemplars[0].serves);
  EXPECT_TRUE(again.land_cover.patches.keep.empty());
  EXPECT_EQ(again.land_cover.patches.smallest_m2, 9000.0);
  EXPECT_EQ(again.synthesis.colours, "painting");
  EXPECT_THAT(refused("[land_cover]\nkeep_patches = [\"water\", \"watr\"]\n"),
              AllOf(StartsWith("s.toml:3:"), HasSubstr("water")));
  EXPECT_THAT(refused("[land_cover]\nkeep_patches = \"water\"\n"),
              HasSubstr("a list of class names"));
  EXPECT_THAT(refused("[[exemplar]]\nserves = [\"rock\"]\n"), HasSubstr("without a picture"));
}

// Everything at once and the defaults: what is written reads back to the same.
TEST(SceneFile, WrittenScenesReadBack) {
  for (const char* text :
       {"",
        "title = 'q\"\\'\n[[terrain.sources]]\nfile = \"a b.tif\"\nnodata = -9999\nunit = "
        "\"us-ft\"\n[land_cover]\nlegend = "
        "\"nlcd\"\nsettings = { \"a b\" = 0.1 }\nerode = { snow = 2, forest = 1 }\n"
        "[[land_cover.sources]]\nfile = \"lc.tif\"\n[camera]\nposition = [692000.123456789, "
        "0.1]\nlook_at_lonlat = [11, 47]\n"
        "[generalize]\nforeground = [0.9, 1.1, 0.333333]\nbackground = [0.1, 0.2, "
        "0.7]\n[sun]\ntime = \"2024-06-21T17:30:00Z\"\n"
        "[[exemplar]]\nmodel = \"m.model\"\nserves = [\"rock\"]\nprefer = \"model\"\n"
        "[[exemplar]]\nseed = 4\n[[exemplar]]\npicture = \"p.png\"\nclasses = \"c.png\"\nlicence = "
        "\"x\\ty\\nz\"\n"
        "[synthesis]\nweights = { tone = 3.3 }\nfallback = { shrub = \"forest\", scree = \"rock\" "
        "}\nclass_dissimilarity = { \"forest/shrub\" = 0.3 "
        "}\n"}) {
    const Scene scene = scene_of(text);
    const std::string written = write_scene(scene);
    const Scene again = parse_scene(written, "again.toml", ".", {}).scene;
    EXPECT_EQ(write_scene(again), written);
    EXPECT_EQ(again.title, scene.title);
    EXPECT_EQ(again.camera.position, scene.camera.position);
    EXPECT_EQ(again.generalize.bands.foreground, scene.generalize.bands.foreground);
    EXPECT_EQ(again.land_cover.settings, scene.land_cover.settings);
    EXPECT_EQ(again.land_cover.erode, scene.land_cover.erode);
    EXPECT_EQ(again.exemplars.size(), scene.exemplars.size());
    EXPECT_EQ(again.terrain.synthetic.has_value(), scene.terrain.synthetic.has_value());
  }
}

TEST(SceneFile, SceneFromAFile) {
  const test::Folder folder;
  folder.write("here.tif", "x");
  const std::string path =
      folder.write("peak.toml", "version = 1\n[[terrain.sources]]\nfile = \"here.tif\"\n");
  const LoadedScene scene = read_scene(path, {});
  EXPECT_EQ(scene.name, "peak");
  EXPECT_EQ(scene.folder, folder.path());
  EXPECT_EQ(find_scene_file(scene, scene.scene.terrain.sources.at(0).file),
            fs::canonical(folder / "here.tif"));
  EXPECT_THAT(input_error([&] { read_scene(folder / "none.toml", {}); }), HasSubstr("none.toml"));
}

std::string text_of(const std::string& file) {
  return test::read_bytes(test::source_folder() + "/" + file);
}

TEST(SceneFile, ReferenceAndSchemaAreTheCommittedOnes) {
  EXPECT_TRUE(text_of("docs/scene.md") == scene_reference())
      << "run: belvedere schema --markdown > docs/scene.md";
  EXPECT_TRUE(text_of("docs/scene.schema.json") == scene_json_schema())
      << "run: belvedere schema > docs/scene.schema.json";
}

TEST(SceneFile, EveryKeyIsDocumented) {
  const std::string reference = scene_reference();
  const std::string schema = scene_json_schema();
  for (const SceneSection& section : scene_sections()) {
    EXPECT_FALSE(section.meaning.empty()) << section.name;
    for (const SceneKey& key : section.keys) {
      EXPECT_THAT(reference, HasSubstr("| `" + std::string(key.name) + "` |"));
      EXPECT_THAT(schema, HasSubstr("\"" + std::string(key.name) + "\": {"));
      EXPECT_TRUE(key.meaning.ends_with(".")) << section.name << "." << key.name;
    }
  }
}

// Every scene of the program is read without an error, and gives the source of its data.
TEST(SceneFile, ScenesOfTheProgramAreRead) {
  std::vector<std::string> titles;
  for (const auto& entry : fs::directory_iterator(test::source_folder() + "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const LoadedScene scene = read_scene(entry.path().string(), {});
    EXPECT_FALSE(scene.scene.title.empty()) << entry.path();
    ASSERT_TRUE(!scene.scene.terrain.sources.empty() || scene.scene.terrain.synthetic)
        << entry.path();
    for (const SceneExemplar& exemplar : scene.scene.exemplars) {
      if (exemplar.picture.empty()) continue;
      EXPECT_FALSE(exemplar.origin.empty()) << entry.path();
      EXPECT_FALSE(exemplar.licence.empty()) << entry.path();
      EXPECT_FALSE(exemplar.get_from.empty()) << entry.path();
      // Their masks lie beside them, or with a picture that is not asked for.
      EXPECT_TRUE(exemplar.optional || fs::exists(entry.path().parent_path() / exemplar.classes))
          << exemplar.classes;
    }
    for (const SceneFeatures& features : scene.scene.features) {
      EXPECT_FALSE(features.origin.empty()) << entry.path();
      EXPECT_FALSE(features.licence.empty()) << entry.path();
      EXPECT_TRUE(features.optional || fs::exists(entry.path().parent_path() / features.source))
          << features.source;
    }
    for (const auto& source : scene.scene.terrain.sources) {
      EXPECT_FALSE(source.origin.empty()) << entry.path();
      EXPECT_FALSE(source.licence.empty()) << entry.path();
      EXPECT_FALSE(source.get_from.empty()) << entry.path();
    }
    titles.push_back(scene.scene.title);
  }
  EXPECT_THAT(titles,
              testing::UnorderedElementsAre(
                  "Glacier National Park, Selkirks", "Karwendel", "Karwendel in the evening",
                  "Karwendel, an ice-age summer", "Karwendel, cleared of its forest",
                  "Karwendel after Segantini", "Karwendel: roads, railways and ways",
                  "Ötztal Alps: a synthetic winter map", "Lolo Peak", "Mountains after Monet",
                  "Mount Rainier", "Zion Canyon", "Ötztal Alps", "Mount Ararat",
                  "Lost River Range, as if on Ararat", "Karwendel, copied from Segantini",
                  "Coast after Monet"));
}

}  // namespace
}  // namespace belvedere
