#include "tools/studio/scene_owner.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <utility>

#include "base/error.h"

namespace belvedere::tools {

SceneOwner::SceneOwner(const std::string& scene)
    : scene_(scene), descriptor_(open(scene.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0)
    throw Error(ErrorKind::input, scene, "cannot be read", "a scene file that you may read");
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  close(descriptor_);
  throw Error(ErrorKind::usage, scene, "is open in another studio",
              "close that one, or compose a copy of the scene");
}

SceneOwner::~SceneOwner() { close(descriptor_); }

void SceneOwner::renew() {
  struct stat held {};
  struct stat there {};
  if (fstat(descriptor_, &held) == 0 && stat(scene_.c_str(), &there) == 0 &&
      held.st_dev == there.st_dev && held.st_ino == there.st_ino)
    return;
  SceneOwner next(scene_);
  std::swap(descriptor_, next.descriptor_);
}

}  // namespace belvedere::tools
