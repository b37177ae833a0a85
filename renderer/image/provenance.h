#pragma once

#include <map>
#include <string>

#include "base/cache/content_hash.h"

namespace belvedere {

// Origin of a result, in every file's header, so that it can be made again. No time of day, no
// host, no folder: the same run gives the same bytes, wherever its files are.
struct Provenance {
  std::string program_version;
  std::string libraries;        // "Embree 3.13.5, GDAL 3.6.2 …"
  std::string instruction_set;  // of the ray tracer: "AVX2", or "Embree 3.13.5, AVX2 pinned"
  std::string scene;            // the resolved scene, TOML
  std::map<std::string, std::string>
      inputs;  // file name as the scene writes it → hash_file of its bytes
};

// "0.3.0"
std::string program_version();
// The third-party libraries the program was built with, "Embree 3.13.5, …".
std::string library_versions();
// Version, libraries and instruction set of this program on this machine, the scene's text and the
// hash of each input. inputs: name as the scene writes it → path.
Provenance make_provenance(const std::string& scene_text,
                           const std::map<std::string, std::string>& inputs);
// As header notes: belvedere:version, belvedere:libraries, belvedere:instruction_set,
// belvedere:scene and belvedere:inputs (lines of hash, two spaces, name). Empty fields are left
// out.
std::map<std::string, std::string> to_notes(const Provenance& provenance);

}  // namespace belvedere
