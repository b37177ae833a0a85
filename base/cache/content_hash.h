#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace belvedere {

// XXH3-128 of bytes, 32 hexadecimal digits as `xxhsum -H2` prints them: tells contents apart, fast enough for whole rasters. No protection
// against somebody who wants two contents to have one hash.
std::string hash_bytes(std::string_view bytes);
// The same of a file's bytes; Error(input) where it cannot be read. Memory does not grow with the file.
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
  // Of all that was added.
  std::string digits() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere
