#include "tools/report_folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <utility>

#include "renderer/image_io.h"
#include "renderer/output_file.h"
#include "tools/report_pictures.h"

namespace belvedere::tools {

std::string html_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

ReportFolder::ReportFolder(std::string folder) : folder_(std::move(folder)) { check_output_folder(folder_); }

void ReportFolder::add(const std::string& html) { body_ += html + "\n"; }

void ReportFolder::begin_figure(const std::string& id, const std::string& heading, const std::string& how_to_read) {
  add(fmt::format("<section id=\"{}\"><h2>{}</h2>\n<p>{}</p>\n<div class=\"row\">", id, heading, how_to_read));
}

void ReportFolder::next_row() { add("</div><div class=\"row\">"); }

void ReportFolder::picture(const std::string& name, const Grid<glm::vec3>& pixels, const std::string& caption) {
  write_png8((std::filesystem::path(folder_) / (name + ".png")).string(), pixels, {});
  add(fmt::format("<figure><img src=\"{0}.png\" width=\"{1}\" height=\"{2}\" alt=\"{3}\"><figcaption>{3}</figcaption></figure>", name,
                  pixels.width(), pixels.height(), caption));
}

void ReportFolder::end_figure() { add("</div></section>"); }

void ReportFolder::write(const std::string& name, const std::string& text) const {
  OutputFile file((std::filesystem::path(folder_) / name).string());
  std::ofstream stream(file.temporary(), std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) file.fail("writing failed");
  file.commit();
}

void ReliefPainter::whole(const std::string& name, const Grid<float>& altitude_m, const std::string& caption) {
  folder_.picture(name, relief_picture(altitude_m, cell_m_, whole_px), caption);
}

void ReliefPainter::window(const std::string& name, const Grid<float>& altitude_m, const PixelRect& where, const std::string& caption) {
  folder_.picture(name, relief_picture(cut(altitude_m, where), cell_m_, window_px), caption);
}

}  // namespace belvedere::tools
