#include "base/cache/content_hash.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <fstream>
#include <new>

#include "base/error.h"
#include "base/text/missing_file.h"

namespace belvedere {
namespace {

// The canonical form is big-endian, so it reads the same on any machine.
std::string hexadecimal(XXH128_hash_t hash) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, hash);
  std::string text;
  for (const unsigned char byte : canonical.digest) text += fmt::format("{:02x}", byte);
  return text;
}

struct FreeState {
  void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};

}  // namespace

struct ContentHash::State {
  std::unique_ptr<XXH3_state_t, FreeState> hash{XXH3_createState()};
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) {
  if (state_->hash == nullptr || XXH3_128bits_reset(state_->hash.get()) != XXH_OK)
    throw std::bad_alloc();
}
ContentHash::~ContentHash() = default;
ContentHash::ContentHash(ContentHash&&) noexcept = default;
ContentHash& ContentHash::operator=(ContentHash&&) noexcept = default;

void ContentHash::add(const void* bytes, std::size_t count) {
  XXH3_128bits_update(state_->hash.get(), bytes, count);
}

std::string ContentHash::digits() const {
  return hexadecimal(XXH3_128bits_digest(state_->hash.get()));
}

std::string hash_bytes(std::string_view bytes) {
  return hexadecimal(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string hash_file(const std::string& path) {
  require_file(path, "a readable file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorKind::input, path, "cannot open the file", "a readable file");
  ContentHash hash;
  std::string buffer(std::size_t{1} << 18, '\0');
  do {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    hash.add(buffer.data(), static_cast<std::size_t>(file.gcount()));
  } while (file);
  if (file.bad()) throw Error(ErrorKind::input, path, "cannot read the whole file");
  return hash.digits();
}

}  // namespace belvedere
