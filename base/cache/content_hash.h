#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace belvedere {

// XXH3-128 of bytes, 32 hexadecimal digits as `xxhsum -H2` prints them. It identifies contents and
// is fast enough for whole rasters. It is not cryptographic: collisions can be constructed.
std::string hash_bytes(std::string_view bytes);
// The same of a file's bytes; Error(input) if it cannot be read. Memory does not grow with the
// file.
std::string hash_file(const std::string& path);

// The same of bytes that come in parts.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(ContentHash&&) noexcept;
  ContentHash& operator=(ContentHash&&) noexcept;

  void add(const void* bytes, std::size_t count);
  void add(std::string_view bytes) { add(bytes.data(), bytes.size()); }
  // The hash of everything added.
  std::string digits() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere
