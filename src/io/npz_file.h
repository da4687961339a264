// NpzFile: arrays under names in one file, as numpy.load reads it: a ZIP file of NPY arrays, stored as they are, so
// that what is written can be of any length. Formats: numpy.lib.format version 1.0; PKWARE's APPNOTE 6.3.3 with ZIP64.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace hl {

/// Every call throws hl::Error where the file cannot be written.
class NpzFile {
 public:
  explicit NpzFile(std::string path);
  ~NpzFile();
  NpzFile(const NpzFile&) = delete;
  NpzFile& operator=(const NpzFile&) = delete;

  /// Begins the next array. `type`: as numpy has it, "<f8", "<i8" or "<U12"; its elements then come by write().
  void begin(const std::string& name, const std::string& type, const std::vector<std::size_t>& shape);
  void write(const void* data, std::size_t bytes);

  /// Whole arrays of one dimension. Texts may be UTF-8.
  void add(const std::string& name, const std::vector<double>& numbers);
  void add(const std::string& name, const std::vector<std::int64_t>& numbers);
  void add(const std::string& name, const std::vector<std::string>& texts);

  /// Ends the file: without this call it is none.
  void close();

 private:
  struct Entry {
    std::string name;
    std::uint64_t place = 0, bytes = 0;  // place: of its local header
    std::uint32_t crc = 0;
  };

  void put(const void* data, std::size_t bytes);
  void endEntry();
  std::string headerOf(const Entry& entry, bool central) const;
  [[noreturn]] void fail() const;

  const std::string path_;
  std::FILE* file_;
  std::uint64_t place_ = 0;
  std::vector<Entry> entries_;
  bool open_ = false;  // the last entry still grows
};

}  // namespace hl
