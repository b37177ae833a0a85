#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace belvedere {

// Rasters on servers, named by their address. Nothing is asked of any server unless whoever runs the program allows it: a scene that comes
// from somewhere else could not be opened without telling its author so.

// How servers are asked. Tries are repeated where the answer is 429, 500, 502, 503 or 504, after 1 s, then some 2, 5 s ….
struct HttpParameters {
  int silence_s = 30;                                 // s that a server may send next to nothing, then it counts as lost; 1…3600
  int retries = 3;                                    // 0…20
  std::function<void(const std::string&)> tell = {};  // gets a line for each try that is repeated; from any thread
};

// The process may ask servers while one lives; the latest says how.
class HttpAccess {
 public:
  explicit HttpAccess(const HttpParameters& parameters);
  ~HttpAccess();
  HttpAccess(const HttpAccess&) = delete;
  HttpAccess& operator=(const HttpAccess&) = delete;
};
bool http_allowed();

// Whether the name of a file is the address of one on a server: http:// or https://.
bool is_address(std::string_view file);
// Error(usage) for an address that cannot be read as it is: no server in it, or a name and password, which would end up in files.
void check_address(const std::string& address);

// The bytes of a file on a server, from first to last in pieces that do not outlive the call. Returns their number. Error(input).
std::uint64_t read_address(const std::string& address, const std::function<void(std::string_view)>& take);

}  // namespace belvedere
