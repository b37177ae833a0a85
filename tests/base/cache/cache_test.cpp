#include "base/cache/cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <thread>

#include "base/cache/content_hash.h"
#include "base/error.h"
#include "tests/files.h"
#include "tests/notes.h"
#include "tests/small_disk.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using test::Notes;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Bytes bytes_of(const std::string& text) {
  Bytes bytes(text.size());
  std::transform(text.begin(), text.end(), bytes.begin(),
                 [](char c) { return static_cast<std::byte>(c); });
  return bytes;
}

class CacheTest : public ::testing::Test {
 protected:
  static CacheKey key(const std::string& text) { return {"land cover", "karwendel", text}; }
  void store(const std::string& text, const std::string& value) {
    cache_.store(key(text), bytes_of(value), notes_);
  }
  std::optional<Bytes> find(const std::string& text) { return cache_.find(key(text), notes_); }
  std::string path_of(const std::string& text) const {
    return fs::path(folder_.path()) / (hash_bytes("land cover\n" + text) + ".cache");
  }
  void make_older(const std::string& text, int hours) const {
    fs::last_write_time(path_of(text),
                        fs::file_time_type::clock::now() - std::chrono::hours(hours));
  }

  test::Folder folder_;
  Notes notes_;
  Cache cache_{{.folder = folder_.path(), .limit_bytes = 0}};
};

TEST_F(CacheTest, GivesBackWhatWasStoredWithTheKey) {
  EXPECT_FALSE(find("a"));
  store("a", "forest");
  store("b", "");
  EXPECT_EQ(find("a"), bytes_of("forest"));
  EXPECT_EQ(find("b"), bytes_of(""));
  EXPECT_FALSE(find("c"));
  EXPECT_FALSE(cache_.find({"sheet", "karwendel", "a"}, notes_)) << "another product";
  EXPECT_EQ(cache_.find({"land cover", "another name", "a"}, notes_), bytes_of("forest"))
      << "whose it is does not count";
  const std::vector<Bytes> parts = {bytes_of("two "), bytes_of("parts")};
  const std::vector<std::span<const std::byte>> spans(parts.begin(), parts.end());
  cache_.store(key("a"), spans, notes_);
  EXPECT_EQ(find("a"), bytes_of("two parts"));
  EXPECT_EQ(folder_.count(), 2U) << "nothing temporary is left";
  EXPECT_THAT(notes_.all, IsEmpty());
}

// Straight from the file, whichever sizes the values have.
TEST_F(CacheTest, ValuesAreReadAsTheyWereStored) {
  Grid<float> large(700, 300);
  for (std::size_t i = 0; i < large.size(); ++i) large.data()[i] = static_cast<float>(i);
  const std::vector<std::string> texts(40000, "moraine");
  ByteWriter writer;
  writer(texts, large, texts);
  cache_.store(key("a"), writer.parts(), notes_);
  Grid<float> grid;
  std::vector<std::string> before;
  std::vector<std::string> after;
  const auto read = [&](ByteReader& bytes) { bytes(before, grid, after); };
  EXPECT_TRUE(cache_.read(key("a"), read, notes_));
  EXPECT_EQ(grid, large);
  EXPECT_EQ(before, texts);
  EXPECT_EQ(after, texts);
  EXPECT_FALSE(cache_.read(key("b"), read, notes_));
  EXPECT_THAT(notes_.all, IsEmpty());
  // Not to its end; then with a wrong value.
  EXPECT_FALSE(cache_.read(
      key("a"), [&](ByteReader& bytes) { bytes(before); }, notes_));
  cache_.store(key("a"), writer.parts(), notes_);
  std::string content = test::read_bytes(path_of("a"));
  content[content.size() / 2] ^= 1;
  test::write_bytes(path_of("a"), content);
  EXPECT_FALSE(cache_.read(key("a"), read, notes_));
  EXPECT_THAT(notes_.all, SizeIs(2));
}

// Whichever byte is wrong, and wherever the file ends.
TEST_F(CacheTest, DamageIsFoundAndTheEntryRemoved) {
  store("a", "forest and rock");
  const std::string whole = test::read_bytes(path_of("a"));
  const std::size_t subject = whole.find("karwendel");
  std::size_t refused = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] ^= 0x10;
    test::write_bytes(path_of("a"), damaged);
    const bool named = i >= subject && i < subject + 9;  // for people only
    EXPECT_EQ(find("a").has_value(), named) << i;
    EXPECT_EQ(fs::exists(path_of("a")), named) << i;
    refused += named ? 0 : 1;
    test::write_bytes(path_of("a"), whole.substr(0, i));
    EXPECT_FALSE(find("a")) << i;
  }
  test::write_bytes(path_of("a"), whole + "x");
  EXPECT_FALSE(find("a"));
  EXPECT_THAT(notes_.all, SizeIs(refused + whole.size() + 1));
  EXPECT_THAT(notes_.all.front(),
              AllOf(HasSubstr("damaged"), HasSubstr("land cover of karwendel")));
  // An entry of another key under this name.
  store("b", "sheet");
  fs::rename(path_of("b"), path_of("a"));
  EXPECT_FALSE(find("a"));
}

TEST_F(CacheTest, WhatIsNoFileIsNoEntry) {
  fs::create_directories(path_of("a"));
  EXPECT_FALSE(find("a"));
  ASSERT_EQ(::mkfifo(path_of("b").c_str(), 0600), 0);
  EXPECT_FALSE(find("b")) << "and does not wait for a writer";
}

TEST_F(CacheTest, OverItsLimitTheLeastUsedGo) {
  const std::string kib(1024, 'x');
  for (const char* text : {"a", "b", "c"}) store(text, kib);
  make_older("a", 3);
  make_older("b", 2);
  make_older("c", 1);
  EXPECT_TRUE(find("a")) << "which is a use";
  const Cache small({.folder = folder_.path(), .limit_bytes = 3700});
  small.store(key("d"), bytes_of(kib), notes_);
  EXPECT_TRUE(find("a"));
  EXPECT_FALSE(find("b"));
  EXPECT_TRUE(find("c"));
  EXPECT_TRUE(find("d"));
  // An entry too large to be kept must not evict others.
  small.store(key("e"), bytes_of(std::string(4000, 'x')), notes_);
  EXPECT_FALSE(find("e"));
  EXPECT_EQ(folder_.count(), 3U);
}

TEST_F(CacheTest, AFolderThatCannotBeUsedIsNotedOnce) {
  const Cache blocked({.folder = folder_.write("file", "") + "/cache", .limit_bytes = 0});
  EXPECT_FALSE(blocked.find(key("a"), notes_));
  blocked.store(key("a"), bytes_of("forest"), notes_);
  blocked.store(key("b"), bytes_of("forest"), notes_);
  EXPECT_FALSE(blocked.find(key("a"), notes_));
  EXPECT_THAT(notes_.all, ElementsAre(AllOf(HasSubstr("file/cache"), HasSubstr("not used"))));
}

TEST_F(CacheTest, AFullDiskIsNotedOnceAndLeavesNothingHalfWritten) {
  for (const rlim_t room : {0, 10, 100}) {
    const test::SmallDisk disk(room);
    store("a", "forest");
    EXPECT_FALSE(find("a")) << room;
    EXPECT_EQ(folder_.count(), 0U) << room;
  }
  EXPECT_THAT(notes_.all, SizeIs(1));
  store("a", "forest");
  EXPECT_EQ(find("a"), bytes_of("forest"));
}

// Entries and temporary files of tomorrow: nothing is lost, and ages are not negative.
TEST_F(CacheTest, AClockThatGoesBackwardsLosesNothing) {
  store("a", "forest");
  make_older("a", -24);
  folder_.write(std::string(32, '0') + "-1-1.cache-tmp", "another run's");
  fs::last_write_time(folder_ / (std::string(32, '0') + "-1-1.cache-tmp"),
                      fs::file_time_type::clock::now() + std::chrono::hours(24));
  EXPECT_EQ(cache_entries(folder_.path()).at(0).age_s, 0);
  EXPECT_THAT(clear_cache(folder_.path(), 1), IsEmpty());
  store("b", "");
  EXPECT_EQ(folder_.count(), 3U);
  EXPECT_EQ(find("a"), bytes_of("forest"));
}

TEST_F(CacheTest, WithoutAFolderNothingIsKept) {
  no_cache().store(key("a"), bytes_of("forest"), notes_);
  EXPECT_FALSE(no_cache().find(key("a"), notes_));
  EXPECT_FALSE(no_cache().is_on());
  EXPECT_THAT(notes_.all, IsEmpty());
  EXPECT_EQ(folder_.count(), 0U);
}

// Readers get whole entries while others replace, remove and trim them.
TEST_F(CacheTest, ManyAtOnceFindWholeEntriesOrNone) {
  const std::string value(100'000, 'v');
  std::atomic<int> wrong = 0;
  std::vector<std::thread> users;
  for (int user = 0; user < 4; ++user)
    users.emplace_back([&, user] {
      Notes own;
      const Cache cache({.folder = folder_.path(), .limit_bytes = 350'000});
      for (int round = 0; round < 40; ++round) {
        const std::string name = std::to_string((user + round) % 5);
        cache.store(key(name), bytes_of(value + name), own);
        const std::optional<Bytes> found = cache.find(key(name), own);
        if (found && *found != bytes_of(value + name)) ++wrong;
      }
      wrong += static_cast<int>(own.all.size());
    });
  for (std::thread& user : users) user.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_LE(folder_.count(), 3U);
}

TEST_F(CacheTest, EntriesAreListedAndClearedByAge) {
  EXPECT_THAT(cache_entries(folder_ / "nowhere"), IsEmpty());
  store("old", "1");
  store("new", "22");
  make_older("old", 50);
  folder_.write("letter.txt", "mine");
  folder_.write("0123456789abcdef0123456789abcdef-1-0.cache-tmp", "of a program that runs");
  const std::string left =
      folder_.write("0123456789abcdef0123456789abcdef-2-0.cache-tmp", "of one that was killed");
  fs::last_write_time(left, fs::file_time_type::clock::now() - std::chrono::hours(25));
  const std::vector<CacheEntry> entries = cache_entries(folder_.path());
  ASSERT_THAT(entries, SizeIs(2));
  EXPECT_EQ(entries[0].path, path_of("new")) << "the last used first";
  EXPECT_EQ(entries[0].bytes, entries[1].bytes + 1);
  EXPECT_EQ(entries[1].product, "land cover");
  EXPECT_EQ(entries[1].subject, "karwendel");
  EXPECT_EQ(entries[1].age_s / 3600, 50);

  EXPECT_THAT(clear_cache(folder_.path(), 51 * 3600), IsEmpty());
  EXPECT_FALSE(fs::exists(left));
  const std::vector<CacheEntry> removed = clear_cache(folder_.path(), 49 * 3600);
  ASSERT_THAT(removed, SizeIs(1));
  EXPECT_EQ(removed[0].path, path_of("old"));
  EXPECT_FALSE(find("old"));
  EXPECT_TRUE(find("new"));
  EXPECT_THAT(clear_cache(folder_.path()), SizeIs(1));
  EXPECT_EQ(folder_.count(), 2U) << "what is not the cache's stays";
}

TEST_F(CacheTest, MayGrowToATenthOfTheDiskAtMost) {
  const fs::space_info space = fs::space(folder_.path());
  EXPECT_LE(default_cache_limit(folder_.path()), std::uint64_t{20} << 30);
  EXPECT_LE(static_cast<double>(default_cache_limit(folder_.path())),
            0.11 * static_cast<double>(space.capacity));
  EXPECT_GT(default_cache_limit(folder_.path()), 0U);
}

template <class T>
std::string text(const T& value) {
  return CacheKeyText().add("value", value).str();
}

TEST(CacheKeyText, OtherNumbersAreOtherTexts) {
  const std::set<std::string> texts = {
      text(0.1), text(std::nextafter(0.1, 1.0)), text(0.0), text(-0.0), text(0.1F), text(1),
      text(true)};
  EXPECT_EQ(texts.size(), 7U);
  EXPECT_EQ(text(0.1), "value=0x1.999999999999ap-4\n") << "as C prints %a";
  EXPECT_EQ(text(std::uint64_t{18446744073709551615U}), "value=18446744073709551615\n");
}

// No value can look like two values, or like part of its neighbour.
TEST(CacheKeyText, TextsAndListsKeepTheirEnds) {
  using Texts = std::vector<std::string>;
  const std::set<std::string> texts = {text(Texts{"a", "b"}), text(Texts{"ab"}),
                                       text(Texts{"a\",1\"b"}), text(Texts{"a,", "b"}),
                                       text(Texts{})};
  EXPECT_EQ(texts.size(), 5U);
  EXPECT_NE(CacheKeyText().add("a", "x\nb=1\"y\"").str(),
            CacheKeyText().add("a", "x").add("b", "y").str());
  using Settings = std::vector<std::pair<std::string, double>>;
  EXPECT_NE(text(Settings{{"a", 1.0}, {"b", 2.0}}), text(Settings{{"b", 2.0}, {"a", 1.0}}));
  EXPECT_NE(text(std::optional<double>()), text(std::optional<double>(0.0)));
  EXPECT_NE(text(glm::dvec2(1.0, 2.0)), text(glm::dvec2(2.0, 1.0)));
}

TEST(CacheKeyText, OneCellMakesAnotherGrid) {
  Grid<float> grid(40, 30, 2.F);
  const std::string before = text(grid);
  EXPECT_EQ(text(Grid<float>(40, 30, 2.F)), before);
  EXPECT_NE(text(Grid<float>(30, 40, 2.F)), before);
  grid(39, 29) = std::nextafter(2.F, 3.F);
  EXPECT_NE(text(grid), before);
}

}  // namespace
}  // namespace belvedere
