// OutputFile: a text file that is written whole, or an error says why not.
#pragma once

#include <fmt/core.h>

#include <cstdio>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hl {

/// Throws hl::Error when `path` is one of the files that are read. Names that are no files, as those of built-in
/// scenes, are none of them.
void requireNotRead(const std::string& path, const std::vector<std::string>& read);

class OutputFile {
 public:
  /// Begins an empty file, unless it is one of those that are read. Throws hl::Error, as all that follows.
  explicit OutputFile(std::string path, std::initializer_list<std::string> read = {});
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  template <typename... Args>
  void print(fmt::format_string<Args...> format, Args&&... args) {
    write(fmt::format(format, std::forward<Args>(args)...));
  }
  /// What is written so far is there whatever comes.
  void flush();
  /// Everything is written. Without this call it is not reported when the end cannot be.
  void close();

 private:
  [[noreturn]] void fail() const;

  const std::string path_;
  std::FILE* file_;
};

}  // namespace hl
