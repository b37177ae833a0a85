#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace belvedere {

// One question to a server of files and what came of it: nothing is repeated and nothing thrown, so that whoever asks can decide. Nobody
// asks but where a person wants files of a service (http_access.h is for files that scenes name).

struct HttpRequest {
  std::string address;                     // http:// or https://
  std::uint64_t first = 0;                 // the first byte that is wanted
  std::uint64_t count = 0;                 // how many; 0: to the end
  int connect_s = 15;                      // s until the server must have taken the call
  int silence_s = 30;                      // s that it may send next to nothing
  int answer_s = 600;                      // s until all must be there
  std::uint64_t most_bytes = 1ULL << 30U;  // of an answer: longer ones are refused; below 2³¹
  std::string agent = {};                  // who asks: "Belvedere/0.2.0"
  std::function<bool()> go_on = {};        // asked a few times a second; false gives up
};

enum class HttpOutcome {
  good,           // all that was asked for, or the whole file (is_part says which)
  missing,        // the server has no such file: 404, 410
  busy,           // later perhaps: 429, 500, 502, 503, 504
  refused,        // another status, by which the server says no
  no_name,        // nobody knows the server's name: no network, mostly
  no_connection,  // the server does not take calls
  silent,         // too slow, or nothing at all
  cut,            // the connection ended early; bytes has what came
  stopped,        // go_on said no
  failed,         // anything else: `reason`
};

struct HttpAnswer {
  HttpOutcome outcome = HttpOutcome::failed;
  int status = 0;                      // of HTTP, where it is an error
  std::string reason;                  // in the words of the library
  bool is_part = false;                // the bytes from `first` on; else the file from its beginning
  std::uint64_t first = 0;             // as the server says
  std::optional<std::uint64_t> total;  // bytes of the whole file, where the server says so
  std::string tag;                     // its ETag, else its date of change; empty: neither. Another one, another file
  double retry_after_s = 0.0;          // what a busy server asks to wait; 0: nothing said
  std::string bytes;
};

HttpAnswer ask_server(const HttpRequest& request);

}  // namespace belvedere
