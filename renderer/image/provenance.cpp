#include "renderer/image/provenance.h"

#include <fmt/core.h>
#include <tbb/version.h>

#include "base/instruction_set.h"

namespace belvedere {

std::string program_version() { return BELVEDERE_VERSION; }

std::string library_versions() {
  return fmt::format("{}, oneTBB {}.{}", BELVEDERE_LIBRARIES, TBB_VERSION_MAJOR, TBB_VERSION_MINOR);
}

Provenance make_provenance(const std::string& scene_text,
                           const std::map<std::string, std::string>& inputs) {
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
