#include "tools/studio/encoded_picture.h"

#include <fmt/core.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "renderer/image/image_io.h"

namespace belvedere::tools {
namespace {

// The writers write files.
template <class Write>
std::string bytes_of(const char* extension, const Write& write) {
  static std::atomic<unsigned> count = 0;
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      fmt::format("belvedere-{}-{}.{}", getpid(), count.fetch_add(1), extension);
  write(path.string());
  std::ifstream file(path, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(file), {});
  std::filesystem::remove(path);
  return bytes;
}

}  // namespace

std::string jpeg_bytes(const Grid<glm::vec3>& picture, int quality) {
  return bytes_of("jpg", [&](const std::string& path) { write_jpeg(path, picture, quality); });
}

std::string png_bytes(const Grid<glm::vec3>& picture) {
  return bytes_of("png", [&](const std::string& path) { write_png8(path, picture, {}); });
}

}  // namespace belvedere::tools
