#include "http/static_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "temp_folder.h"

namespace hl::test_static_files {
namespace {

TEST(StaticFiles, ServesTheFolderAndNothingElse) {
  const auto folder = test::tempFolder() / "hl_pages";
  std::filesystem::create_directories(folder / "assets");
  std::ofstream(folder / "index.html") << "page";
  std::ofstream(folder / "assets" / "a.js") << "code";
  std::ofstream(folder / ".secret.txt") << "secret";
  std::ofstream(folder.parent_path() / "outside.txt") << "outside";
  const std::string root = folder.string();
  EXPECT_EQ(readStaticFile(root, "/")->content, "page");
  EXPECT_EQ(readStaticFile(root, "/assets/a.js?v=1")->mime, "text/javascript; charset=utf-8");
  for (const char* target : {"/../outside.txt", "/assets/../../outside.txt", "/.secret.txt", "/%2e%2e/outside.txt",
                             "\\..\\outside.txt", "/assets", "/none.js", "index.html", ""}) {
    EXPECT_FALSE(readStaticFile(root, target)) << target;
  }
}

}  // namespace
}  // namespace hl::test_static_files
