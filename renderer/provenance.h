#pragma once

#include <map>
#include <string>
#include <vector>

namespace belvedere {

// Where a result came from: what every file's header carries (design sections 3 and 6). No time of day, no host: the same run gives the same bytes.
struct Provenance {
  std::string program_version;
  std::string libraries;                        // "Embree 3.13.5, GDAL 3.6.2 …"
  std::string instruction_set;
  std::string scene;                            // the resolved scene, TOML
  std::map<std::string, std::string> inputs;    // file name → xxh3 of its bytes
};
// "0.1.0"
std::string program_version();
// XXH3-128 of a file's bytes, hexadecimal; Error(input) where it cannot be read.
std::string hash_file(const std::string& path);
// As header notes: belvedere:version, belvedere:scene, …
std::map<std::string, std::string> to_notes(const Provenance& provenance);

}  // namespace belvedere
