#include "terrain/io/http_request.h"

#include <cpl_http.h>
#include <cpl_string.h>
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <memory>
#include <string_view>

#include "terrain/io/gdal/gdal_files.h"

namespace belvedere {
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

std::optional<std::uint64_t> number_in(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "bytes 100-199/4000": the first byte and the file's size ("*": unknown).
void read_content_range(std::string_view text, HttpAnswer& answer) {
  constexpr std::string_view unit = "bytes ";
  if (!text.starts_with(unit)) return;
  text.remove_prefix(unit.size());
  const std::size_t dash = text.find('-');
  const std::size_t slash = text.find('/');
  if (dash == std::string_view::npos || slash == std::string_view::npos) return;
  const std::optional<std::uint64_t> first = number_in(text.substr(0, dash));
  if (!first) return;
  answer.is_part = true;
  answer.first = *first;
  answer.total = number_in(text.substr(slash + 1));
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
    answer.retry_after_s = static_cast<double>(number_in(header("Retry-After")).value_or(0));
    return answer;
  }
  answer.outcome = result->nStatus == 0 && problem == nullptr ? HttpOutcome::good
                                                              : outcome_of_curl(result->nStatus);
  if (answer.outcome != HttpOutcome::good && answer.outcome != HttpOutcome::cut &&
      answer.outcome != HttpOutcome::silent)
    return answer;
  read_content_range(header("Content-Range"), answer);
  if (!answer.is_part) answer.total = number_in(header("Content-Length"));
  answer.tag = header("ETag");
  if (answer.tag.empty()) answer.tag = header("Last-Modified");
  if (result->pabyData != nullptr && result->nDataLen > 0)
    answer.bytes.assign(reinterpret_cast<const char*>(result->pabyData),
                        static_cast<std::size_t>(result->nDataLen));
  return answer;
}

}  // namespace belvedere
