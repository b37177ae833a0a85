#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <string>

namespace belvedere::test {

// Pages are tested in it; tools/setup installs it.
constexpr const char* browser = "/usr/bin/chromium";

// A page after its scripts have run in the browser. `profile`: its own folder.
inline std::string opened_page(const std::string& page, const std::string& profile) {
  const std::string command = fmt::format(
      "timeout 120 {} --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
      "--disable-background-networking "
      "--disable-component-update --disable-sync --user-data-dir={} --virtual-time-budget=30000 "
      "--dump-dom 'file://{}' "
      "2>/dev/null",
      browser, profile, page);
  std::string out;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return out;
  std::array<char, 65536> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    out.append(buffer.data(), n);
  pclose(pipe);
  return out;
}

}  // namespace belvedere::test
