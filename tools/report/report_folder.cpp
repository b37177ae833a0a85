#include "tools/report/report_folder.h"

#include <fmt/core.h>

#include <filesystem>
#include <utility>

#include "base/text/markup.h"
#include "renderer/image/image_io.h"
#include "renderer/image/output_file.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr const char* folder_style =
    R"(body{font:16px/1.45 system-ui,sans-serif;margin:2rem auto;max-width:1320px;padding:0 1rem;color:#222;background:#fafaf7}
h1{font-size:1.7rem}h2{font-size:1.2rem;margin-top:2.2rem}p{max-width:46rem}
.row{display:flex;gap:12px;align-items:flex-start;margin-bottom:10px}figure{margin:0;flex:0 1 auto;min-width:0}figure img{max-width:100%;height:auto;display:block}
figcaption{font-size:.85rem;color:#555}table{border-collapse:collapse}td,th{padding:.25rem .8rem;border-bottom:1px solid #ddd;text-align:right}
td:first-child,th:first-child{text-align:left}small,svg text{color:#666;font-size:.8rem}pre{background:#eee;padding:.6rem;white-space:pre-wrap})";

}  // namespace

std::string html_row(const std::vector<std::string>& cells, const char* tag) {
  std::string out = "<tr>";
  for (const std::string& cell : cells) out += fmt::format("<{0}>{1}</{0}>", tag, cell);
  return out + "</tr>\n";
}

ReportFolder::ReportFolder(std::string folder) : folder_(std::move(folder)) { check_output_folder(folder_); }

void ReportFolder::add(const std::string& html) { body_ += html + "\n"; }

void ReportFolder::begin_figure(const std::string& id, const std::string& heading, const std::string& how_to_read) {
  add(fmt::format("<section id=\"{}\"><h2>{}</h2>\n<p>{}</p>\n<div class=\"row\">", id, heading, how_to_read));
}

void ReportFolder::next_row() { add("</div><div class=\"row\">"); }

void ReportFolder::write_picture(const std::string& name, const Grid<glm::vec3>& pixels) const {
  write_png8((std::filesystem::path(folder_) / (name + ".png")).string(), pixels, {});
}

void ReportFolder::picture(const std::string& name, const Grid<glm::vec3>& pixels, const std::string& caption) {
  write_picture(name, pixels);
  add(
      fmt::format("<figure style=\"max-width:{1}px\"><img src=\"{0}.png\" width=\"{1}\" height=\"{2}\" "
                  "alt=\"{3}\"><figcaption>{3}</figcaption></figure>",
                  name, pixels.width(), pixels.height(), caption));
}

void ReportFolder::end_figure() { add("</div></section>"); }

void ReportFolder::write(const std::string& name, const std::string& text) const {
  write_text_file((std::filesystem::path(folder_) / name).string(), text);
}

void ReportFolder::write_page(const std::string& title, const std::string& heading, const std::string& lead,
                              const std::string& command) const {
  write("index.html",
        fmt::format("<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title>\n<style>{}</style></head>\n"
                    "<body><h1>{}</h1>\n<p>{}</p>\n<pre>{}</pre>\n{}</body></html>\n",
                    markup_text(title), folder_style, markup_text(heading), markup_text(lead), markup_text(command), body_));
}

void ReliefPainter::whole(const std::string& name, const Grid<float>& altitude_m, const std::string& caption) {
  folder_.picture(name, relief_picture(altitude_m, cell_m_, whole_px), caption);
}

void ReliefPainter::window(const std::string& name, const Grid<float>& altitude_m, const PixelRect& where, const std::string& caption) {
  folder_.picture(name, relief_picture(cut(altitude_m, where), cell_m_, window_px), caption);
}

}  // namespace belvedere::tools
