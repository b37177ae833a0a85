#include "tools/report/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/files/file_guard.h"
#include "base/files/output_file.h"
#include "base/text/embedded.h"
#include "base/text/text_encoding.h"
#include "renderer/image/image_io.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {

Json known(double value) { return std::isfinite(value) ? Json::number(value) : Json::raw("null"); }

Json evaluated(double value, bool good) {
  return Json::object().add("value", known(value)).add("good", Json::boolean(good));
}

Json linked(const std::string& text, const std::string& file) {
  return Json::object().add("value", Json::text(text)).add("href", Json::text(file));
}

Json swatch(glm::vec3 rgb) {
  const auto byte = [](float v) {
    return static_cast<int>(std::clamp(v, 0.0F, 1.0F) * 255.0F + 0.5F);
  };
  return Json::object().add("colour", Json::text(fmt::format("#{:02x}{:02x}{:02x}", byte(rgb.x),
                                                             byte(rgb.y), byte(rgb.z))));
}

Json range(double min, double max) {
  return Json::object().add("min", Json::number(min)).add("max", known(max));
}

ReportTable::ReportTable(std::vector<ReportColumn> columns) : columns_(std::move(columns)) {}

ReportTable& ReportTable::add_row(std::vector<Json> cells) {
  Json row = Json::object();
  for (std::size_t c = 0; c < columns_.size(); ++c)
    row.add(columns_[c].key, std::move(cells.at(c)));
  rows_.add(std::move(row));
  return *this;
}

Json ReportTable::json(const std::string& title) const {
  Json columns = Json::array();
  for (const ReportColumn& column : columns_) {
    Json head =
        Json::object().add("key", Json::text(column.key)).add("title", Json::text(column.title));
    if (!column.format.empty()) head.add("format", Json::text(column.format));
    if (!column.meaning.empty()) head.add("meaning", Json::text(column.meaning));
    columns.add(std::move(head));
  }
  return Json::object()
      .add("title", Json::text(title))
      .add("columns", std::move(columns))
      .add("rows", rows_);
}

Report::Report(std::string folder, Pictures pictures)
    : folder_(std::move(folder)), pictures_(pictures) {
  check_output_folder(folder_);
}

void Report::section(const std::string& id, const std::string& title, const std::string& text,
                     const std::string& state) {
  end_section();
  section_.add("id", Json::text(id))
      .add("title", Json::text(title))
      .add("state", Json::text(state))
      .add("text", Json::text(text));
}

void Report::text(const std::string& text) { add("text", Json::text(text)); }
void Report::list(const std::vector<std::string>& texts) { add("list", Json::texts(texts)); }
void Report::listing(const std::string& text) { add("listing", Json::text(text)); }
void Report::table(const ReportTable& table, const std::string& title) {
  add("table", table.json(title));
}

void Report::add(std::string_view kind, Json part) {
  next_row();
  parts_.add(Json::object().add(kind, std::move(part)));
}

void Report::write_picture(const std::string& name, const Grid<glm::vec3>& pixels) const {
  write_png8((std::filesystem::path(folder_) / (name + ".png")).string(), pixels, {});
}

Json Report::picture_json(const std::string& name, const Grid<glm::vec3>& pixels,
                          const std::string& caption) const {
  if (pictures_ == Pictures::beside) write_picture(name, pixels);
  return Json::object()
      .add("src", Json::text(pictures_ == Pictures::beside ? name + ".png" : png_address(pixels)))
      .add("width", Json::number(pixels.width()))
      .add("height", Json::number(pixels.height()))
      .add("caption", Json::text(caption));
}

void Report::picture(const std::string& name, const Grid<glm::vec3>& pixels,
                     const std::string& caption) {
  row_.add(picture_json(name, pixels, caption));
}

void Report::next_row() {
  if (!row_.empty()) parts_.add(Json::object().add("pictures", std::exchange(row_, Json::array())));
}

void Report::compare(const std::string& left, const Grid<glm::vec3>& left_pixels,
                     const std::string& right, const Grid<glm::vec3>& right_pixels) {
  add("slider", Json::array({picture_json(left, left_pixels, left),
                             picture_json(right, right_pixels, right)}));
}

void Report::end_section() {
  next_row();
  if (!section_.empty())
    sections_.add(
        std::exchange(section_, Json::object()).add("parts", std::exchange(parts_, Json::array())));
}

std::string Report::finish(const ReportHead& head) {
  end_section();
  Json report = Json::object()
                    .add("title", Json::text(head.title))
                    .add("lead", Json::text(head.lead))
                    .add("command", Json::text(head.command))
                    .add("sections", sections_);
  if (!head.data.empty()) report.add("data", head.data);
  return report.str();
}

std::string Report::page(const ReportHead& head) {
  return filled_page(embedded_file("report/index.html"),
                     {{"title", markup_text(head.title)},
                      {"css", std::string(embedded_file("report/report.css"))},
                      {"viewer", std::string(embedded_file("report/report.js"))},
                      {"report", script_json(finish(head))}});
}

void Report::write(const ReportHead& head) {
  const std::filesystem::path folder = folder_;
  write_text_file((folder / "index.html").string(), page(head));
  write_text_file((folder / "report.json").string(), finish(head) + "\n");
}

}  // namespace belvedere::tools
