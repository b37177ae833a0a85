#include "tools/report/data_uri.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/text/base64.h"
#include "renderer/image/image_io.h"

namespace belvedere::tools {

std::string png_address(const Grid<glm::vec3>& picture, const std::string& scratch_folder) {
  const std::filesystem::path file = std::filesystem::path(scratch_folder) / "page_picture.png";
  write_png8(file.string(), picture, {});
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  std::filesystem::remove(file);
  return "data:image/png;base64," + base64(bytes.str());
}

}  // namespace belvedere::tools
