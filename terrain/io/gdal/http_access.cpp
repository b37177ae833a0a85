#include <cpl_conv.h>
#include <cpl_http.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/text/parse_number.h"
#include "terrain/io/gdal/gdal_files.h"
#include "terrain/io/http_access.h"

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

namespace {

// curl's codes if there is no response (curl/curl.h, CURLcode); these numbers are a stable part of
// its interface.
HttpOutcome outcome_of_curl(int code) {
  switch (code) {
    case 5:  // the proxy's name
    case 6:
      return HttpOutcome::no_name;
    case 7:
      return HttpOutcome::no_connection;
    case 28:
      return HttpOutcome::silent;
    case 16:  // HTTP/2 framing
    case 18:  // shorter than announced
    case 52:  // empty response
    case 55:
    case 56:
    case 92:  // HTTP/2 stream
      return HttpOutcome::cut;
    case 42:
      return HttpOutcome::stopped;
    default:
      return HttpOutcome::failed;
  }
}

HttpOutcome outcome_of_status(int status) {
  switch (status) {
    case 404:
    case 410:
      return HttpOutcome::missing;
    case 429:
    case 500:
    case 502:
    case 503:
    case 504:
      return HttpOutcome::busy;
    default:
      return HttpOutcome::refused;
  }
}

// "bytes 100-199/4000": the first byte and the file's size ("*": unknown).
void read_content_range(std::string_view text, HttpAnswer& answer) {
  constexpr std::string_view unit = "bytes ";
  if (!text.starts_with(unit)) return;
  text.remove_prefix(unit.size());
  const std::size_t dash = text.find('-');
  const std::size_t slash = text.find('/');
  if (dash == std::string_view::npos || slash == std::string_view::npos) return;
  const std::optional<std::uint64_t> first = parse_number<std::uint64_t>(text.substr(0, dash));
  if (!first) return;
  answer.is_part = true;
  answer.first = *first;
  answer.total = parse_number<std::uint64_t>(text.substr(slash + 1));
}

int CPL_STDCALL report(double, const char*, void* request) {
  const auto& go_on = static_cast<const HttpRequest*>(request)->go_on;
  return !go_on || go_on() ? TRUE : FALSE;
}

}  // namespace

HttpAnswer ask_server(const HttpRequest& request) {
  register_gdal();
  CPLStringList options;
  const auto set = [&](const char* key, const std::string& value) {
    options.SetNameValue(key, value.c_str());
  };
  // Ranges of a compressed transfer would be parts of something else.
  std::string headers = "Accept-Encoding: identity";
  if (request.first > 0 || request.count > 0)
    headers += request.count > 0 ? fmt::format("\r\nRange: bytes={}-{}", request.first,
                                               request.first + request.count - 1)
                                 : fmt::format("\r\nRange: bytes={}-", request.first);
  set("HEADERS", headers);
  set("CONNECTTIMEOUT", fmt::format("{}", request.connect_s));
  set("TIMEOUT", fmt::format("{}", request.answer_s));
  set("LOW_SPEED_TIME", fmt::format("{}", request.silence_s));
  set("LOW_SPEED_LIMIT", "100");  // bytes a second
  set("MAX_RETRY", "0");          // the caller retries
  set("MAX_FILE_SIZE", fmt::format("{}", request.max_bytes));
  set("PERSISTENT", "belvedere");  // keeps the connection between requests
  if (!request.agent.empty()) set("USERAGENT", request.agent);
  const GdalErrors errors;
  const std::unique_ptr<CPLHTTPResult, void (*)(CPLHTTPResult*)> result(
      CPLHTTPFetchEx(request.address.c_str(), options.List(), &report,
                     const_cast<HttpRequest*>(&request), nullptr, nullptr),
      &CPLHTTPDestroyResult);
  HttpAnswer answer;
  if (!result) {
    answer.reason = errors.say("request failed");
    return answer;
  }
  const char* const problem = result->pszErrBuf;
  answer.reason = problem != nullptr ? problem : "";
  const CSLConstList said = result->papszHeaders;
  const auto header = [&](const char* name) -> std::string {
    const char* value = CSLFetchNameValue(said, name);
    return value != nullptr ? value : "";
  };
  constexpr std::string_view status_words = "HTTP error code : ";
  if (problem != nullptr && std::string_view(problem).starts_with(status_words)) {
    answer.status = std::atoi(problem + status_words.size());
    answer.outcome = outcome_of_status(answer.status);
    answer.retry_after_s =
        static_cast<double>(parse_number<std::uint64_t>(header("Retry-After")).value_or(0));
    return answer;
  }
  answer.outcome = result->nStatus == 0 && problem == nullptr ? HttpOutcome::good
                                                              : outcome_of_curl(result->nStatus);
  if (answer.outcome != HttpOutcome::good && answer.outcome != HttpOutcome::cut &&
      answer.outcome != HttpOutcome::silent)
    return answer;
  read_content_range(header("Content-Range"), answer);
  if (!answer.is_part) answer.total = parse_number<std::uint64_t>(header("Content-Length"));
  answer.tag = header("ETag");
  if (answer.tag.empty()) answer.tag = header("Last-Modified");
  if (result->pabyData != nullptr && result->nDataLen > 0)
    answer.bytes.assign(reinterpret_cast<const char*>(result->pabyData),
                        static_cast<std::size_t>(result->nDataLen));
  return answer;
}

namespace {

struct OpenStream {
  std::string path;
  ByteSource source;
  std::exception_ptr failure;
};

constexpr std::string_view prefix = "/vsibelvedere/";

// Registered streams: the library opens "12/name.tif" of the path "/vsibelvedere/12/name.tif".
std::mutex streams_mutex;
std::map<std::string, OpenStream*, std::less<>>& streams() {
  static std::map<std::string, OpenStream*, std::less<>> all;
  return all;
}

// Position of one reader of a stream.
struct Cursor {
  OpenStream* stream;
  std::uint64_t at = 0;
  bool past_end = false;
};

OpenStream* find_stream(std::string_view name) {
  if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  const std::lock_guard lock(streams_mutex);
  const auto found = streams().find(name);
  return found == streams().end() ? nullptr : found->second;
}

int stat_stream(void*, const char* name, VSIStatBufL* out, int) {
  const OpenStream* stream = find_stream(name);
  if (stream == nullptr) return -1;
  *out = {};
  out->st_mode = S_IFREG;
  out->st_size = static_cast<decltype(out->st_size)>(stream->source.bytes);
  return 0;
}

void* open_stream(void*, const char* name, const char* access) {
  OpenStream* stream = find_stream(name);
  if (stream == nullptr || std::string_view(access).find_first_of("wa+") != std::string_view::npos)
    return nullptr;
  return std::make_unique<Cursor>(Cursor{stream}).release();
}

vsi_l_offset tell(void* file) { return static_cast<Cursor*>(file)->at; }

int seek(void* file, vsi_l_offset offset, int whence) {
  Cursor& cursor = *static_cast<Cursor*>(file);
  cursor.at = offset + (whence == SEEK_SET   ? 0
                        : whence == SEEK_CUR ? cursor.at
                                             : cursor.stream->source.bytes);
  cursor.past_end = false;
  return 0;
}

std::size_t read(void* file, void* to, std::size_t size, std::size_t count) {
  Cursor& cursor = *static_cast<Cursor*>(file);
  OpenStream& stream = *cursor.stream;
  const std::uint64_t left = cursor.at < stream.source.bytes ? stream.source.bytes - cursor.at : 0;
  const std::uint64_t wanted = static_cast<std::uint64_t>(size) * count;
  const std::uint64_t bytes = std::min(wanted, left);
  cursor.past_end = bytes < wanted;
  if (bytes == 0 || stream.failure) return 0;
  try {
    stream.source.read(cursor.at, static_cast<std::size_t>(bytes), static_cast<char*>(to));
  } catch (...) {  // no exception may pass through a C library
    stream.failure = std::current_exception();
    return 0;
  }
  cursor.at += bytes;
  return static_cast<std::size_t>(bytes / size);
}

int is_at_end(void* file) { return static_cast<Cursor*>(file)->past_end ? 1 : 0; }

int close(void* file) {
  const std::unique_ptr<Cursor> ends(static_cast<Cursor*>(file));
  return 0;
}

void install() {
  static std::once_flag installed;
  std::call_once(installed, [] {
    VSIFilesystemPluginCallbacksStruct* callbacks = VSIAllocFilesystemPluginCallbacksStruct();
    callbacks->stat = &stat_stream;
    callbacks->open = &open_stream;
    callbacks->tell = &tell;
    callbacks->seek = &seek;
    callbacks->read = &read;
    callbacks->eof = &is_at_end;
    callbacks->close = &close;
    VSIInstallPluginHandler(prefix.data(),
                            callbacks);  // the pointer is kept: it must be of a literal
    VSIFreeFilesystemPluginCallbacksStruct(callbacks);
  });
}

}  // namespace

struct StreamFile::State {
  OpenStream stream;
};

StreamFile::StreamFile(const std::string& name, ByteSource source)
    : state_(std::make_unique<State>()) {
  install();
  // A unique number, because libraries cache by name.
  static std::atomic<std::uint64_t> number = 0;
  const std::string key = fmt::format("{}/{}", number.fetch_add(1), name);
  state_->stream = {std::string(prefix) + key, std::move(source), nullptr};
  const std::lock_guard lock(streams_mutex);
  streams()[key] = &state_->stream;
}

StreamFile::~StreamFile() {
  const std::lock_guard lock(streams_mutex);
  streams().erase(state_->stream.path.substr(prefix.size()));
}

const std::string& StreamFile::path() const { return state_->stream.path; }

void StreamFile::rethrow() const {
  if (state_->stream.failure) std::rethrow_exception(state_->stream.failure);
}

bool is_stream(const std::string& path) { return std::string_view(path).starts_with(prefix); }

}  // namespace belvedere
