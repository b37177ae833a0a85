#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/run.h"
#include "renderer/scene/scene_file.h"
#include "tools/studio/answers.h"
#include "tools/studio/http_server.h"
#include "tools/studio/job.h"
#include "tools/studio/scene_session.h"

namespace belvedere::tools {

// An area whose maps are to be fetched.
struct WantedPlace {
  glm::dvec2 at_lonlat{0.0};  // its centre, °
  glm::dvec2 size_km{60.0};   // west to east, south to north
  bool land_cover = true;
  std::string folder;  // for the maps, below the scene's
};
// Fetches the maps of a place, and returns the text of a scene of them, as `new` proposes it.
using OpenPlace = std::function<std::string(const WantedPlace& place, const Run& run)>;

// Answers requests below an address of the page.
using Room = std::function<HttpAnswer(const HttpRequest& request)>;
// Opens the page that picks pairs of a painting and the ground of a scene.
using OpenPicking = std::function<Room(const LoadedScene& scene, const std::string& painting,
                                       const std::string& pairs, const Run& run)>;
// Fits the style of a painting and writes its file.
using FitStyle =
    std::function<void(const std::string& painting, const std::string& style, const Run& run)>;

struct StudioParameters {
  std::string scene;  // path
  SceneFileOptions files;
  int port = 0;               // 0: any that is free
  OpenPlace open_place = {};  // nothing: places are refused; so with the next two
  OpenPicking open_picking = {};
  FitStyle fit_style = {};
};

class Job;

// State shared by the studio's files: studio.cpp finds the answer to a request, studio_pictures.cpp
// has the longer ones.
struct StudioState {
  StudioState(const StudioParameters& parameters, const Run& given);
  ~StudioState();
  StudioState(const StudioState&) = delete;
  StudioState& operator=(const StudioState&) = delete;

  // The scene and its revision at one moment, for a request.
  struct Moment {
    LoadedScene scene;
    std::uint64_t revision = 0;
  };
  // Error(interrupted) where the request names another revision.
  Moment moment(const HttpRequest& request);

  // The scene after a change, which ends the pictures of the one before.
  HttpAnswer change_scene(const std::function<void()>& change);
  // Keeps what the page asks about the last picture: pointer, values left open, notes.
  void remember(std::shared_ptr<const LivePicture> made, const Moment& of,
                std::vector<std::string> told);
  // The last picture; Error(interrupted) where it is not of the revision that is asked about.
  std::shared_ptr<const LivePicture> last_picture(const HttpRequest& request);
  // The ladder of a page: the last rung has the width that the request names.
  static std::vector<Rung> rungs_asked(const HttpRequest& request);

  HttpAnswer rendered(const std::string& name);
  HttpAnswer picture(const HttpRequest& request);
  HttpAnswer tiles(const HttpRequest& request);
  HttpAnswer pointer(const HttpRequest& request);
  HttpAnswer start_render(const HttpRequest& request);
  Json render_json() const;
  HttpAnswer start_fetch(const HttpRequest& request);
  Json fetch_json() const;
  HttpAnswer start_painting_work(const HttpRequest& request, const std::string& name);
  HttpAnswer place(const HttpRequest& request);
  HttpAnswer take_file(const HttpRequest& request);
  std::vector<Proposal> proposals(const LoadedScene& scene);
  HttpAnswer proposal_picture(const std::string& name);
  HttpAnswer thumbnail(const HttpRequest& request);
  HttpAnswer loupe(const HttpRequest& request);
  // The scene with other edits, small and quick.
  HttpAnswer small_picture(std::span<const SceneEdit> edits, int width_px);
  HttpAnswer in_picking(const HttpRequest& request);
  HttpAnswer route(const HttpRequest& request);

  std::mutex mutex;  // of the members below, up to `run`
  SceneSession session;
  std::vector<DerivedValue> derived;
  std::vector<std::string> notes;
  std::shared_ptr<const LivePicture> last;  // under the pointer
  std::uint64_t last_revision = 0;
  double last_rung_s = 0.0;  // how long the last rung took, and of how many pixels it was
  double last_rung_px = 0.0;
  FileOwner owner;
  const Run& run;
  std::mutex proposals_mutex;
  std::weak_ptr<const Dem> proposals_of;
  std::vector<Proposal> proposed;
  PictureQueue quick;  // all rungs but the last
  PictureQueue exact;  // the last
  PictureQueue small;  // thumbnails of other scenes, which leave what the others keep
  const OpenPlace open_place;
  const OpenPicking open_picking;
  const FitStyle fit_style;
  Room picking;  // once it is open; under `mutex`
  std::unique_ptr<Job> render;
  std::unique_ptr<Job> fetch;
  std::unique_ptr<Job> painting;  // a style that is fitted, or the room for pairs that is opened
  PageVisits visits;
  std::optional<HttpServer> server;
};

}  // namespace belvedere::tools
