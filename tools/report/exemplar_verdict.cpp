#include "tools/report/exemplar_verdict.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/text/text_encoding.h"
#include "texture/quality/quality.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr std::size_t min_texels = 2500;  // 50 × 50: a few patches of a dozen strokes
constexpr double uneven_clique = 0.2;     // of halves, and
constexpr double uneven_ratio = 2.5;      // relative to chance
constexpr double low_coverage = 0.9;

// 12 345 678
Json halves_json(const HalvesDistance& halves) {
  if (!halves.known) return Json::raw("null");
  return Json::object()
      .add("clique_distance", Json::number(halves.clique))
      .add("colour_distance", Json::number(halves.colour));
}

Json class_json(const ClassSurvey& of, const ExemplarFindings& findings) {
  Json guides = Json::array();
  for (const GuideTexels& guide : of.guides) {
    Json gaps = Json::array();
    for (const GuideTexels::Gap& gap : guide.gaps)
      gaps.add(Json::array({Json::number(gap.from), Json::number(gap.to)}));
    guides.add(Json::object()
                   .add("name", Json::text(guide.name))
                   .add("lowest", Json::number(guide.lowest))
                   .add("percentile_5", Json::number(guide.low))
                   .add("percentile_95", Json::number(guide.high))
                   .add("highest", Json::number(guide.highest))
                   .add("gaps", std::move(gaps)));
  }
  return Json::object()
      .add("label", Json::number(of.label))
      .add("name", Json::text(findings.name(of.label)))
      .add("texels", Json::number(static_cast<double>(of.texels)))
      .add("texels_inside", Json::number(static_cast<double>(of.inside)))
      .add("serves_pixels", Json::number(static_cast<double>(of.texels * pixels_per_texel)))
      .add("sharpness", Json::number(of.sharpness))
      .add("stroke_run_px", Json::number(of.stroke_run_px))
      .add("left_against_right", halves_json(of.left_right))
      .add("checkerboard", halves_json(of.checkerboard))
      .add("guides", std::move(guides))
      .add("flaws", Json::texts(describe_flaws(of, findings)));
}

std::string halves_text(const HalvesDistance& halves) {
  return halves.known ? fmt::format("{:.3f}", halves.clique) : "–";
}

// Describes the use of a texture model.
std::string model_text(const ExemplarFindings::Model& model, const ExemplarFindings& findings) {
  std::string classes;
  for (const std::uint8_t label : model.labels)
    classes += (classes.empty() ? "" : ", ") + findings.name(label);
  return fmt::format("{}: a texture model, without texels; paints {}{}\n", model.name, classes,
                     model.always ? "" : " where paintings have no texels of it or too few");
}

// A column as wide as its widest cell; UTF-8, one column per character.
std::string table_text(const std::vector<std::vector<std::string>>& rows) {
  const auto length = [](const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
  };
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], length(row[c]));
  std::string out;
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string space(widths[c] - length(row[c]), ' ');
      out += c == 0 ? "  " + row[c] + space : "  " + space + row[c];
    }
    out += '\n';
  }
  return out;
}

}  // namespace

std::vector<std::string> describe_flaws(const ClassSurvey& of, const ExemplarFindings& findings) {
  std::vector<std::string> flaws;
  if (of.texels < min_texels)
    flaws.push_back(fmt::format("only {} texels: at least about {} are needed to copy strokes from",
                                grouped(of.texels), grouped(min_texels)));
  if (of.inside == 0)
    flaws.emplace_back(
        "no texel is farther than 8 texels from another class: its strokes occur only along "
        "borders");
  if (of.left_right.known &&
      of.left_right.clique > std::max(uneven_clique, uneven_ratio * of.checkerboard.clique))
    flaws.push_back(
        fmt::format("left and right are painted differently ({:.2f}, chance gives {:.2f}): both "
                    "will lie side by side",
                    of.left_right.clique, of.checkerboard.clique));
  for (const GuideTexels& guide : of.guides) {
    if (guide.name != "altitude") continue;
    for (const GuideTexels::Gap& gap : guide.gaps)
      flaws.push_back(fmt::format("no texels at altitudes {} to {}",
                                  findings.value(guide.name, gap.from),
                                  findings.value(guide.name, gap.to)));
  }
  return flaws;
}

std::string describe_service(const ClassSurvey& of) {
  return fmt::format("serves up to {} pixels", grouped(of.texels * pixels_per_texel));
}

std::string describe_needed_texels(const NeededClassTexels& demand) {
  const ClassTexels& available = demand.available;
  std::string text = available.enough()
                         ? fmt::format("enough: {} pixels need it, {} can be served",
                                       grouped(available.pixels), grouped(available.serves()))
                         : fmt::format(
                               "too few, strokes will repeat: {} pixels need it, {} can be served; "
                               "{} texels would be needed, there are {}; a style (belvedere style "
                               "fit) paints any size without repeating",
                               grouped(available.pixels), grouped(available.serves()),
                               grouped(available.texels_needed()), grouped(available.texels));
  for (const NeededClassTexels::Guide& guide : demand.guides)
    if (guide.fit.covered < low_coverage)
      text += fmt::format("; only {:.0f} % of its pixels find texels of their {}",
                          100.0 * guide.fit.covered, guide.fit.name);
  if (!demand.guides.empty() && demand.guides[0].cost >= 1.0)
    text += fmt::format("; {} costs most, {} a pixel", demand.guides[0].fit.name,
                        grouped(static_cast<std::size_t>(demand.guides[0].cost)));
  return text;
}

std::string findings_text(const ExemplarFindings& findings) {
  std::string out;
  for (const ExemplarFindings::Painting& painting : findings.paintings) {
    const ExemplarSurvey& survey = painting.survey;
    out += fmt::format(
        "{}: {} × {} texels, {:.1f} % of them never copied\n", painting.name, painting.width,
        painting.height,
        100.0 * static_cast<double>(survey.excluded) / static_cast<double>(survey.texels));
    const bool altitude =
        !survey.classes.empty() &&
        std::any_of(survey.classes[0].guides.begin(), survey.classes[0].guides.end(),
                    [](const GuideTexels& guide) { return guide.name == "altitude"; });
    std::vector<std::vector<std::string>> rows{{"class", "texels", "inside", "pixels served",
                                                "sharpness", "stroke, px", "left | right",
                                                "chance"}};
    if (altitude) rows[0].emplace_back("altitudes (5–95 %)");
    for (const ClassSurvey& of : survey.classes) {
      rows.push_back({findings.name(of.label), grouped(of.texels), grouped(of.inside),
                      grouped(of.texels * pixels_per_texel),
                      of.inside > 0 ? fmt::format("{:.1f}", of.sharpness) : "–",
                      of.inside > 0 ? fmt::format("{:.1f}", of.stroke_run_px) : "–",
                      halves_text(of.left_right), halves_text(of.checkerboard)});
      for (const GuideTexels& guide : of.guides)
        if (guide.name == "altitude")
          rows.back().push_back(fmt::format("{} … {}", findings.value(guide.name, guide.low),
                                            findings.value(guide.name, guide.high)));
    }
    out += table_text(rows);
    for (const ClassSurvey& of : survey.classes)
      for (const std::string& flaw : describe_flaws(of, findings))
        out += fmt::format("  {}: {}\n", findings.name(of.label), flaw);
  }
  std::string explained;
  for (const GuideShare& share : findings.explained)
    explained += fmt::format("{}{} {:.0f} %", explained.empty() ? "" : ", ", share.name,
                             100.0 * share.explained);
  if (!explained.empty()) out += "guides explain of the paint's variance: " + explained + "\n";
  for (const ExemplarFindings::Model& model : findings.models) out += model_text(model, findings);
  if (!findings.target_known)
    return out + fmt::format("a texel serves up to {} pixels before strokes visibly repeat\n",
                             pixels_per_texel);
  out += "for this picture\n";
  for (const NeededClassTexels& demand : findings.demands)
    out += fmt::format("  {}: {}\n", findings.name(demand.available.label),
                       describe_needed_texels(demand));
  for (const auto& [label, by, pixels] : findings.stand_ins)
    out += fmt::format("  {}: no texels of its own, {} pixels copy from {}\n", findings.name(label),
                       grouped(static_cast<std::size_t>(pixels)), findings.name(by));
  for (const auto& [label, pixels] : findings.missing)
    out += fmt::format("  {}: no texels at all, but {} pixels need it\n", findings.name(label),
                       grouped(pixels));
  return out;
}

Json findings_json(const ExemplarFindings& findings) {
  Json paintings = Json::array();
  for (const ExemplarFindings::Painting& painting : findings.paintings) {
    Json classes = Json::array();
    for (const ClassSurvey& of : painting.survey.classes) classes.add(class_json(of, findings));
    paintings.add(
        Json::object()
            .add("name", Json::text(painting.name))
            .add("width", Json::number(painting.width))
            .add("height", Json::number(painting.height))
            .add("excluded_texels", Json::number(static_cast<double>(painting.survey.excluded)))
            .add("classes", std::move(classes)));
  }
  Json out = Json::object()
                 .add("paintings", std::move(paintings))
                 .add("pixels_per_texel", Json::number(pixels_per_texel));
  if (!findings.models.empty()) {
    Json models = Json::array();
    for (const ExemplarFindings::Model& model : findings.models) {
      Json classes = Json::array();
      for (const std::uint8_t label : model.labels) classes.add(Json::text(findings.name(label)));
      models.add(Json::object()
                     .add("name", Json::text(model.name))
                     .add("paints", std::move(classes))
                     .add("always", Json::boolean(model.always)));
    }
    out.add("models", std::move(models));
  }
  if (findings.target_known) {
    Json demands = Json::array();
    for (const NeededClassTexels& demand : findings.demands) {
      const ClassTexels& available = demand.available;
      Json guides = Json::array();
      for (const auto& [fit, cost] : demand.guides)
        guides.add(Json::object()
                       .add("name", Json::text(fit.name))
                       .add("covered", Json::number(fit.covered))
                       .add("cost", Json::number(cost)));
      demands.add(
          Json::object()
              .add("label", Json::number(available.label))
              .add("name", Json::text(findings.name(available.label)))
              .add("pixels", Json::number(static_cast<double>(available.pixels)))
              .add("texels", Json::number(static_cast<double>(available.texels)))
              .add("texels_needed", Json::number(static_cast<double>(available.texels_needed())))
              .add("enough", Json::boolean(available.enough()))
              .add("guides", std::move(guides)));
    }
    Json missing = Json::array();
    for (const auto& [label, pixels] : findings.missing)
      missing.add(Json::object()
                      .add("label", Json::number(label))
                      .add("name", Json::text(findings.name(label)))
                      .add("pixels", Json::number(pixels)));
    Json stand_ins = Json::array();
    for (const auto& [label, by, pixels] : findings.stand_ins)
      stand_ins.add(Json::object()
                        .add("label", Json::number(label))
                        .add("copies_from", Json::number(by))
                        .add("pixels", Json::number(pixels)));
    out.add("asked", std::move(demands))
        .add("stand_ins", std::move(stand_ins))
        .add("missing", std::move(missing));
  }
  return out;
}

namespace {

constexpr int painting_px = 600;  // longest side of a painting on the page
constexpr int swatch_side = 96;   // texels
constexpr int swatch_times = 2;
constexpr int inside_squared = 64;  // as in quality.h

using Counts = std::array<std::size_t, 256>;

Counts count_values(const Grid<std::uint8_t>& values, const Grid<std::uint8_t>& labels,
                    std::uint8_t label) {
  Counts counts{};
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] == label) ++counts[values[i]];
  return counts;
}

// The purest part of a class: most texels of it inside.
Grid<glm::vec3> purest_paint(const Exemplar& exemplar, const Grid<std::uint8_t>& borders,
                             std::uint8_t label) {
  const Grid<std::uint8_t>& labels = exemplar.guides.label;
  Grid<float> score(labels.width(), labels.height(), 0.F);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] == label)
      score[i] =
          borders[i] > inside_squared ? 1.F : 0.01F;  // along borders where there is no inside
  return enlarged(to_picture(cut(exemplar.picture, best_window(score, {}, swatch_side))),
                  swatch_times);
}

// One row per class: how many of its texels have each value of the guide, and how many pixels of
// the target ask for it.
Json coverage_chart(const Exemplar& exemplar, const ExemplarSurvey& survey, const Guide& guide,
                    const GuideStack& asked, const ExemplarFindings& findings) {
  const Grid<std::uint8_t>* requested = asked.label.empty() ? nullptr : asked.find(guide.name);
  Json rows = Json::array();
  for (const ClassSurvey& of : survey.classes) {
    Json row = Json::object()
                   .add("name", Json::text(findings.name(of.label)))
                   .add("counts",
                        Json::numbers(count_values(guide.values, exemplar.guides.label, of.label)));
    if (requested != nullptr)
      row.add("asked", Json::numbers(count_values(*requested, asked.label, of.label)));
    rows.add(std::move(row));
  }
  Json scale = Json::array();
  for (int v = 0; v < 256; v += 32)
    scale.add(Json::array({Json::number(v), Json::text(findings.value(guide.name, v))}));
  return Json::object().add("rows", std::move(rows)).add("scale", std::move(scale));
}

}  // namespace

void write_exemplar_report(const std::string& folder, const std::vector<Exemplar>& exemplars,
                           const GuideStack& asked, const ExemplarFindings& findings,
                           const std::string& command) {
  Report page(folder);
  page.section("verdict", "Findings");
  page.listing(findings_text(findings));
  for (std::size_t e = 0; e < exemplars.size(); ++e) {
    const Exemplar& exemplar = exemplars[e];
    const ExemplarSurvey& survey = findings.paintings.at(e).survey;
    const std::string number = fmt::format("{}", e + 1);
    page.section("painting_" + number, exemplar.name,
                 "The painting and its classes; texels that are never copied are near black.");
    page.picture("painting_" + number, reduced_picture(to_picture(exemplar.picture), painting_px),
                 "painting");
    page.picture("classes_" + number,
                 reduced_picture(label_picture(exemplar.guides.label), painting_px), "classes");

    page.section(
        "swatches_" + number, "Swatches",
        fmt::format(
            "For each class the {0} × {0} texels farthest from other classes, twice as large.",
            swatch_side));
    const Grid<std::uint8_t> borders = border_distance_squared(exemplar.guides.label);
    for (std::size_t c = 0; c < survey.classes.size(); ++c) {
      const ClassSurvey& of = survey.classes[c];
      if (c % 6 == 0) page.next_row();
      page.picture(fmt::format("swatch_{}_{}", number, of.label),
                   purest_paint(exemplar, borders, of.label),
                   fmt::format("{}: {}", findings.name(of.label), describe_service(of)));
    }
    for (std::size_t g = 0; g < exemplar.guides.guides.size(); ++g) {
      const Guide& guide = exemplar.guides.guides[g];
      page.section(fmt::format("coverage_{}_{}", number, g + 1), "Painted at which " + guide.name,
                   "Brighter: more texels of the class have that value. Blue below: the picture to "
                   "be made asks for it; blue under black has no texel of its own.");
      page.add("coverage", coverage_chart(exemplar, survey, guide, asked, findings));
    }
  }
  page.write(
      {.title = "Suitability of the paintings",
       .lead = fmt::format("{} painting{}.", exemplars.size(), exemplars.size() == 1 ? "" : "s"),
       .command = command,
       .data = findings_json(findings)});
}

}  // namespace belvedere::tools
