#include "tools/report/verification.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "renderer/image/image_io.h"
#include "tests/files.h"
#include "tests/http_server.h"

namespace belvedere::tools {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Verification good(const std::string& name = "good") {
  Verification out;
  out.scene = "scenes/" + name + ".toml";
  out.name = name;
  out.width = 40;
  out.height = 20;
  out.inputs = 3;
  out.products = {"guidance.exr", "panorama.png"};
  return out;
}

Verification differing() {
  Verification out = good("a<b>&\"c\"");
  out.notes = {"locked by version <0.1>"};
  out.differences = {{"guidance.exr", "Z", "12", "34"}, {"guidance.exr", "tone.V", "56", "78"}};
  return out;
}

Verification broken(int status) {
  Verification out = good("broken");
  out.products.clear();
  out.error_status = status;
  out.error = "dem.tif: is cut short\n  \x01 <control>";
  return out;
}

TEST(Verification, StatusIsTheFirstErrorsElseOneWhereSomethingDiffers) {
  EXPECT_EQ(exit_status({good(), good()}), 0);
  EXPECT_EQ(exit_status({good(), differing()}), 1);
  EXPECT_EQ(exit_status({differing(), broken(3), broken(2)}), 3);
}

TEST(Verification, OneLineNamesWhatDiffers) {
  EXPECT_EQ(one_line(good()), "scenes/good.toml: 40×20: the same");
  EXPECT_THAT(one_line(differing()), AllOf(HasSubstr("differs in guidance.exr (Z tone.V)"),
                                           HasSubstr("; locked by"), Not(HasSubstr("panorama"))));
  EXPECT_THAT(one_line(broken(3)), AllOf(HasSubstr("not compared"), HasSubstr("dem.tif")));
}

TEST(Verification, JunitIsXmlThatCounts) {
  const std::string xml = verification_junit({good(), differing(), broken(3)});
  EXPECT_THAT(xml, AllOf(HasSubstr("tests=\"7\" failures=\"1\" errors=\"1\""),
                         HasSubstr("name=\"scenes/a&lt;b&gt;&amp;&quot;c&quot;.toml\""),
                         HasSubstr("message=\"differs in Z tone.V\""), Not(HasSubstr("\x01"))));
  if (!test::has_python()) GTEST_SKIP() << "there is no python3 to read XML by";
  const test::Folder folder;
  const std::string script =
      folder.write("read.py",
                   "import sys, xml.etree.ElementTree as et\nroot = "
                   "et.parse(sys.argv[1]).getroot()\nsuites = root.findall('testsuite')\n"
                   "assert [s.get('name') for s in suites] == ['scenes/good.toml', "
                   "'scenes/a<b>&\"c\".toml', 'scenes/broken.toml']\n"
                   "assert [len(s.findall('testcase')) for s in suites] == [3, 3, 1]\n"
                   "assert [len(s.findall('.//failure')) for s in suites] == [0, 1, 0]\n"
                   "assert [len(s.findall('.//error')) for s in suites] == [0, 0, 1]\n"
                   "assert all(int(s.get('tests')) == len(s.findall('testcase')) for s in suites)\n"
                   "assert '<control>' in suites[2].find('.//error').get('message')\n");
  const std::string command = "python3 " + script + " " + folder.write("junit.xml", xml);
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(Verification, PageHoldsPicturesNowBeforeAndTheDifference) {
  const test::Folder folder;
  Verification scene = good("alps");
  scene.folder = folder / "now/alps";
  for (const char* name : {"now/alps", "old/alps", "scratch"})
    std::filesystem::create_directories(folder / name);
  Grid<glm::vec3> picture(40, 20, glm::vec3(.5F));
  write_png8(folder / "old/alps/panorama.png", picture, {});
  picture(3, 4).x = .9F;
  write_png8(folder / "now/alps/panorama.png", picture, {});
  scene.differences = {{"panorama.png", "R", "1<", "2"}};
  const auto figures = [](const std::string& page) {
    int count = 0;
    for (std::size_t at = 0;
         (at = page.find("\"src\": \"data:image/png;base64,", at)) != std::string::npos; ++at)
      ++count;
    return count;
  };
  const std::string alone =
      verification_page({good(), scene}, {.against = "", .scratch_folder = folder / "scratch"});
  EXPECT_EQ(figures(alone), 1);
  EXPECT_THAT(alone, AllOf(HasSubstr("1 of 2 scenes"), HasSubstr("\"locked\": \"1\\u003c\""),
                           HasSubstr("All channels are the same"), Not(HasSubstr("http"))));
  EXPECT_LT(alone.find("alps.toml"), alone.find("good.toml")) << "what differs comes first";
  const std::string both = verification_page(
      {good(), scene}, {.against = folder / "old", .scratch_folder = folder / "scratch"});
  EXPECT_EQ(figures(both), 3);
  EXPECT_THAT(both, AllOf(HasSubstr("\"differing\": 0.00125"),
                          HasSubstr("before")));  // one pixel of 800
  EXPECT_TRUE(std::filesystem::is_empty(folder / "scratch"));
  EXPECT_THAT(verification_page({broken(3)}, {}),
              AllOf(HasSubstr("\\u003ccontrol>"), HasSubstr("0 of 1")));
}

}  // namespace
}  // namespace belvedere::tools
