#include "tests/support/temp_file.h"
#include <mrpt_polyloc/mrpt_bridge/IniSection.h>

#include <gmock/gmock.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <string>

namespace mrpt_polyloc {
namespace {

using testing::AllOf;
using testing::HasSubstr;

mrpt::config::CConfigFileMemory ini(const std::string& lines) {
  return mrpt::config::CConfigFileMemory("[S]\n" + lines + "\n");
}

TEST(IniSection, AcceptsAComment) {
  const auto file =
      ini("a=0.5 // metres\nb = 7 ; so many\nc=true # or not\nd=-1e-3;\ne=#none\nf=a#1;b.rawlog");
  const IniSection section(file, "S", {"a", "b", "c", "d", "e", "f"});
  EXPECT_EQ(section.number("a", 0), 0.5);
  EXPECT_EQ(section.count("b", 0, 0, 9), 7U);
  EXPECT_TRUE(section.flag("c", false));
  EXPECT_EQ(section.number("d", 0), -1e-3);
  EXPECT_EQ(section.number("e", 4.0), 4.0);  // nothing but a comment: not given
  EXPECT_EQ(section.text("f", ""), "a#1;b.rawlog");
}

TEST(IniSection, GivesTheDefaultWhereNothingIsGiven) {
  const auto file = ini("a=");
  const IniSection section(file, "S", {"a", "b"});
  EXPECT_EQ(section.number("a", 1.5), 1.5);
  EXPECT_EQ(section.count("b", 2, 0, 9), 2U);
  EXPECT_TRUE(section.flag("b", true));
  EXPECT_EQ(section.text("b", "c"), "c");
}

TEST(IniSection, NamesSectionOptionAndText) {
  const auto file = ini("n=1.5x\nm=nan\nc=-1\nf=perhaps\nl=3");
  const IniSection section(file, "S", {"n", "m", "c", "f", "l"});
  const auto complaint = [&](auto read) { return test::messageOf<InvalidParamsError>(read); };
  EXPECT_EQ(complaint([&] { section.number("n", 0); }), "[S]: n = '1.5x' is not a number");
  EXPECT_THAT(complaint([&] { section.number("m", 0); }), HasSubstr("'nan'"));
  EXPECT_THAT(complaint([&] { section.number("l", 0, 4, 5); }), HasSubstr("from 4 to 5"));
  EXPECT_THAT(complaint([&] { section.count("c", 0, 0, 9); }), HasSubstr("one whole number"));
  EXPECT_THAT(complaint([&] { section.flag("f", false); }),
              AllOf(HasSubstr("f ="), HasSubstr("true")));
  EXPECT_THAT(complaint([&] { IniSection(file, "S", {"n"}); }), HasSubstr("[S]: unknown option"));
}

}  // namespace
}  // namespace mrpt_polyloc
