#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene_lock.h"

namespace belvedere::tools {

// Result of comparing a scene with its lock.
struct Verification {
  std::string scene;     // path of the scene file, as given
  std::string name;      // of its folder among results; unique in the run
  std::string folder;    // where its pictures are, as far as they were rendered
  double seconds = 0.0;  // duration
  int width = 0;         // of the pictures, px; 0: not known
  int height = 0;
  std::size_t inputs = 0;             // that were compared
  std::vector<std::string> products;  // that were compared
  std::vector<std::string>
      notes;  // possible explanation of a difference: another version of the program
  std::vector<LockDifference> differences;  // of products; inputs that differ are an error
  int error_status = 0;  // exit status of the error that prevented the comparison; 0: none
  std::string error;     // its message

  bool same() const { return error_status == 0 && differences.empty(); }
};

// 0 where all are equal; else the status of the first error; else 1.
int exit_status(const std::vector<Verification>& all);
// "scenes/alps.toml: the same", "…: differs in guidance.exr (Z, tone.V), panorama.tif (R G B)", "…:
// ERROR"; no line break.
std::string one_line(const Verification& verification);
// Channels of a product that differ, one after the other; empty where none does.
std::string channels_that_differ(const Verification& verification, const std::string& product);

// JUnit XML for CI services: a suite per scene, a case for its inputs and one for each product.
std::string verification_junit(const std::vector<Verification>& all);

struct VerificationPage {
  std::string
      against;  // folder with results of an earlier run, in folders named as here; empty: none
  std::string scratch_folder;  // for temporary files
};
// A self-contained page: each scene with its differences, its present picture, and where there is
// an earlier one that and the difference.
std::string verification_page(const std::vector<Verification>& all, const VerificationPage& page);

}  // namespace belvedere::tools
