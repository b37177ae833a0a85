#include "renderer/compose/proposals.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/compose/view_changes.h"

namespace belvedere {
namespace {

double off_by(double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d - 360.0 * std::floor(d / 360.0), 360.0 - (d - 360.0 * std::floor(d / 360.0)));
}

bool differ(const ViewSearch& search, const Candidate& a, const Candidate& b, double degrees) {
  const double turn = off_by(a.view.azimuth_deg, b.view.azimuth_deg);
  const double moved = glm::distance(a.view.viewer, b.view.viewer) / search.ground.side_m;
  if (turn > degrees) return true;
  // If the direction is given, another position, or another subject from a little farther off, is
  // another view.
  if (search.request.towards_deg)
    return moved > 0.25 || (moved > 0.12 && a.plan.anchor != b.plan.anchor);
  return moved > 0.25 && a.plan.anchor != b.plan.anchor;
}

std::vector<Candidate> best_that_differ(const ViewSearch& search, std::vector<Candidate> candidates,
                                        std::size_t max, double degrees) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  std::vector<Candidate> out;
  for (Candidate& candidate : candidates) {
    if (out.size() == max) break;
    if (std::all_of(out.begin(), out.end(), [&](const Candidate& other) {
          return differ(search, candidate, other, degrees);
        }))
      out.push_back(std::move(candidate));
  }
  return out;
}

// From a given position some directions have no leading subject; they are used only if all lack
// one.
void drop_views_of_nothing(const ViewSearch& search, std::vector<Candidate>& candidates) {
  if (!search.request.from) return;
  const auto shows_none = [](const Candidate& c) {
    return !c.measures.anchors[static_cast<std::size_t>(c.plan.anchor)].inside;
  };
  if (!std::all_of(candidates.begin(), candidates.end(), shows_none))
    std::erase_if(candidates, shows_none);
}

}  // namespace

void require_region(const CoarseGround& ground, const Massifs& massifs, const std::string& name) {
  constexpr double min_side_m = 8000.0;
  constexpr double max_void = 0.6;
  constexpr double min_relief = 0.008;  // of the side
  if (ground.side_m < min_side_m)
    throw Error(
        ErrorKind::input, name,
        fmt::format("holds data of {:.0f} km², a square of {:.1f} km: too little for a panorama",
                    ground.side_m * ground.side_m / 1e6, ground.side_m / 1000.0),
        "a region of 8 km or more per side, better 30 to 80; several files are joined");
  if (ground.void_share > max_void)
    throw Error(ErrorKind::input, name,
                fmt::format("{:.0f} % of it has no data", 100.0 * ground.void_share),
                "a part with data (gdal_translate -projwin), or further files that fill the gaps");
  if (ground.relief_m < min_relief * ground.side_m)
    throw Error(ErrorKind::input, name,
                fmt::format("is nearly flat: {:.0f} m between high and low on {:.0f} km",
                            ground.relief_m, ground.side_m / 1000.0),
                "a region with mountains, or a scene written by hand");
  if (massifs.anchors.empty())
    throw Error(ErrorKind::input, name,
                "all summits lie at its edge: there is no mountain to look at",
                "a larger region around the mountains");
}

std::vector<Candidate> propose_views(const ViewSearch& search,
                                     const ProposalParameters& parameters) {
  std::vector<Candidate> candidates = first_candidates(search);
  if (candidates.empty()) {
    std::string found = "no view fits: every one would show the end of the data";
    std::string allowed = "a larger region";
    if (search.request.from)
      found = "no view from there fits: the data do not cover the ground it would show",
      allowed = "another position for --from, or a larger region";
    else if (search.request.format.full_turn)
      allowed = "a larger region, or a narrower picture (--format 3:1)";
    else if (search.request.format.aspect > 2.5)
      allowed = "a larger region, or a narrower picture (--format 2:1)";
    if (search.request.towards_deg) allowed += ", or another direction";
    throw Error(ErrorKind::input, "the region", found, allowed);
  }
  drop_views_of_nothing(search, candidates);
  // More are refined than requested: some converge to the same view.
  const auto wanted = static_cast<std::size_t>(parameters.max);
  constexpr double apart_before = 20.0, apart = 25.0;
  std::vector<Candidate> starts =
      best_that_differ(search, std::move(candidates), wanted + 3, apart_before);
  const std::vector<WideGround> wide =
      search.request.plain ? std::vector<WideGround>{} : widen_grounds(search.ground);
  parallel_ranges(starts.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      starts[i] = refine(search, std::move(starts[i]));
      if (!search.request.plain) starts[i] = with_changes(search, wide, starts[i]);
    }
  });
  drop_views_of_nothing(search, starts);
  std::vector<Candidate> out = best_that_differ(search, std::move(starts), wanted, apart);
  for (const ViewRequest::Place& position : search.request.include) {
    const std::size_t at = search.massifs.anchors.size() +
                           static_cast<std::size_t>(&position - search.request.include.data());
    std::erase_if(out, [&](const Candidate& c) { return !c.measures.anchors[at].inside; });
    if (out.empty())
      throw Error(ErrorKind::input, "--include",
                  fmt::format("no view of this region shows {}",
                              position.name.empty() ? "that position" : position.name),
                  "a position farther from the edge of the data, or a larger region");
  }
  return out;
}

}  // namespace belvedere
