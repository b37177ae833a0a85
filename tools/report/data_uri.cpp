#include "tools/report/data_uri.h"

#include "base/text/base64.h"
#include "tools/report/encoded_picture.h"

namespace belvedere::tools {

std::string png_address(const Grid<glm::vec3>& picture) {
  return "data:image/png;base64," + base64(png_bytes(picture));
}

}  // namespace belvedere::tools
