#include "io/npz_file.h"

#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "base/utf8.h"

namespace hl {

namespace {

constexpr std::uint32_t kLocalMark = 0x04034b50, kCentralMark = 0x02014b50, kEndMark = 0x06054b50;
constexpr std::uint32_t kEnd64Mark = 0x06064b50, kLocator64Mark = 0x07064b50;
constexpr std::uint16_t kVersion64 = 45;  // of ZIP64, APPNOTE 4.4.3
constexpr std::uint16_t kNamesAreUtf8 = 1U << 11U;
constexpr std::uint16_t kFirstDay = 1U << 5U | 1U;  // 1980-01-01, so that equal content is equal bytes
constexpr std::uint32_t kSee64 = 0xffffffff;        // the number is in the ZIP64 field
constexpr std::uint16_t kMany = 0xffff;
constexpr std::uint16_t kField64 = 1;

template <typename Number>
void appendNumber(std::string& bytes, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i)
    bytes += static_cast<char>(static_cast<std::uint64_t>(number) >> (8 * i) & 0xffU);
}

std::string arrayHeader(const std::string& type, const std::vector<std::size_t>& shape) {
  constexpr std::size_t kAligned = 64, kBefore = 10;  // magic, version and length
  std::string sizes;
  for (const std::size_t size : shape) sizes += fmt::format("{},", size);
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, sizes);
  text.append(kAligned - (kBefore + text.size() + 1) % kAligned, ' ');
  text += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  appendNumber(header, static_cast<std::uint16_t>(text.size()));
  return header + text;
}

}  // namespace

NpzFile::NpzFile(std::string path) : path_(std::move(path)), file_(std::fopen(path_.c_str(), "wbe")) {
  if (file_ == nullptr) fail();
}

NpzFile::~NpzFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void NpzFile::fail() const { throw Error(path_ + ": cannot be written: " + std::strerror(errno)); }

void NpzFile::put(const void* data, std::size_t bytes) {
  if (std::fwrite(data, 1, bytes, file_) != bytes) fail();
  place_ += bytes;
}

// All sizes are in the ZIP64 field, whatever they are: one form for all.
std::string NpzFile::headerOf(const Entry& entry, bool central) const {
  std::string bytes;
  appendNumber(bytes, central ? kCentralMark : kLocalMark);
  if (central) appendNumber(bytes, kVersion64);  // made by
  appendNumber(bytes, kVersion64);
  appendNumber(bytes, kNamesAreUtf8);
  appendNumber(bytes, std::uint16_t{0});  // stored
  appendNumber(bytes, std::uint16_t{0});  // midnight
  appendNumber(bytes, kFirstDay);
  appendNumber(bytes, entry.crc);
  appendNumber(bytes, kSee64);
  appendNumber(bytes, kSee64);
  appendNumber(bytes, static_cast<std::uint16_t>(entry.name.size()));
  const std::uint16_t numbers = central ? 24 : 16;  // bytes: two sizes, and the place
  appendNumber(bytes, static_cast<std::uint16_t>(numbers + 4));
  if (central) {
    bytes.append(10, '\0');  // no comment, first disk, attributes
    appendNumber(bytes, kSee64);
  }
  bytes += entry.name;
  appendNumber(bytes, kField64);
  appendNumber(bytes, numbers);
  appendNumber(bytes, entry.bytes);
  appendNumber(bytes, entry.bytes);
  if (central) appendNumber(bytes, entry.place);
  return bytes;
}

void NpzFile::begin(const std::string& name, const std::string& type, const std::vector<std::size_t>& shape) {
  endEntry();
  entries_.push_back({name + ".npy", place_, 0, 0});
  const std::string header = headerOf(entries_.back(), false);
  put(header.data(), header.size());
  open_ = true;
  const std::string array = arrayHeader(type, shape);
  write(array.data(), array.size());
}

void NpzFile::write(const void* data, std::size_t bytes) {
  if (bytes == 0) return;  // no data has no address, which zlib takes for a new beginning
  Entry& entry = entries_.back();
  entry.crc = static_cast<std::uint32_t>(crc32_z(entry.crc, static_cast<const Bytef*>(data), bytes));
  entry.bytes += bytes;
  put(data, bytes);
}

// Its header again, with what is known now.
void NpzFile::endEntry() {
  if (!std::exchange(open_, false)) return;
  const std::string header = headerOf(entries_.back(), false);
  if (std::fseek(file_, static_cast<long>(entries_.back().place), SEEK_SET) != 0) fail();
  if (std::fwrite(header.data(), 1, header.size(), file_) != header.size()) fail();
  if (std::fseek(file_, 0, SEEK_END) != 0) fail();
}

void NpzFile::add(const std::string& name, const std::vector<double>& numbers) {
  begin(name, "<f8", {numbers.size()});
  write(numbers.data(), numbers.size() * sizeof(double));
}

void NpzFile::add(const std::string& name, const std::vector<std::int64_t>& numbers) {
  begin(name, "<i8", {numbers.size()});
  write(numbers.data(), numbers.size() * sizeof(std::int64_t));
}

void NpzFile::add(const std::string& name, const std::vector<std::string>& texts) {
  std::vector<std::vector<std::uint32_t>> points;
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, points.emplace_back(codePointsOf(text)).size());
  begin(name, fmt::format("<U{}", longest), {texts.size()});
  for (std::vector<std::uint32_t>& text : points) {
    text.resize(longest);
    write(text.data(), longest * sizeof(std::uint32_t));
  }
}

void NpzFile::close() {
  endEntry();
  const std::uint64_t central = place_;
  for (const Entry& entry : entries_) {
    const std::string header = headerOf(entry, true);
    put(header.data(), header.size());
  }
  const std::uint64_t end = place_;
  std::string bytes;
  appendNumber(bytes, kEnd64Mark);
  appendNumber(bytes, std::uint64_t{44});  // bytes of the rest of this record
  appendNumber(bytes, kVersion64);
  appendNumber(bytes, kVersion64);
  appendNumber(bytes, std::uint64_t{0});  // disks
  appendNumber(bytes, std::uint64_t{entries_.size()});
  appendNumber(bytes, std::uint64_t{entries_.size()});
  appendNumber(bytes, end - central);
  appendNumber(bytes, central);
  appendNumber(bytes, kLocator64Mark);
  appendNumber(bytes, std::uint32_t{0});
  appendNumber(bytes, end);
  appendNumber(bytes, std::uint32_t{1});
  appendNumber(bytes, kEndMark);
  appendNumber(bytes, std::uint32_t{0});  // disks
  appendNumber(bytes, kMany);
  appendNumber(bytes, kMany);
  appendNumber(bytes, kSee64);
  appendNumber(bytes, kSee64);
  appendNumber(bytes, std::uint16_t{0});  // no comment
  put(bytes.data(), bytes.size());
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail();
}

}  // namespace hl
