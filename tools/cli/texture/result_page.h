#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/grid.h"

namespace belvedere::tools {

class CommandOptions;

// A picture of a page, encoded sRGB, shown pixel by pixel.
struct PagePicture {
  std::string name;  // of its file, without the ending
  Grid<glm::vec3> pixels;
  std::string caption;
};

// What a command that makes a picture shows of it: what it began with beside what came out, and its figures. Plain text throughout.
struct ResultPage {
  std::string title;
  std::string heading;
  std::string lead;
  std::string how_to_read;
  std::vector<std::vector<PagePicture>> rows;
  std::vector<std::vector<std::string>> table;  // its heads first; empty: none
  std::string command;
};

void add_report_option(CommandOptions& command, std::string& folder, const std::string& meaning);
// Tries the folder before the work begins: Error(output). An empty one is none.
void check_report(const std::string& folder);
void write_result_page(const std::string& folder, const ResultPage& page);

}  // namespace belvedere::tools
