// What is no plain file is reported by its name and what it is, and never waited for.
#include "base/plain_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "base/error.h"
#include "temp_folder.h"

namespace hl::test::test_plain_file {

namespace {

// Without the name in front, which each must have.
std::string faultOf(const std::string& path) {
  try {
    checkPlainFile(path);
  } catch (const Error& error) {
    const std::string line = error.what();
    return line.starts_with(path) ? line.substr(path.size()) : "without its name: " + line;
  }
  return "";
}

TEST(PlainFile, IsReadWhereItIsOne) {
  const std::string file = fileWith("plain", "text");
  EXPECT_EQ(faultOf(file), "");
  std::filesystem::create_symlink(file, tempFile("link"));
  EXPECT_EQ(faultOf(tempFile("link")), "");
}

TEST(PlainFile, GivesItsBytes) {
  const std::string bytes("a\0\r\n\xff", 5);
  EXPECT_EQ(contentOf(fileWith("bytes", bytes)), bytes);
  EXPECT_EQ(contentOf(fileWith("nothing", "")), "");
  EXPECT_EQ(contentOf(tempFile("nowhere")), std::nullopt);
}

TEST(PlainFile, IsNothingElse) {
  EXPECT_EQ(faultOf(tempFile("nowhere")), ": there is no such file");
  EXPECT_EQ(faultOf(""), ": there is no such file");
  EXPECT_EQ(faultOf(tempFolder().string()), ": is a folder");
  EXPECT_EQ(faultOf("/dev/zero"), ": is not a file");
  std::filesystem::create_symlink("/dev/zero", tempFile("zero"));
  EXPECT_EQ(faultOf(tempFile("zero")), ": is not a file");
  ASSERT_EQ(mkfifo(tempFile("pipe").c_str(), 0600), 0);
  EXPECT_EQ(faultOf(tempFile("pipe")), ": is not a file");
  std::filesystem::create_symlink("circle", tempFile("circle"));
  EXPECT_EQ(faultOf(tempFile("circle")), ": may not be read: Too many levels of symbolic links");
}

}  // namespace

}  // namespace hl::test::test_plain_file
