#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace belvedere {

// One HTTP request and its result, without retries or exceptions, so that the caller can decide.
// Only used to download files of a service on request (http_access.h is for files that scenes refer
// to).

struct HttpRequest {
  std::string address;                    // http:// or https://
  std::uint64_t first = 0;                // the first byte requested
  std::uint64_t count = 0;                // number of bytes; 0: to the end
  int connect_s = 15;                     // connection timeout, s
  int silence_s = 30;                     // timeout without data, s
  int answer_s = 600;                     // timeout of the whole response, s
  std::uint64_t max_bytes = 1ULL << 30U;  // longer responses are rejected; below 2³¹
  std::string agent = {};                 // user agent: "Belvedere/0.2.0"
  std::function<bool()> go_on = {};       // called a few times per second; false cancels
};

enum class HttpOutcome {
  good,           // all requested bytes, or the whole file (see is_part)
  missing,        // no such file: 404, 410
  busy,           // temporary: 429, 500, 502, 503, 504
  refused,        // any other error status
  no_name,        // cannot resolve host: usually no network
  no_connection,  // connection refused
  silent,         // timeout
  cut,            // the connection ended early; bytes has what was received
  stopped,        // go_on returned false
  failed,         // anything else: `reason`
};

struct HttpAnswer {
  HttpOutcome outcome = HttpOutcome::failed;
  int status = 0;           // of HTTP, if it is an error
  std::string reason;       // the library's message
  bool is_part = false;     // the bytes from `first` on; else the file from its beginning
  std::uint64_t first = 0;  // as sent by the server
  std::optional<std::uint64_t> total;  // bytes of the whole file, if sent by the server
  std::string tag;             // ETag, else Last-Modified; empty: neither. It changes with the file
  double retry_after_s = 0.0;  // Retry-After of a busy server; 0: none
  std::string bytes;
};

HttpAnswer ask_server(const HttpRequest& request);

}  // namespace belvedere
