#include "http/static_files.h"

#include <array>
#include <fstream>
#include <sstream>
#include <utility>

namespace hl {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kMimeTypes{{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".ico", "image/x-icon"},
    {".json", "application/json"},
    {".woff2", "font/woff2"},
    {".txt", "text/plain; charset=utf-8"},
}};

bool isSafe(std::string_view path) {
  return path.starts_with('/') && path.find("/.") == std::string_view::npos &&
         path.find_first_of("\\%:") == std::string_view::npos && path.find('\0') == std::string_view::npos;
}

}  // namespace

std::optional<StaticFile> readStaticFile(const std::string& folder, std::string_view target) {
  std::string_view path = target.substr(0, target.find_first_of("?#"));
  if (path == "/") path = "/index.html";
  if (!isSafe(path)) return {};
  for (const auto& [ending, mime] : kMimeTypes) {
    if (!path.ends_with(ending)) continue;
    std::ifstream file(folder + std::string(path), std::ios::binary);
    if (!file) return {};
    std::ostringstream content;
    content << file.rdbuf();
    return StaticFile{content.str(), std::string(mime)};
  }
  return {};
}

std::string missingPageNotice() {
  return "<!doctype html><meta charset=utf-8><title>HL</title><body style='font-family:sans-serif;margin:3em'>"
         "<h1>HL is running, but its page has not been built</h1>"
         "<p>Run <code>scripts/build</code> in HL's folder, or give <code>hl touch --page-dir FOLDER</code>.</p>";
}

}  // namespace hl
