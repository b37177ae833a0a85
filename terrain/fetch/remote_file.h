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
#include "terrain/fetch/http_client.h"

namespace belvedere {

// What all files of one errand have in common.
struct RemoteErrand {
  HttpClient& client;
  const Cache& cache;
  Progress& progress;
  std::int64_t now_unix_s = 0;  // seconds since 1970, by which what is known grows old
  bool refresh = false;         // asks anew what each file is
};

// What a server says of a file.
struct RemoteDescription {
  bool missing = false;
  std::uint64_t bytes = 0;
  std::string tag;                // which edition of it; empty: the server does not say
  std::int64_t asked_unix_s = 0;  // when it was asked
};

void each_field(auto& bytes, FieldsOf<RemoteDescription> auto& description) {
  auto& [missing, size, tag, asked] = description;
  bytes(missing, size, tag, asked);
}

// A file on a server, read in parts. They come in pieces of 1 MiB, each of which is kept in the cache by what the file is (address, size,
// tag) and not asked for again; what the server says of the file is kept as well and holds for a month. Servers that give no parts are
// asked for the whole file once. Where the server cannot be reached, what is kept is used, however old. Throws Error(input).
class RemoteFile {
 public:
  static constexpr std::uint64_t piece_bytes = std::uint64_t{1} << 20U;
  static constexpr std::int64_t trusted_s = 30LL * 86400;

  RemoteFile(std::string address, const RemoteErrand& errand) : address_(std::move(address)), errand_(errand) {}

  const std::string& address() const { return address_; }
  const RemoteDescription& describe();
  // The file is there and the bytes lie in it.
  void read(std::uint64_t offset, std::size_t count, char* to);
  // Nothing that was read is trusted any more, nor what of it is kept: all is asked for again.
  void forget();
  // Whether the last failure was the server's, and not that of what it sent.
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
  RemoteErrand errand_;
  std::optional<RemoteDescription> about_;
  std::map<std::uint64_t, Bytes> pieces_;
  std::set<std::uint64_t> fetched_;  // in this run: of those the cache is trusted even after forget()
  bool distrust_ = false;
  bool only_whole_ = false;  // the server gives no parts
  bool lost_ = false;
};

}  // namespace belvedere
