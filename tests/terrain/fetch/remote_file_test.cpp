// Realistic server behaviour: busy, slow, cut off, changed, gone. The data read are always right,
// and nothing is requested twice.
#include "terrain/fetch/remote_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/cache/cache.h"
#include "tests/terrain/fetch/served_tiles.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class Remote : public ServedTiles {
 protected:
  static constexpr std::size_t mib = RemoteFile::piece_bytes;
  static std::string noise(std::size_t bytes, unsigned seed = 1) {
    std::string out(bytes, '\0');
    std::uint32_t state = seed;
    for (char& c : out) c = static_cast<char>((state = state * 1664525U + 1013904223U) >> 24U);
    return out;
  }
  // A file of four pieces and a remainder.
  std::string serve_noise(const std::vector<std::string>& modes = {}, unsigned seed = 1) {
    const std::string bytes = noise(4 * mib + 1000, seed);
    folder_.write("served/file.bin", bytes);
    serve(modes);
    return bytes;
  }
  std::string read(std::uint64_t offset, std::size_t count, bool with_cache = true) {
    return read(offset, count, with_cache, http_options());
  }
  std::string read(std::uint64_t offset, std::size_t count, bool with_cache,
                   const HttpOptions& with_http_options) {
    HttpClient client(with_http_options, progress_);
    RemoteFile file(server_->address("file.bin"),
                    {client, with_cache ? cache_ : no_cache(), progress_, now_, false});
    std::string out(count, '\0');
    file.read(offset, count, out.data());
    return out;
  }
};

TEST_F(Remote, OnlyTheBytesThatAreNeededComeAndOnce) {
  const std::string bytes = serve_noise();
  EXPECT_TRUE(read(2 * mib + 10, 100) == bytes.substr(2 * mib + 10, 100));
  // The first piece, whose response contains the file size, and the third.
  EXPECT_THAT(requests(), SizeIs(2));
  EXPECT_THAT(requests()[1], HasSubstr(fmt::format("bytes={}-{}", 2 * mib, 3 * mib - 1)));
  EXPECT_TRUE(read(0, bytes.size()) == bytes);
  EXPECT_THAT(requests(), SizeIs(4));  // the second; the fourth and the rest in one
  EXPECT_TRUE(read(mib - 5, 2 * mib) == bytes.substr(mib - 5, 2 * mib));
  EXPECT_THAT(requests(), SizeIs(4));
  EXPECT_THAT(requests(), Each(HasSubstr("[Belvedere")));
}

TEST_F(Remote, FaultsAreAskedForAgainUntilAllIsThere) {
  for (const std::vector<std::string>& modes : {std::vector<std::string>{"fail=2"},
                                                {"fail=3", "after=1"},
                                                {"cut=1"},
                                                {"cut=3", "after=1"},
                                                {"short=1"},
                                                {"short=2", "after=1"},
                                                {"stall-once"},
                                                {"no-ranges"},
                                                {"no-ranges", "cut=1"}}) {
    for (const bool with_cache : {true, false}) {
      clear_cache(path("cache"));
      progress_.all.clear();
      const std::string bytes = serve_noise(modes);
      EXPECT_TRUE(read(100, 3 * mib, with_cache) == bytes.substr(100, 3 * mib))
          << modes[0] << with_cache << progress_.text();
      if (modes[0] == "no-ranges" && modes.size() == 1) continue;
      EXPECT_THAT(progress_.text(), AllOf(HasSubstr("file.bin"), HasSubstr("retrying")))
          << modes[0];
    }
  }
}

// A response of several pieces that is cut: complete pieces are not requested again.
TEST_F(Remote, WhatCameBeforeACutIsKept) {
  const std::string bytes = serve_noise({"cut=1", "after=1"});
  EXPECT_TRUE(read(0, 4 * mib) == bytes.substr(0, 4 * mib));
  // 3 pieces were requested, 9/4 of one arrived: two are there.
  ASSERT_THAT(requests(), SizeIs(3));
  EXPECT_THAT(requests()[2], HasSubstr(fmt::format("bytes={}-", 3 * mib)));
}

TEST_F(Remote, ServersWithoutPartsAreAskedOnce) {
  const std::string bytes = serve_noise({"no-ranges"});
  EXPECT_TRUE(read(mib, 3 * mib) == bytes.substr(mib, 3 * mib));
  EXPECT_TRUE(read(0, 10) == bytes.substr(0, 10));
  EXPECT_THAT(requests(), SizeIs(1));
}

TEST_F(Remote, ThereIsAnEndToPatience) {
  std::size_t asked_before = 0;
  const auto fails = [&](const std::vector<std::string>& modes, int retries) {
    HttpOptions tried = http_options();
    tried.retries = retries;
    clear_cache(path("cache"));
    serve_noise(modes);
    asked_before = requests().size();
    return test::input_error([&] { read(0, 2 * mib, true, tried); });
  };
  EXPECT_THAT(fails({"fail=1000"}, 3), AllOf(HasSubstr("503"), HasSubstr("file.bin")));
  EXPECT_EQ(requests().size() - asked_before, 4U);  // three retries
  EXPECT_THAT(fails({"stall"}, 0), HasSubstr("timed out"));
  EXPECT_THAT(fails({"short=1000"}, 3), HasSubstr("other bytes"));
}

TEST_F(Remote, AServerMaySayHowLongToWait) {
  serve_noise({"fail=1", "retry-after=1"});
  const auto begun = std::chrono::steady_clock::now();
  read(0, 10);
  EXPECT_GE(std::chrono::steady_clock::now() - begun, std::chrono::milliseconds(990));
  EXPECT_THAT(progress_.text(), HasSubstr("in 1 s"));
}

TEST_F(Remote, ARunGoesOnWhereTheLastEnded) {
  const std::string bytes = serve_noise({"fail=4", "after=1"});  // one more than is asked for again
  EXPECT_THROW(read(0, 2 * mib), Error);
  EXPECT_THAT(requests(), SizeIs(5));
  EXPECT_TRUE(read(0, 2 * mib) == bytes.substr(0, 2 * mib));
  ASSERT_THAT(requests(), SizeIs(6));
  EXPECT_THAT(requests()[5], HasSubstr(fmt::format("bytes={}-", mib)));
}

TEST_F(Remote, OfflineWhatIsKeptServes) {
  const std::string bytes = serve_noise();
  read(0, 2 * mib);
  HttpClient client(http_options(), progress_);
  const std::string address = server_->address("file.bin");
  server_.reset();
  now_ += 400LL * 86400;  // old, but there is nothing newer
  RemoteFile file(address, {client, cache_, progress_, now_, false});
  std::string out(100, '\0');
  file.read(mib + 7, 100, out.data());
  EXPECT_TRUE(out == bytes.substr(mib + 7, 100));
  EXPECT_THAT(progress_.text(), HasSubstr("using cached properties"));
  RemoteFile more(address, {client, cache_, progress_, now_, false});
  const std::string message = test::input_error([&] { more.read(3 * mib, 100, out.data()); });
  EXPECT_THAT(message, AllOf(HasSubstr("connection refused"), HasSubstr("--mirror")));
  EXPECT_TRUE(more.is_lost());
  RemoteFile nowhere("http://no-such-name.invalid/a.tif", {client, cache_, progress_, now_, false});
  EXPECT_THAT(test::input_error([&] { nowhere.describe(); }),
              AllOf(HasSubstr("no-such-name.invalid"), HasSubstr("cannot resolve host")));
}

TEST_F(Remote, WhatIsMissingIsKnownForAMonth) {
  serve();
  HttpClient client(http_options(), progress_);
  const auto is_missing = [&](bool refresh) {
    return RemoteFile(server_->address("none.bin"), {client, cache_, progress_, now_, refresh})
        .describe()
        .missing;
  };
  EXPECT_TRUE(is_missing(false));
  EXPECT_TRUE(is_missing(false));
  EXPECT_THAT(requests(), SizeIs(1));
  folder_.write("served/none.bin", "here");
  EXPECT_TRUE(is_missing(false));
  EXPECT_FALSE(is_missing(true));
  std::filesystem::remove(path("served/none.bin"));
  EXPECT_FALSE(is_missing(false));
  now_ += 31 * 86400;
  EXPECT_TRUE(is_missing(false));
}

// Another version under the same name: pieces of two versions are never mixed.
TEST_F(Remote, AChangedFileIsReadAnew) {
  const MapSource source = elevation_source(600);
  const auto edition = [&](unsigned seed, const std::string& tag) {
    std::uint32_t state = seed;
    const std::string file = serve_tile(source, 11, 47, [&](double, double) {
      return ((state = state * 1664525U + 1013904223U) >> 12U) * 1e-3;
    });
    test::write_bytes(file + ".tag", tag);
  };
  serve();
  HttpClient client(http_options(), progress_);
  const auto cells = [&](const Cache& cache, const DegreeBox& box) {
    return read_elevation_tiles(source, box, mirror(), {client, cache, progress_, now_, false})
        .parts[0]
        .cells;
  };
  edition(1, "\"one\"");
  cells(cache_, {11.4, 47.9, 11.6, 47.95});
  edition(99, "\"two\"");
  const DegreeBox all{11.1, 47.1, 11.9, 47.9};
  EXPECT_EQ(cells(cache_, all), cells(no_cache(), all));
  EXPECT_THAT(progress_.text(), HasSubstr("changed on the server"));
}

// Damaged bytes do not stay in the cache.
TEST_F(Remote, DamageIsAskedForAgain) {
  const MapSource source = elevation_source(600);
  std::uint32_t state = 5;
  const std::string file = serve_tile(source, 11, 47, [&](double, double) {
    return ((state = state * 1664525U + 1013904223U) >> 12U) * 1e-3;
  });
  const std::string good = test::read_bytes(file);
  std::string bad = good;
  std::fill(bad.begin() + static_cast<std::ptrdiff_t>(bad.size() / 3),
            bad.begin() + static_cast<std::ptrdiff_t>(bad.size() / 2), 'x');
  test::write_bytes(file, bad);
  serve();
  HttpClient client(http_options(), progress_);
  const auto cells = [&](const Cache& cache) {
    return read_elevation_tiles(source, {11.1, 47.1, 11.9, 47.9}, mirror(),
                                {client, cache, progress_, now_, false})
        .parts[0]
        .cells;
  };
  EXPECT_THAT(test::input_error([&] { cells(cache_); }),
              AllOf(HasSubstr("N47_00_E011"), HasSubstr("damaged")));
  test::write_bytes(file, good);
  EXPECT_EQ(cells(cache_), cells(no_cache()));
}

TEST(HttpOptions, AreHeldToTheirRange) {
  EXPECT_EQ(test::error_of([] { HttpClient({.silence_s = 0}, silent_progress()); }).kind(),
            ErrorKind::usage);
  EXPECT_EQ(test::error_of([] { HttpClient({.retries = 21}, silent_progress()); }).kind(),
            ErrorKind::usage);
}

}  // namespace
}  // namespace belvedere
