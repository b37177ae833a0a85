// Every reader with damaged files: a few here, made from good examples by simple faults; as many as
// there is time for by libFuzzer, which tools/fuzz/run starts.
#include "tools/fuzz/targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "base/memory_limit.h"
#include "base/random.h"
#include "tests/files.h"
#include "tests/paths.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

// More for a search: BELVEDERE_FUZZ_RUNS=10000. The last file is kept as
// belvedere-damaged-TARGET in the folder for temporary files, in case the program crashes.
int damaged_files() {
  const char* runs = std::getenv("BELVEDERE_FUZZ_RUNS");
  return runs == nullptr ? 30 : std::atoi(runs);
}

std::vector<std::string> examples_of(const FuzzTarget& target) {
  std::vector<fs::path> places = {fs::path(test::source_folder()) / "tests/fuzz" / target.name};
  std::istringstream words{std::string(target.seeds)};
  for (std::string word; words >> word;) places.push_back(fs::path(test::source_folder()) / word);
  std::vector<fs::path> files;
  for (const fs::path& place : places) {
    if (fs::is_regular_file(place)) files.push_back(place);
    if (fs::is_directory(place))
      for (const auto& entry : fs::directory_iterator(place)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> examples;
  for (const fs::path& file : files) examples.push_back(test::read_bytes(file));
  return examples;
}

// One to four faults: a byte or a bit, a number that is too large, a piece left out, repeated, or
// taken from another example.
class Damage {
 public:
  Damage(const std::vector<std::string>& examples, int run) : examples_(examples), run_(run) {}

  std::string make() {
    std::string bytes = examples_[below(examples_.size())];
    for (std::size_t fault = 1 + below(4); fault > 0; --fault) {
      if (bytes.empty()) return bytes;
      const std::size_t at = below(bytes.size());
      const std::size_t length = 1 + below(std::min<std::size_t>(bytes.size() - at, 1 + below(64)));
      switch (below(8)) {
        case 0:
          bytes[at] = static_cast<char>(below(256));
          break;
        case 1:
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
          break;
        case 2:
          bytes.erase(at, length);
          break;
        case 3:
          bytes.insert(at, bytes.substr(at, length));
          break;
        case 4:
          bytes.resize(at);
          break;
        case 5: {
          const std::string& other = examples_[below(examples_.size())];
          if (!other.empty()) bytes.replace(at, length, other.substr(below(other.size()), length));
          break;
        }
        case 6:
          number(bytes, at);
          break;
        default:
          for (std::size_t i = at; i < at + length; ++i) bytes[i] = static_cast<char>(255);
      }
    }
    return bytes;
  }

 private:
  std::size_t below(std::size_t count) {
    return random_index(static_cast<std::uint32_t>(count), 47, run_, draw_++);
  }
  // Replaces the next number of a text.
  void number(std::string& bytes, std::size_t at) {
    const char* const values[] = {"0",    "-1",  "99999999999999999999", "1e308", "nan", "inf",
                                  "1e-9", "256", "2147483648",           "",      "-0.5"};
    const std::size_t begin = bytes.find_first_of("0123456789", at);
    if (begin == std::string::npos) return;
    const std::size_t end = bytes.find_first_not_of("0123456789.e-", begin);
    bytes.replace(begin, end == std::string::npos ? end : end - begin,
                  values[below(std::size(values))]);
  }

  const std::vector<std::string>& examples_;
  std::int64_t run_;
  std::int64_t draw_ = 0;
};

// The Error that refuses it; empty if it is read.
std::string refused(const FuzzTarget& target, const std::string& bytes) {
  const MemoryLimit limit(std::uint64_t{1} << 30);
  try {
    target.read(bytes);
    return {};
  } catch (const Error& error) {
    EXPECT_NE(error.kind(), ErrorKind::bug) << error.what();
    EXPECT_FALSE(error.found().empty());
    return error.what();
  }
}

class Readers : public testing::TestWithParam<std::size_t> {};

TEST_P(Readers, ReadAnExampleAndReadOrRefuseWhatIsDamaged) {
  const FuzzTarget& target = fuzz_targets()[GetParam()];
  const std::vector<std::string> examples = examples_of(target);
  bool read = false;
  std::string fault = "no examples";
  for (const std::string& example : examples) {
    fault = refused(target, example);
    read = read || fault.empty();
  }
  EXPECT_TRUE(read) << fault;
  const fs::path last =
      fs::path(testing::TempDir()) / ("belvedere-damaged-" + std::string(target.name));
  for (int run = 0; run < damaged_files(); ++run) {
    const std::string bytes = Damage(examples, run).make();
    test::write_bytes(last, bytes);
    refused(target, bytes);
  }
  fs::remove(last);
}

INSTANTIATE_TEST_SUITE_P(All, Readers, testing::Range<std::size_t>(0, fuzz_targets().size()),
                         [](const auto& each) {
                           return std::string(fuzz_targets()[each.param].name);
                         });

}  // namespace
}  // namespace belvedere
