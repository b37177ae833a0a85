#include "renderer/image/provenance.h"

#include <fmt/format.h>
#include <tbb/version.h>
#include <xxhash.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "base/error.h"
#include "base/instruction_set.h"

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

}  // namespace

std::string program_version() { return BELVEDERE_VERSION; }

std::string library_versions() { return fmt::format("{}, oneTBB {}.{}", BELVEDERE_LIBRARIES, TBB_VERSION_MAJOR, TBB_VERSION_MINOR); }

struct ContentHash::State {
  XXH3_state_t* hash = XXH3_createState();
  ~State() { XXH3_freeState(hash); }
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) {
  if (state_->hash == nullptr || XXH3_128bits_reset(state_->hash) != XXH_OK) throw std::bad_alloc();
}
ContentHash::~ContentHash() = default;
void ContentHash::add(std::string_view bytes) { XXH3_128bits_update(state_->hash, bytes.data(), bytes.size()); }
std::string ContentHash::text() const { return hexadecimal(XXH3_128bits_digest(state_->hash)); }

std::string hash_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw Error(ErrorKind::input, path, "this is a folder", "a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorKind::input, path, "the file cannot be opened", "a file that exists and that you may read");
  ContentHash hash;
  std::string buffer(std::size_t{1} << 18, '\0');
  do {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    hash.add(std::string_view(buffer).substr(0, static_cast<std::size_t>(file.gcount())));
  } while (file);
  if (file.bad()) throw Error(ErrorKind::input, path, "the file cannot be read to its end");
  return hash.text();
}

std::string hash_bytes(std::string_view bytes) { return hexadecimal(XXH3_128bits(bytes.data(), bytes.size())); }

Provenance make_provenance(const std::string& scene_text, const std::map<std::string, std::string>& inputs) {
  Provenance provenance{.program_version = program_version(),
                        .libraries = library_versions(),
                        .instruction_set = instruction_set_title(machine_instruction_set()),
                        .scene = scene_text,
                        .inputs = {}};
  for (const auto& [name, path] : inputs) provenance.inputs[name] = hash_file(path);
  return provenance;
}

std::map<std::string, std::string> to_notes(const Provenance& provenance) {
  std::map<std::string, std::string> notes;
  const auto add = [&](const char* key, const std::string& value) {
    if (!value.empty()) notes[key] = value;
  };
  add("belvedere:version", provenance.program_version);
  add("belvedere:libraries", provenance.libraries);
  add("belvedere:instruction_set", provenance.instruction_set);
  add("belvedere:scene", provenance.scene);
  std::string inputs;
  for (const auto& [name, hash] : provenance.inputs) inputs += hash + "  " + name + "\n";
  add("belvedere:inputs", inputs);
  return notes;
}

}  // namespace belvedere
