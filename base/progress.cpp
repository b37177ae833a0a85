#include "base/progress.h"

namespace belvedere {

Progress& silent_progress() {
  static Progress silent;
  return silent;
}

}  // namespace belvedere
