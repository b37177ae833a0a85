#pragma once

#include <condition_variable>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "base/error.h"
#include "renderer/register/pair_proposals.h"
#include "renderer/register/registered_ground.h"
#include "terrain/io/dem.h"
#include "terrain/register/registration.h"

namespace belvedere::tools {

// What the pairs say of the painting.
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

// The terrain as the fitted pairs show it. Where pairs are too few to trace it, without a view and
// lines, and all places in the painting count as seen.
struct FittedTerrain {
  std::unique_ptr<const RegisteredView> view;
  std::vector<DrawnLine> lines;
  std::vector<bool> seen;  // of the known places
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
  // What `input` refers to must outlive the fitter.
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

}  // namespace belvedere::tools
