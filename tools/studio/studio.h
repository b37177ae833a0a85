#pragma once

#include <memory>
#include <string>

#include "base/run.h"
#include "tools/studio/http_server.h"
#include "tools/studio/studio_state.h"

namespace belvedere::tools {

struct StudioState;

// Composes a scene live: answers the requests of docs/studio.md, about one scene, until it is
// stopped.
class Studio {
 public:
  // Error as read_scene, and Error(usage) where the port is in use or another studio has the scene
  // open. `run` must outlive it.
  Studio(const StudioParameters& parameters, const Run& run);
  ~Studio();
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  std::string address() const;
  // Until stop(), from another thread.
  void run();
  void stop();
  // Whether the page was closed so many seconds ago, and nothing else was asked for since.
  bool is_left(double wait_s = 5.0) const;
  // The answer to one request; for tests. Errors become answers.
  HttpAnswer answer(const HttpRequest& request);

 private:
  std::unique_ptr<StudioState> state_;
};

}  // namespace belvedere::tools
