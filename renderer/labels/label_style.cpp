#include "renderer/labels/label_style.h"

#include <fmt/core.h>

#include "base/config.h"
#include "base/error.h"
#include "base/text/config_reader.h"

namespace belvedere {
namespace {

LabelKindStyle read_kind(const ConfigEntry& entry, const std::string& name) {
  LabelKindStyle kind;
  kind.name = entry.key;
  ConfigReader read(entry.value, name);
  read.texts("also", kind.also);
  read.word<LabelPlace>("place", kind.position,
                        {{"above", LabelPlace::above},
                         {"beside", LabelPlace::beside},
                         {"over", LabelPlace::over},
                         {"on", LabelPlace::on}});
  read.text("family", kind.family);
  read.number("size_mm", kind.size_mm, 0.5, 100.0);
  read.number("rank_step", kind.rank_step, 0.0, 0.2);
  read.number("weight", kind.weight, 100.0, 900.0);
  read.flag("italic", kind.italic);
  read.flag("capitals", kind.capitals);
  read.number("spacing", kind.spacing, 0.0, 2.0);
  read.number("lift", kind.lift, -3.0, 3.0);
  read.number("aside", kind.aside, 0.0, 5.0);
  read.colour("colour", kind.colour);
  read.colour("light", kind.light);
  read.number("light_below", kind.light_below, 0.0, 1.0);
  read.colour("halo", kind.halo);
  read.number("halo_mm", kind.halo_mm, 0.0, 10.0);
  read.word<LabelMarkShape>("mark", kind.mark,
                            {{"none", LabelMarkShape::none},
                             {"dot", LabelMarkShape::dot},
                             {"ring", LabelMarkShape::ring},
                             {"triangle", LabelMarkShape::triangle},
                             {"square", LabelMarkShape::square}});
  read.number("mark_mm", kind.mark_mm, 0.0, 20.0);
  read.flag("altitude", kind.altitude);
  read.flag("barrier", kind.barrier);
  read.flag("straight", kind.straight);
  read.number("climb_m", kind.climb_m, 0.0, 5000.0);
  read.end();
  return kind;
}

TrackStyle read_track(const ConfigValue& value, const std::string& name) {
  TrackStyle track;
  ConfigReader read(value, name);
  read.colour("colour", track.colour);
  read.number("width_mm", track.width_mm, 0.05, 20.0);
  read.colour("halo", track.halo);
  read.number("halo_mm", track.halo_mm, 0.0, 10.0);
  read.end();
  return track;
}

AltitudeStyle read_altitude(const ConfigValue& value, const std::string& name) {
  AltitudeStyle altitude;
  ConfigReader read(value, name);
  read.text("family", altitude.family);
  read.number("size", altitude.size, 0.3, 1.0);
  read.number("weight", altitude.weight, 100.0, 900.0);
  read.colour("colour", altitude.colour);
  read.end();
  return altitude;
}

MarginStyle read_margin(const ConfigValue& value, const std::string& name) {
  MarginStyle margin;
  ConfigReader read(value, name);
  read.text("family", margin.family);
  read.text("heading", margin.heading);
  read.colour("paper", margin.paper);
  read.colour("ink", margin.ink);
  read.colour("sun", margin.sun);
  read.number("title_mm", margin.title_mm, 1.0, 200.0);
  read.number("text_mm", margin.text_mm, 0.5, 50.0);
  read.end();
  return margin;
}

LabelStyle read_style(const ConfigValue& document, const std::string& name) {
  LabelStyle style;
  style.name = name;
  ConfigReader read(document, name);
  double version = 0.0;
  read.number("version", version, 1.0, 1.0);
  if (version != 1.0) throw Error(ErrorKind::usage, name, "no version", "version = 1");
  read.number("min_px", style.min_px, 0.0, 1000.0);
  read.number("gap_mm", style.gap_mm, 0.0, 100.0);
  read.number("row_mm", style.row_mm, 0.5, 200.0);
  read.number("longest_leader_mm", style.longest_leader_mm, 0.0, 1000.0);
  read.number("ground_leader_mm", style.ground_leader_mm, 0.0, 1000.0);
  read.number("min_contrast", style.min_contrast, 1.0, 12.0);
  read.number("names_per_dm2", style.names_per_dm2, 0.1, 1000.0);
  read.number("clearance_mm", style.clearance_mm, 0.0, 100.0);
  read.number("margin_mm", style.margin_mm, 0.0, 500.0);
  read.colour("leader", style.leader);
  read.number("leader_mm", style.leader_mm, 0.0, 10.0);
  const ConfigValue* kinds = read.known("kinds");
  if (const ConfigValue* altitude = read.known("altitude"))
    style.altitude = read_altitude(*altitude, name);
  if (const ConfigValue* track = read.known("track")) style.track = read_track(*track, name);
  if (const ConfigValue* margin = read.known("margin")) style.margin = read_margin(*margin, name);
  read.end();
  if (kinds == nullptr)
    throw Error(ErrorKind::usage, name, "no kinds of names", "[kinds.summit] and the like");
  for (const ConfigEntry& entry : as_table(*kinds, name))
    style.kinds.push_back(read_kind(entry, name));
  if (style.kinds.empty())
    throw Error(ErrorKind::usage, name, "no kinds of names", "[kinds.summit] and the like");
  return style;
}

}  // namespace

int LabelStyle::find(const std::string& word) const { return find_kind(kinds, word); }

LabelStyle parse_label_style(const std::string& text, const std::string& name) {
  return read_style(parse_config(text, name), name);
}

LabelStyle load_label_style(const std::string& name_or_file) {
  const NamedConfig read = read_named_config("labels", name_or_file, "style of names");
  return read_style(read.root, read.name);
}

}  // namespace belvedere
