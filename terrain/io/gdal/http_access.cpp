#include "terrain/io/http_access.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <vector>

#include "base/error.h"
#include "terrain/io/gdal/gdal_files.h"

namespace belvedere {
namespace {

constexpr std::string_view curl_prefix = "/vsicurl/";

// Active ones, the latest last; few.
std::mutex access_mutex;
std::vector<std::pair<const HttpAccess*, HttpParameters>> accesses;

}  // namespace

HttpAccess::HttpAccess(const HttpParameters& parameters) {
  if (parameters.silence_s < 1 || parameters.silence_s > 3600)
    throw Error(ErrorKind::usage, "http", fmt::format("timeout of {} s", parameters.silence_s),
                "1…3600 s");
  if (parameters.retries < 0 || parameters.retries > 20)
    throw Error(ErrorKind::usage, "http", fmt::format("{} retries", parameters.retries), "0…20");
  const std::lock_guard lock(access_mutex);
  accesses.emplace_back(this, parameters);
}

HttpAccess::~HttpAccess() {
  const std::lock_guard lock(access_mutex);
  std::erase_if(accesses, [this](const auto& one) { return one.first == this; });
}

bool http_allowed() {
  const std::lock_guard lock(access_mutex);
  return !accesses.empty();
}

bool is_address(std::string_view file) {
  return file.starts_with("http://") || file.starts_with("https://");
}

void check_address(const std::string& address) {
  const std::size_t from = address.find("//") + 2;
  const std::string server = address.substr(from, address.find_first_of("/?#", from) - from);
  if (server.empty())
    throw Error(ErrorKind::usage, address, "the URL has no host", "https://SERVER/FILE");
  if (server.find('@') != std::string::npos)
    throw Error(ErrorKind::usage, "https://…" + server.substr(server.rfind('@')),
                "the URL contains a user name or password",
                "a public URL, because it is written into every result");
}

std::string address_to_gdal(const std::string& address) {
  return std::string(curl_prefix) + address;
}

std::string address_from_gdal(const std::string& path) {
  return path.starts_with(curl_prefix) &&
                 is_address(std::string_view(path).substr(curl_prefix.size()))
             ? path.substr(curl_prefix.size())
             : std::string();
}

void set_http_of_thread() {
  HttpParameters parameters;
  {
    const std::lock_guard lock(access_mutex);
    if (accesses.empty()) return;
    parameters = accesses.back().second;
  }
  const auto set = [](const char* key, const std::string& value) {
    CPLSetThreadLocalConfigOption(key, value.c_str());
  };
  constexpr int slowest_bytes_per_s = 100;
  set("GDAL_HTTP_CONNECTTIMEOUT", fmt::format("{}", parameters.silence_s));
  set("GDAL_HTTP_LOW_SPEED_TIME", fmt::format("{}", parameters.silence_s));
  set("GDAL_HTTP_LOW_SPEED_LIMIT", fmt::format("{}", slowest_bytes_per_s));
  set("GDAL_HTTP_MAX_RETRY", fmt::format("{}", parameters.retries));
  set("GDAL_HTTP_RETRY_DELAY", "1");
  // Several ranges requested at once are not retried if one fails (GDAL 3.6).
  set("GDAL_HTTP_MULTIRANGE", "SERIAL");
}

void tell_http_retry(const char* text) {
  if (std::string_view(text).find("Retrying again in") == std::string_view::npos) return;
  std::function<void(const std::string&)> tell;
  {
    const std::lock_guard lock(access_mutex);
    if (!accesses.empty()) tell = accesses.back().second.tell;
  }
  if (tell) tell(text);
}

std::string explain_http(const std::string& problem) {
  if (problem.find("Range downloading not supported") != std::string::npos)
    return "its server does not support range requests; download the file and use the copy";
  return problem;
}

std::uint64_t read_address(const std::string& address,
                           const std::function<void(std::string_view)>& take) {
  check_address(address);
  if (!http_allowed()) throw Error(ErrorKind::bug, address, "network access without permission");
  register_gdal();
  set_http_of_thread();
  // Only the file itself: no listing of its folder.
  const CPLConfigOptionSetter alone("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR", false);
  const GdalErrors errors;
  const std::string path = address_to_gdal(address);
  const auto fail = [&] {
    throw Error(ErrorKind::input, address,
                explain_http(errors.say("cannot read the file from its server")));
  };
  VSIStatBufL found;
  if (VSIStatL(path.c_str(), &found) != 0) fail();
  const std::unique_ptr<VSILFILE, int (*)(VSILFILE*)> file(VSIFOpenL(path.c_str(), "rb"),
                                                           &VSIFCloseL);
  if (!file) fail();
  const auto bytes = static_cast<std::uint64_t>(found.st_size);
  std::string piece(std::size_t{1} << 20, '\0');
  std::uint64_t done = 0;
  while (done < bytes) {
    const std::size_t got =
        VSIFReadL(piece.data(), 1, std::min<std::uint64_t>(piece.size(), bytes - done), file.get());
    if (got == 0 || errors.failed()) fail();
    take(std::string_view(piece).substr(0, got));
    done += got;
  }
  return done;
}

}  // namespace belvedere
