#include "server/static_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "temp_folder.h"

namespace hl {
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

TEST(StaticFiles, OnlyLoopbackHostsAndOwnOriginsAreOurs) {
  for (const char* host : {"127.0.0.1:1997", "localhost:1997", "[::1]:1997"}) EXPECT_TRUE(isLoopbackHost(host, 1997));
  for (const char* host : {"127.0.0.1", "evil.example:1997", "127.0.0.1:80", "127.0.0.1.evil.example:1997", ""}) {
    EXPECT_FALSE(isLoopbackHost(host, 1997)) << host;
  }
  EXPECT_TRUE(isOwnOrigin("", 1997));
  EXPECT_TRUE(isOwnOrigin("http://localhost:1997", 1997));
  for (const char* origin : {"null", "https://evil.example", "http://127.0.0.1:1998", "http://evil.example:1997"}) {
    EXPECT_FALSE(isOwnOrigin(origin, 1997)) << origin;
  }
}

}  // namespace
}  // namespace hl
