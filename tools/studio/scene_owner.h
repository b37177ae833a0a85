#pragma once

#include <string>

namespace belvedere::tools {

// Held while a studio has a scene open, so that a second one is refused; the system drops it
// whatever ends the program.
class SceneOwner {
 public:
  // Error(usage) where another studio has the scene open, Error(input) where it cannot be read.
  explicit SceneOwner(const std::string& scene);
  ~SceneOwner();
  SceneOwner(const SceneOwner&) = delete;
  SceneOwner& operator=(const SceneOwner&) = delete;
  // Saving puts another file in the place of the one that is held.
  void renew();

 private:
  std::string scene_;
  int descriptor_;
};

}  // namespace belvedere::tools
