#include "tools/report/encoded_picture.h"

#include <fstream>
#include <iterator>

#include "base/cache/scratch_folder.h"
#include "renderer/image/image_io.h"

namespace belvedere::tools {
namespace {

// The writers write files.
template <class Write>
std::string bytes_of(const char* extension, const Write& write) {
  const ScratchFolder folder;
  const std::string path = folder.path() + "/picture." + extension;
  write(path);
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::string jpeg_bytes(const Grid<glm::vec3>& picture, int quality) {
  return bytes_of("jpg", [&](const std::string& path) { write_jpeg(path, picture, quality); });
}

std::string png_bytes(const Grid<glm::vec3>& picture) {
  return bytes_of("png", [&](const std::string& path) { write_png8(path, picture, {}); });
}

}  // namespace belvedere::tools
