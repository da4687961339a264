#include "io/reading_cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "base/error.h"
#include "base/open_file.h"
#include "io/model_parts.h"
#include "io/sha256.h"

namespace hl {

namespace {

namespace fs = std::filesystem;

// Whatever changes in readings or in the messages that hold them changes this, so that older entries do not count.
constexpr const char* kEntryFormat = "hl reading 2 ";

std::uint64_t sizeOf(int descriptor) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) ? static_cast<std::uint64_t>(status.st_size) : 0;
}

bool readAt(int descriptor, std::uint64_t place, void* data, std::size_t bytes) {
  char* at = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t got = pread(descriptor, at, bytes, static_cast<off_t>(place));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    place += static_cast<std::uint64_t>(got);
    bytes -= static_cast<std::size_t>(got);
  }
  return true;
}

// Of the first `bytes` of the file, after `before`.
std::optional<Digest256> digestOf(int descriptor, std::uint64_t bytes, const std::string& before) {
  constexpr std::size_t kPiece = 1 << 20;
  Sha256 sha;
  sha.add(before.data(), before.size());
  std::vector<char> piece(kPiece);
  for (std::uint64_t place = 0; place < bytes;) {
    const auto next = static_cast<std::size_t>(std::min<std::uint64_t>(kPiece, bytes - place));
    if (!readAt(descriptor, place, piece.data(), next)) return {};
    sha.add(piece.data(), next);
    place += next;
  }
  return sha.end();
}

// The messages up to `end`, put together. Throws hl::Error where they make no sense.
std::optional<SceneModel> sceneIn(int descriptor, std::uint64_t end, const IsolationLimits& limits) {
  PartCollector collector(limits.memory_bytes, limits.samples_bytes);
  std::string bytes;
  proto::ReadingPart part;
  std::uint32_t length = 0;
  for (std::uint64_t place = 0; place + sizeof length <= end; place += length) {
    if (!readAt(descriptor, place, &length, sizeof length)) return {};
    place += sizeof length;
    if (length > kMaxPartBytes || length > end - place) return {};
    bytes.resize(length);
    if (!readAt(descriptor, place, bytes.data(), length) || !part.ParseFromString(bytes)) return {};
    const PartCollector::State state = collector.add(part, length, {});
    if (state == PartCollector::State::kWhole) return collector.take();
    if (state == PartCollector::State::kFailed) return {};
  }
  return {};
}

bool writeEntry(int descriptor, const std::string& key, const SceneModel& scene) {
  PartSender(descriptor).scene(scene);
  const std::optional<Digest256> digest = digestOf(descriptor, sizeOf(descriptor), key);
  return digest && write(descriptor, digest->data(), digest->size()) == static_cast<ssize_t>(digest->size());
}

}  // namespace

std::string cacheFolder() {
  const auto variable = [](const char* name) {
    const char* const value = std::getenv(name);
    return std::string(value != nullptr ? value : "");
  };
  if (const std::string folder = variable("XDG_CACHE_HOME"); folder.starts_with('/')) return folder + "/hl";
  if (const std::string home = variable("HOME"); home.starts_with('/')) return home + "/.cache/hl";
  return {};
}

std::string ReadingCache::keyOf(int descriptor, const std::string& options) const {
  if (folder_.empty()) return {};
  const std::optional<Digest256> digest = digestOf(descriptor, sizeOf(descriptor), kEntryFormat + options + "\n");
  return digest ? hexOf(*digest) : std::string();
}

std::optional<SceneModel> ReadingCache::find(const std::string& key, const IsolationLimits& limits) const {
  if (folder_.empty() || key.empty()) return {};
  const OpenFile file(open(pathOf(key).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  const std::uint64_t size = sizeOf(file.descriptor());
  Digest256 there{};
  if (file.descriptor() < 0 || size <= there.size()) return {};
  const std::uint64_t end = size - there.size();
  if (!readAt(file.descriptor(), end, there.data(), there.size())) return {};
  if (digestOf(file.descriptor(), end, key) != there) return {};
  futimens(file.descriptor(), nullptr);  // it is the newest now
  try {
    return sceneIn(file.descriptor(), end, limits);
  } catch (const Error&) {
    return {};
  }
}

void ReadingCache::keep(const std::string& key, const SceneModel& scene) const {
  if (folder_.empty() || key.empty()) return;
  std::error_code failed;
  fs::create_directories(folder_, failed);
  std::string beside = pathOf(key) + ".XXXXXX";
  const OpenFile file(mkostemp(beside.data(), O_CLOEXEC));
  if (file.descriptor() < 0) return;
  bool whole = false;
  try {
    whole = writeEntry(file.descriptor(), key, scene);
  } catch (const Error&) {  // the disk is full
  }
  if (!whole || rename(beside.c_str(), pathOf(key).c_str()) != 0) unlink(beside.c_str());
  makeRoom();
}

// Entries that were used longest ago go first.
void ReadingCache::makeRoom() const {
  struct Entry {
    fs::path path;
    fs::file_time_type used;
    std::uint64_t bytes;
  };
  std::vector<Entry> entries;
  std::uint64_t sum = 0;
  std::error_code failed;
  for (fs::directory_iterator at(folder_, failed), end; !failed && at != end; at.increment(failed)) {
    if (at->path().string().find(".reading") == std::string::npos) continue;
    std::error_code gone;
    const Entry entry{at->path(), at->last_write_time(gone), at->file_size(gone)};
    if (gone) continue;
    sum += entry.bytes;
    entries.push_back(entry);
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (std::size_t i = 0; i < entries.size() && sum > most_bytes_; ++i) {
    sum -= entries[i].bytes;
    fs::remove(entries[i].path, failed);
  }
}

}  // namespace hl
