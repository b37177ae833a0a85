#include "tools/report/text_file.h"

#include <fstream>

#include "renderer/image/output_file.h"

namespace belvedere::tools {

void write_text_file(const std::string& path, const std::string& text) {
  OutputFile file(path);
  std::ofstream stream(file.temporary(), std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) file.fail("writing failed");
  file.commit();
}

}  // namespace belvedere::tools
