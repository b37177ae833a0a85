#include "tools/report/data_uri.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "renderer/image/image_io.h"

namespace belvedere::tools {

std::string base64(std::string_view bytes) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = (group << 8) | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[(group >> (18 - 6 * k)) & 63U];
  }
  return out;
}

std::string png_address(const Grid<glm::vec3>& picture, const std::string& scratch_folder) {
  const std::filesystem::path file = std::filesystem::path(scratch_folder) / "page_picture.png";
  write_png8(file.string(), picture, {});
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  std::filesystem::remove(file);
  return "data:image/png;base64," + base64(bytes.str());
}

}  // namespace belvedere::tools
