#include "fleet/fleet_store.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/descriptor_bytes.h"
#include "base/error.h"
#include "base/plain_file.h"
#include "fleet/beside.h"

namespace hl {

namespace {

namespace fs = std::filesystem;

constexpr const char* kResultEnding = ".result";
constexpr const char* kFailureEnding = ".failed";

// Whatever else has that name is no result.
std::optional<std::string> bytesAt(const std::string& path) {
  std::error_code failed;
  return fs::is_regular_file(path, failed) ? contentOf(path) : std::optional<std::string>();
}

Digest256 digestOfResult(std::string_view bytes) {
  Sha256 sha;
  sha.add(bytes);
  return sha.end();
}

}  // namespace

// Some thousand files a folder, as long as there are less than a million.
std::string FleetStore::pathOf(const std::string& name, const char* ending) const {
  return folder_ + "/" + name.substr(0, 2) + "/" + name + ending;
}

std::optional<StoredResult> FleetStore::find(const std::string& name) const {
  const std::optional<std::string> all = bytesAt(pathOf(name, kResultEnding));
  Digest256 said{};
  if (!all || all->size() < said.size()) return {};
  const std::string_view bytes(all->data(), all->size() - said.size());
  std::memcpy(said.data(), all->data() + bytes.size(), said.size());
  const Digest256 digest = digestOfResult(bytes);
  if (said != digest) return {};
  std::optional<FleetResult> result = fleetResultOf(bytes);
  if (!result || result->name != name) return {};
  return StoredResult{std::move(*result), hexOf(digest)};
}

void FleetStore::write(const std::string& path, const std::string& bytes) const {
  constexpr mode_t kForAll = 0666;  // less the umask
  std::error_code failed;
  const fs::path folder = fs::path(path).parent_path();
  fs::create_directories(folder, failed);
  if (failed) throw Error(folder.string() + ": cannot be made: " + failed.message());
  const std::string beside = nameBeside(path);
  const int file = open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kForAll);
  const bool whole = file >= 0 && writeWhole(file, bytes.data(), bytes.size());
  const int error = errno;
  if (file >= 0) close(file);
  if (whole) return putInPlace(beside, path);
  if (file >= 0) unlink(beside.c_str());
  throw Error(path + ": cannot be written: " + std::strerror(error));
}

void FleetStore::keep(const FleetResult& result) const {
  std::string bytes = bytesOf(result);
  const Digest256 digest = digestOfResult(bytes);
  bytes.append(reinterpret_cast<const char*>(digest.data()), digest.size());
  try {
    write(pathOf(result.name, kResultEnding), bytes);
  } catch (const Error&) {
    if (!find(result.name)) throw;  // another has kept it meanwhile, and removed what it took for remains
  }
  unlink(pathOf(result.name, kFailureEnding).c_str());
}

void FleetStore::keepFailure(const std::string& name, const std::string& why) const {
  write(pathOf(name, kFailureEnding), why);
}

std::optional<std::string> FleetStore::failureOf(const std::string& name) const {
  return bytesAt(pathOf(name, kFailureEnding));
}

void FleetStore::removeRemains() const {
  std::error_code failed;
  for (fs::recursive_directory_iterator at(folder_, failed), end; !failed && at != end; at.increment(failed)) {
    std::error_code gone;
    if (isLeftBeside(at->path().string())) fs::remove(at->path(), gone);
  }
}

}  // namespace hl
