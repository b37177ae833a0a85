#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/text/json.h"
#include "renderer/register/pair_proposals.h"
#include "renderer/register/registered_ground.h"
#include "terrain/io/dem.h"
#include "terrain/register/control_pairs.h"
#include "terrain/register/registration.h"
#include "tools/studio/scene_session.h"
#include "tools/web/web_page.h"

namespace belvedere::tools {

// The registration of the painting by its pairs.
struct FittedPairs {
  std::uint64_t revision = 0;  // of the pairs
  std::vector<ControlPair> pairs;
  Registration registration;
  DisplacementField field;
  std::vector<ProposedPixel> places;  // where the known places lie
};

// A piece of skyline or ridge in pixels of the painting, and how far it may be off in one
// direction, standard deviation.
struct DrawnLine {
  SeenLine line;
  double sigma_px = 0.0;
};

// Ground that the painter moved as a whole, as the pairs tell, and the painting's pixel that shows
// its centre.
struct DrawnHandle {
  DeformHandle handle;
  glm::dvec2 pixel{0.0};
};

// The terrain as the fitted pairs show it. Where pairs are too few to trace it, without a view and
// lines, and all places in the painting count as seen.
struct FittedTerrain {
  std::unique_ptr<const RegisteredView> view;
  std::vector<DrawnLine> lines;
  std::vector<bool> seen;  // of the known places
  std::vector<DrawnHandle> handles = {};
};

struct PairsFitterInput {
  const Dem& drawn;  // whose skyline and ridges are drawn: about a million cells are quick
  const std::vector<KnownPlace>& places;
  glm::ivec2 painting_px{0};
  RegistrationParameters registration;
};

// Fits pairs in a thread of its own: first the registration, then what terrain it shows. The newest
// pairs end the work for those before.
class PairsFitter {
 public:
  // Everything that `input` refers to must outlive the fitter.
  explicit PairsFitter(PairsFitterInput input);
  ~PairsFitter();
  PairsFitter(const PairsFitter&) = delete;
  PairsFitter& operator=(const PairsFitter&) = delete;

  // Revisions grow.
  void fit(std::uint64_t revision, std::vector<ControlPair> pairs);
  // Waits for the fit of a revision; null where its pairs are fewer than min_fitted_pairs.
  // Error(interrupted) once newer ones were given or end() was called, and what the fit throws.
  std::shared_ptr<const FittedPairs> fitted(std::uint64_t revision);
  std::shared_ptr<const FittedTerrain> terrain(std::uint64_t revision);
  // The newest fit that is done, maybe of older pairs, with its terrain, if that is done too; null:
  // none.
  struct Latest {
    std::shared_ptr<const FittedPairs> fit;
    std::shared_ptr<const FittedTerrain> terrain;
  };
  Latest latest() const;
  // Ends the work and all that wait for it.
  void end();

 private:
  class WhileNewest;
  void work();
  void fit_newest(std::uint64_t revision, const std::vector<ControlPair>& pairs);
  Latest wait(std::uint64_t revision, bool for_terrain);

  const PairsFitterInput input_;
  mutable std::mutex mutex_;  // of the members below
  std::condition_variable changed_;
  std::uint64_t newest_ = 0;  // revision
  std::uint64_t done_ = 0;    // the newest whose work has ended
  bool ended_ = false;
  std::vector<ControlPair> pairs_;  // of the newest
  Latest latest_;
  std::optional<Error> error_;  // of done_
  std::thread thread_;
};

// A table of pairs while somebody picks them: its text, which is always what the file has, the
// pairs that it means, and the texts before and after for undo and redo. Not thread-safe.
class PairsSession {
 public:
  // A file that is not there yet is made, without pairs. `dem` must outlive the session. Error as
  // parse_control_pairs, also for columns that would be lost; Error(usage) where another page has
  // the file open.
  PairsSession(std::string path, glm::ivec2 painting_px, const Dem& dem);

  const std::string& path() const { return path_; }
  const std::vector<ControlPair>& pairs() const { return pairs_; }
  // Grows with every change.
  std::uint64_t revision() const { return revision_; }

  // Each change is written at once, complete or not at all. One that is refused, Error(usage) as
  // parse_control_pairs or Error(output), changes nothing; Error(output) also where another program
  // changed the file. Of the pairs their pixel, lonlat, name and sure count.
  void change(std::span<const ControlPair> pairs);
  void undo();  // nothing without a step to undo
  void redo();
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }

  // Whether another program changed the file since it was read or written.
  bool is_changed_outside() const;
  // Reads the file again; a step of undo.
  void reload();
  // Writes the pairs over what another program wrote.
  void save_over();

 private:
  std::vector<ControlPair> parse(const std::string& text) const;
  void write(const std::string& text);
  void replace(const std::string& text, std::vector<ControlPair> pairs);

  std::string path_;
  glm::ivec2 painting_px_;
  const Dem& dem_;
  FileOwner owner_;
  std::string text_;
  std::vector<ControlPair> pairs_;
  std::uint64_t revision_ = 1;
  std::vector<std::string> undo_;
  std::vector<std::string> redo_;
};

// Answers to the page that picks pairs, as JSON: docs/registration.md describes the members.

// Constants of a session: the painting, the map and the known places.
struct PickingSetup {
  std::string painting;
  TilePyramid painting_tiles;
  TilePyramid map_tiles;
  glm::dvec2 map_origin{0.0};  // CRS, outer corner of its top-left pixel
  glm::dvec2 map_px_m{1.0};    // side of its pixels
  std::string crs;             // in words
  std::vector<KnownPlace> places;
  std::string next;
  bool room = false;  // of the studio, to which the page leads back
};
Json setup_json(const PickingSetup& setup);

Json pairs_json(const PairsSession& session);
// fit: null where the pairs are too few.
Json fit_json(std::uint64_t revision, const FittedPairs* fit, glm::ivec2 painting_px);
Json terrain_json(std::uint64_t revision, const FittedTerrain* terrain);

// The pair of that place already, if there is one.
std::optional<std::size_t> pair_of_place(const std::vector<ControlPair>& pairs, glm::dvec2 position,
                                         double within_m);
// A place of the map, and where it lies in the painting.
struct PlaceAnswer {
  KnownPlace place;
  std::optional<std::size_t> known = {};  // its number
  std::optional<std::size_t> pair = {};   // that it has already
  std::optional<ProposedPixel> painted = {};
  bool seen = true;
  double off_px = 0.0;  // of a proposal
};
Json place_json(const PlaceAnswer& answer);

}  // namespace belvedere::tools
