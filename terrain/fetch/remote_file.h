#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "base/cache/bytes.h"
#include "base/cache/cache.h"
#include "base/progress.h"
#include "terrain/io/http_access.h"

namespace belvedere {

// Client options: one connection at a time, with pauses.
struct HttpOptions {
  int connect_s = 15;  // connection timeout, s; 1…3600
  int silence_s = 30;  // timeout without data, s; 1…3600
  int answer_s = 600;  // timeout for a whole response, s; 1…86400
  int retries = 5;     // retries of a request that made no progress; 0…20
  double wait_s =
      1.0;  // s before the second try, doubled before each further one, or as the server asks; 0…60
  double pause_s = 0.05;                            // s between requests; 0…60
  std::string agent = "Belvedere (panorama maps)";  // user agent: name and version
};

// HTTP client that retries politely and explains failures to users.
class HttpClient {
 public:
  // Error(usage) if options are out of range.
  HttpClient(const HttpOptions& http_options, Progress& progress);

  // The bytes of a file from `first` on, `count` of them (0: to the end), in one try.
  // Error(interrupted) if the user stops.
  HttpAnswer ask(const std::string& address, std::uint64_t first, std::uint64_t count);
  // After an unusable response: waits before the next try, number `attempt` (from 1). Error(input)
  // if there are none left.
  void wait(const std::string& address, const HttpAnswer& answer, int attempt);
  // For responses that are not worth another try.
  [[noreturn]] void give_up(const std::string& address, const HttpAnswer& answer) const;

  // Requests sent, and bytes received.
  std::uint64_t asked() const { return asked_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  void sleep(double seconds) const;

  HttpOptions http_options_;
  Progress& progress_;
  std::string reached_;  // the server of the last response: a later refusal by it is a lost
                         // connection, not an absent server
  std::uint64_t asked_ = 0;
  std::uint64_t bytes_ = 0;
};

// Shared state of all files of one download.
struct FetchContext {
  HttpClient& client;
  const Cache& cache;
  Progress& progress;
  std::int64_t now_unix_s = 0;  // seconds since 1970, for the age of cached properties
  bool refresh = false;         // requests file properties again
};

// Properties of a file as sent by its server.
struct RemoteDescription {
  bool missing = false;
  std::uint64_t bytes = 0;
  std::string tag;                // its version (ETag); empty: not sent
  std::int64_t asked_unix_s = 0;  // when it was requested
};

void each_field(auto& bytes, FieldsOf<RemoteDescription> auto& description) {
  auto& [missing, size, tag, asked] = description;
  bytes(missing, size, tag, asked);
}

// A file on a server, read in parts. They are pieces of 1 MiB, each cached by the file's identity
// (address, size, tag) and not requested again. The file's properties are cached as well and valid
// for a month. Servers without range requests send the whole file once. If the server cannot be
// reached, cached data are used, however old. Throws Error(input).
class RemoteFile {
 public:
  static constexpr std::uint64_t piece_bytes = std::uint64_t{1} << 20U;
  static constexpr std::int64_t trusted_s = 30LL * 86400;

  RemoteFile(std::string address, const FetchContext& context)
      : address_(std::move(address)), context_(context) {}

  const std::string& address() const { return address_; }
  const RemoteDescription& describe();
  // Whether the file exists and the bytes lie in it.
  void read(std::uint64_t offset, std::size_t count, char* to);
  // Discards everything read and its cache entries: all is requested again.
  void forget();
  // Whether the last failure was the server's, not of the data it sent.
  bool is_lost() const { return lost_; }

 private:
  std::uint64_t piece_size(std::uint64_t index) const;
  CacheKey about_key() const;
  CacheKey piece_key(std::uint64_t index) const;
  void ask_about();
  void fetch(std::uint64_t first_piece, std::uint64_t count);
  void take(const HttpAnswer& answer);
  void keep(std::uint64_t index, std::string_view bytes);
  const Bytes* held(std::uint64_t index);
  void make_room(std::uint64_t for_index);

  std::string address_;
  FetchContext context_;
  std::optional<RemoteDescription> about_;
  std::map<std::uint64_t, Bytes> pieces_;
  std::set<std::uint64_t> fetched_;  // in this run: their cache entries stay valid after forget()
  bool distrust_ = false;
  bool only_whole_ = false;  // the server does not support range requests
  bool lost_ = false;
};

}  // namespace belvedere
