#include "apps/common/OutputFiles.h"

#include "ProgramTest.h"
#include <mrpt_polyloc/base/errors.h>

#include <gmock/gmock.h>

#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace mrpt_polyloc::apps {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

class OutputFilesTest : public test::ProgramTest {};

TEST_F(OutputFilesTest, AppearAtCommitAndNotBefore) {
  write("b", "old");
  OutputFiles out;
  out.add(path("a"), "one");
  out.add(path("b"), "two");
  EXPECT_FALSE(std::filesystem::exists(path("a")));
  EXPECT_EQ(test::readFile(path("b")), "old");
  out.commit();
  EXPECT_EQ(test::readFile(path("a")), "one");
  EXPECT_EQ(test::readFile(path("b")), "two");
  EXPECT_THAT(files(), ElementsAre("a", "b"));
}

TEST_F(OutputFilesTest, LeaveNothingIfNotCommitted) {
  {
    OutputFiles out;
    out.add(path("a"), "one");
    EXPECT_EQ(std::filesystem::path(out.stage(path("b.rawlog"))).extension(), ".rawlog");
  }
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(OutputFilesTest, AFailedCommitLeavesNoneBehind) {
  OutputFiles out;
  out.add(path("a"), "one");
  out.add(path("b"), "two");
  std::filesystem::create_directory(path("b"));  // so that renaming to it fails
  EXPECT_THROW(out.commit(), FormatError);
  EXPECT_THAT(files(), testing::Not(testing::Contains("a")));
}

TEST_F(OutputFilesTest, SayWhyAPlaceCannotBeWritten) {
  write("file", "");
  std::filesystem::create_directory(path("folder"));
  const auto reasonFor = [&](const std::string& name, const char* reason) {
    EXPECT_THAT(
        [&] { writeFile(path(name), "x"); },
        ThrowsMessage<FormatError>(testing::AllOf(HasSubstr(path(name)), HasSubstr(reason))));
    EXPECT_THROW(requireWritable(path(name)), FormatError);
  };
  reasonFor("none/a", "No such file or directory");
  reasonFor("file/a", "Not a directory");
  reasonFor("folder", "it is a folder");
  EXPECT_THAT(files(), ElementsAre("file", "folder"));
}

TEST_F(OutputFilesTest, ASymbolicLinkStaysOne) {
  write("target", "old");
  std::filesystem::create_symlink(path("target"), path("link"));
  writeFile(path("link"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_EQ(test::readFile(path("target")), "new");
}

TEST_F(OutputFilesTest, APipeIsWrittenNotReplaced) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  const int reader = ::open(path("pipe").c_str(), O_RDWR | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  writeFile(path("pipe"), "text");
  char text[8] = {};
  EXPECT_EQ(::read(reader, text, sizeof text), 4);
  EXPECT_STREQ(text, "text");
  ::close(reader);
  EXPECT_TRUE(std::filesystem::is_fifo(path("pipe")));
  EXPECT_THAT(files(), ElementsAre("pipe"));
}

TEST_F(OutputFilesTest, FoldersAreMadeWithThoseAbove) {
  makeFolder(path("a/b"));
  makeFolder(path("a/b"));
  EXPECT_TRUE(std::filesystem::is_directory(path("a/b")));
  write("file", "");
  EXPECT_THAT([&] { makeFolder(path("file")); },
              ThrowsMessage<FormatError>(HasSubstr(path("file"))));
  EXPECT_THAT([&] { makeFolder(path("file/x")); },
              ThrowsMessage<FormatError>(HasSubstr(path("file/x"))));
}

}  // namespace
}  // namespace mrpt_polyloc::apps
