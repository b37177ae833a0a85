#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace belvedere {

// Rasters on servers, given by their URL. No server is contacted unless the user allows it:
// otherwise opening somebody's scene would notify its author.

// HTTP options. Requests are retried after status 429, 500, 502, 503 or 504, after 1 s, then about
// 2, 5 s ….
struct HttpParameters {
  int silence_s = 30;                                 // timeout without data, s; 1…3600
  int retries = 3;                                    // 0…20
  std::function<void(const std::string&)> tell = {};  // called for each retry; from any thread
};

// Allows the process to access servers while one lives; the latest one's options apply.
class HttpAccess {
 public:
  explicit HttpAccess(const HttpParameters& parameters);
  ~HttpAccess();
  HttpAccess(const HttpAccess&) = delete;
  HttpAccess& operator=(const HttpAccess&) = delete;
};
bool http_allowed();

// Whether the name of a file is a URL: http:// or https://.
bool is_address(std::string_view file);
// Error(usage) for an unusable URL: without a host, or with a user name and password, which would
// end up in files.
void check_address(const std::string& address);

// The bytes of a file on a server, from first to last in pieces that do not outlive the call.
// Returns their number. Error(input).
std::uint64_t read_address(const std::string& address,
                           const std::function<void(std::string_view)>& take);

}  // namespace belvedere
