#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
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
  std::string agent = {};                 // user agent: "Belvedere/0.3.0"
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

// Source of the bytes of a virtual file. `read` fills the requested range, which lies inside the
// file, or throws.
struct ByteSource {
  std::uint64_t bytes = 0;
  std::function<void(std::uint64_t offset, std::size_t count, char* to)> read;
};

// Registers such a file under a name by which its rasters can be opened (raster_io.h,
// raster_file.h) while it lives; only the needed parts are read. Private to terrain/. Not
// thread-safe.
class StreamFile {
 public:
  // name: name of the file, with its extension.
  StreamFile(const std::string& name, ByteSource source);
  ~StreamFile();
  StreamFile(const StreamFile&) = delete;
  StreamFile& operator=(const StreamFile&) = delete;

  const std::string& path() const;
  // The first exception of `read`. Raster readers cannot pass it on and report a damaged file
  // instead.
  void rethrow() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Whether a path is the name of such a file.
bool is_stream(const std::string& path);

}  // namespace belvedere
