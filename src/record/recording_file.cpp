#include "record/recording_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>
#include <utility>

#include "base/descriptor_bytes.h"
#include "base/error.h"
#include "base/plain_file.h"

namespace hl {

namespace {

static_assert(std::endian::native == std::endian::little, "the head of a block is written as it lies in memory");

// The number is that of the form: it rises when fields of the recorded structures change their order or meaning. When
// one comes or goes the lists no longer fit, and that is reported too.
constexpr std::string_view kMagic = "HLREC2\r\n";
constexpr std::size_t kFormAt = 5;  // of the magic number: the digit of the form
// A block may be a mesh of tens of millions of triangles; protobuf's own limit.
constexpr std::uint64_t kMaxBlockBytes = 0x7fffffff;
// Deflate packs no better than this; more is a damaged head, not worth its memory.
constexpr std::uint64_t kMaxPacking = 1100;
// Blocks come ten times a second while forces are made: the time counts, not the last tenth of the size.
constexpr int kLevel = 1;

struct Head {
  std::uint32_t packed_bytes = 0, raw_bytes = 0, crc = 0;
};
static_assert(sizeof(Head) == 12);

std::uint32_t checksum(const std::string& bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string packed(const std::string& raw) {
  uLongf size = compressBound(raw.size());
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(raw.data()), raw.size(),
                kLevel) != Z_OK)
    throw std::bad_alloc();
  out.resize(size);
  return out;
}

bool unpack(const std::string& in, std::uint32_t raw_bytes, std::string& raw) {
  raw.resize(raw_bytes);
  uLongf size = raw_bytes;
  return uncompress(reinterpret_cast<Bytef*>(raw.data()), &size, reinterpret_cast<const Bytef*>(in.data()),
                    in.size()) == Z_OK &&
         size == raw_bytes;
}

FilePointer madeFile(const std::string& path) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) throw Error(path + ": can not be written: " + std::strerror(errno));
  return std::make_shared<const OpenFile>(descriptor);
}

// Throws hl::Error for a file of another form, or of another kind.
void checkMagic(std::string_view begin, const std::string& path) {
  if (begin == kMagic) return;
  const char form = begin.size() == kMagic.size() ? begin[kFormAt] : ' ';
  std::string as_here(begin);
  if (form >= '1' && form <= '9') as_here[kFormAt] = kMagic[kFormAt];
  if (as_here != kMagic) throw Error(path + ": this is no recording of hl record");
  throw Error(
      fmt::format("{}: is a recording of form {}, and this version of HL reads form {}: use the one that made it", path,
                  form, kMagic[kFormAt]));
}

}  // namespace

RecordingWriter::RecordingWriter(const std::string& path) : RecordingWriter(madeFile(path), path) {}

RecordingWriter::RecordingWriter(FilePointer file, std::string name) : path_(std::move(name)), file_(std::move(file)) {
  append(std::string(kMagic));
}

void RecordingWriter::append(const std::string& bytes) {
  if (!writeWhole(file_->descriptor(), bytes.data(), bytes.size()))
    throw Error(path_ + ": can not be written any more: " + std::strerror(errno));
  bytes_ += bytes.size();
}

void RecordingWriter::write(const proto::RecordingBlock& block) {
  const std::string raw = block.SerializeAsString();
  if (raw.empty() || raw.size() > kMaxBlockBytes) throw Error(path_ + ": a block of the recording is too large");
  const std::string body = packed(raw);
  const Head head{static_cast<std::uint32_t>(body.size()), static_cast<std::uint32_t>(raw.size()), checksum(body)};
  std::string bytes(sizeof head, '\0');
  std::memcpy(bytes.data(), &head, sizeof head);
  append(bytes + body);
}

RecordingReader::RecordingReader(const std::string& path) : path_(path), in_(path, std::ios::binary) {
  checkPlainFile(path);
  std::error_code error;
  left_ = std::filesystem::file_size(path, error);
  if (!in_ || error) throw Error(path + ": can not be read");
  std::array<char, kMagic.size()> magic{};
  in_.read(magic.data(), magic.size());
  checkMagic({magic.data(), static_cast<std::size_t>(in_.gcount())}, path);
  left_ -= magic.size();
}

bool RecordingReader::readBlock(std::string& body, std::uint32_t& raw_bytes) {
  Head head;
  if (left_ < sizeof head) return false;
  in_.read(reinterpret_cast<char*>(&head), sizeof head);
  if (!in_ || head.packed_bytes > left_ - sizeof head || head.raw_bytes > kMaxBlockBytes ||
      head.raw_bytes > kMaxPacking * head.packed_bytes)
    return false;
  body.resize(head.packed_bytes);
  in_.read(body.data(), head.packed_bytes);
  raw_bytes = head.raw_bytes;
  return in_ && checksum(body) == head.crc;
}

bool RecordingReader::next(proto::RecordingBlock& block) {
  if (left_ == 0 || !damage_.empty()) return false;
  std::string body, raw;
  std::uint32_t raw_bytes = 0;
  if (!readBlock(body, raw_bytes) || !unpack(body, raw_bytes, raw) || !block.ParseFromString(raw)) {
    damage_ = fmt::format("its last {} bytes are cut short or damaged", left_);
    return false;
  }
  left_ -= sizeof(Head) + body.size();
  return true;
}

proto::RecordingStart startOf(RecordingReader& reader) {
  proto::RecordingBlock block;
  if (!reader.next(block) || !block.has_start()) throw Error(reader.path() + ": nothing of the recording can be read");
  return block.start();
}

}  // namespace hl
