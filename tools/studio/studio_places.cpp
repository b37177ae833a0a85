#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "base/error.h"
#include "terrain/fetch/fetch_area.h"
#include "tools/studio/job.h"
#include "tools/studio/request_body.h"
#include "tools/studio/studio_state.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

// Numbers in a text, with this between them and spaces beside it; one or two.
std::vector<double> read_numbers(const std::string& text, char between, const char* member,
                                 const char* allowed) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto skip_spaces = [&] {
    while (at != end && *at == ' ') ++at;
  };
  for (bool more = true; more;) {
    skip_spaces();
    double number = 0.0;
    const std::from_chars_result read = std::from_chars(at, end, number);
    at = read.ptr;
    skip_spaces();
    more = at != end && *at == between;
    if (read.ec != std::errc() || numbers.size() == 2 || (at != end && !more))
      throw Error(ErrorKind::usage, member, fmt::format("\"{}\"", text.substr(0, 80)), allowed);
    numbers.push_back(number);
    if (more) ++at;
  }
  return numbers;
}

}  // namespace

// A position and a size as `fetch` takes them. The folder below the scene's is named by them alone.
HttpAnswer StudioState::start_fetch(const HttpRequest& request) {
  const std::string scene = moment(request).scene.folder;
  WantedPlace place;
  constexpr const char* position = "longitude and latitude in degrees: 11.4, 47.35";
  const std::string where = read_text_member(request.body, "place");
  const std::vector<double> at = read_numbers(where, ',', "place", position);
  if (at.size() != 2)
    throw Error(ErrorKind::usage, "place", fmt::format("\"{}\"", where), position);
  place.at_lonlat = {at[0], at[1]};
  const std::vector<double> size = read_numbers(read_text_member(request.body, "size", "60"), 'x',
                                                "size", "kilometres: 60, or 80x50");
  place.size_km = {size.front(), size.back()};
  place.land_cover = read_text_member(request.body, "land_cover", "yes") == "yes";
  // Refuses at once what is out of range.
  constexpr double any_cell_m = 30.0;
  FetchParameters area;
  area.at_lonlat = place.at_lonlat;
  area.size_km = place.size_km;
  fetch_frame(area, any_cell_m);
  if (!open_place)
    throw Error(ErrorKind::usage, "place", "this studio does not fetch maps",
                "files dropped on the page");
  const fs::path folder =
      fs::path(scene) / fmt::format("place_{:.4f}_{:.4f}_{:g}x{:g}", place.at_lonlat.x,
                                    place.at_lonlat.y, place.size_km.x, place.size_km.y);
  if (fs::is_symlink(fs::symlink_status(folder)))
    throw Error(ErrorKind::output, folder.string(), "is a link", "a folder, or nothing");
  place.folder = folder.string();
  fetch->start(place.folder, run, [place, open = open_place](const Run& given) {
    try {
      return open(place, given);
    } catch (...) {
      std::error_code ignored;
      fs::remove(place.folder, ignored);  // only where nothing is in it
      throw;
    }
  });
  return json_answer(fetch_json(), 202);
}

Json StudioState::fetch_json() const {
  const Job::Report report = fetch->report();
  Json out = job_json(report);
  if (report.state == Job::State::done) out.add("text", Json::text(report.result));
  return out;
}

}  // namespace belvedere::tools
