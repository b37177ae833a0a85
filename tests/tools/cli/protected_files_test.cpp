// Every command leaves the user's files alone: its inputs, files that are read-only, and in folders
// of results and beside them what the program did not write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <map>

#include "tests/tools/cli/small_commands.h"
#include "tools/cli/commands.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using test::SmallCase;
using test::Words;
using testing::AnyOf;
using testing::HasSubstr;

class ProtectedFiles : public test::SmallCommands, public ::testing::WithParamInterface<SmallCase> {
 protected:
  using Files = std::map<std::string, std::string>;  // path, bytes

  // All files below the test's folder but streams and hidden ones: records and locks.
  Files files() const {
    Files out;
    for (const auto& entry : fs::recursive_directory_iterator(path(""))) {
      const std::string name = entry.path().lexically_relative(path("")).string();
      if (!entry.is_regular_file() || name.find("/.") != std::string::npos ||
          name.starts_with('.') || name == "stdout" || name == "stderr")
        continue;
      out[entry.path().string()] = read_bytes(entry.path());
    }
    return out;
  }
  Outcome run_last() const {
    return run(line_of(GetParam(), GetParam().lines.size() - 1), without_cache());
  }
  bool is_named(const std::string& file) const {
    const Words line = line_of(GetParam(), GetParam().lines.size() - 1);
    return std::find(line.begin(), line.end(), file) != line.end();
  }
  // An input that a result may be mistaken for: the first file of the line, and what a scene reads.
  std::vector<std::string> inputs() const {
    std::vector<std::string> out;
    for (const std::string& word : line_of(GetParam(), GetParam().lines.size() - 1))
      if (out.empty() && fs::is_regular_file(word) && word.starts_with(path("")) &&
          !word.starts_with(path("out/")))
        out = {word};
    if (!out.empty() && out[0].ends_with(".toml")) out.push_back(path("dem.tif"));
    return out;
  }
};

// What stands at the name of a result, and whether the user named it: then it may be replaced.
TEST_P(ProtectedFiles, AreLeftAlone) {
  write_files({48, 48, false});
  for (std::size_t i = 0; i + 1 < GetParam().lines.size(); ++i)
    ASSERT_EQ(run(line_of(GetParam(), i), without_cache()).status, 0);
  const Files before = files();
  const Outcome first = run_last();
  std::vector<std::string> results;
  // These pairs have no view, these labels no pixels well inside, this mask too little beside it.
  const std::map<std::string, Words> refused_for_their_data = {
      {"exemplar register", {"out/index.html", "out/registered.toml"}},
      {"composite learn", {"out/c"}},
      {"texture remove", {"out/r.png"}}};
  if (const auto found = refused_for_their_data.find(GetParam().command);
      found != refused_for_their_data.end()) {
    for (const std::string& name : found->second)
      results.push_back(write(name, "of an earlier run"));
  } else {
    ASSERT_EQ(first.status, 0) << first.err;
  }
  const Files after = files();
  for (const auto& [file, bytes] : after)
    if (!before.contains(file)) results.push_back(file);
  for (const auto& [file, bytes] : before) EXPECT_EQ(after.at(file), bytes) << file;
  // A report has dozens of pictures.
  if (results.size() > 8)
    std::erase_if(results, [&, first_one = results.front()](const std::string& file) {
      return file != first_one && !is_named(file) && !file.ends_with(".html");
    });

  for (const std::string& result : results) {
    SCOPED_TRACE(result);
    const auto refused = [&](const char* what) {
      const Outcome outcome = run_last();
      EXPECT_THAT(outcome.status, AnyOf(2, 3, 4)) << what << ": " << outcome.out << outcome.err;
      return outcome;
    };
    bool hard = true;
    for (const std::string& input : inputs()) {
      fs::remove(result);
      if (hard)
        fs::create_hard_link(input, result);
      else
        fs::create_symlink(input, result);
      hard = !hard;
      refused("a link to an input");
      EXPECT_EQ(read_bytes(input), before.at(input));
      fs::remove(result);
    }
    test::write_bytes(result, after.at(result));
    ::chmod(result.c_str(), 0444);
    refused("read-only");
    EXPECT_EQ(read_bytes(result), after.at(result));
    ::chmod(result.c_str(), 0644);
    if (!is_named(result) || result.ends_with(".html")) {
      test::write_bytes(result, "mine");
      refused("a file of somebody else");
      EXPECT_EQ(read_bytes(result), "mine");
      test::write_bytes(result, after.at(result));
    }
    for (const auto& [file, bytes] : before) EXPECT_EQ(read_bytes(file), bytes) << file;
  }
  // No temporary file is left.
  for (const auto& entry : fs::recursive_directory_iterator(path("")))
    EXPECT_EQ(entry.path().filename().string().find(".tmp"), std::string::npos) << entry.path();
}
INSTANTIATE_TEST_SUITE_P(Commands, ProtectedFiles, ::testing::ValuesIn(test::small_cases),
                         test::name_of_case);

}  // namespace
}  // namespace belvedere
