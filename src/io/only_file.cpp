#include "io/only_file.h"

#include <assimp/MemoryIOWrapper.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>

namespace hl {

namespace {

constexpr std::size_t kMaxMissing = 8;  // names to report

// Each has its own place in the file.
class FileStream final : public Assimp::IOStream {
 public:
  explicit FileStream(int descriptor) : descriptor_(descriptor) {}

  std::size_t Read(void* data, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t wanted = std::min(count, (FileSize() - std::min(at_, FileSize())) / size) * size;
    std::size_t got = 0;
    while (got < wanted) {
      const ssize_t more =
          pread(descriptor_, static_cast<char*>(data) + got, wanted - got, static_cast<off_t>(at_ + got));
      if (more < 0 && errno == EINTR) continue;
      if (more <= 0) break;
      got += static_cast<std::size_t>(more);
    }
    at_ += got;
    return got / size;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : FileSize();
    // Offsets backwards come as numbers that wrap around.
    const std::size_t to = base + offset;
    if (to > FileSize()) return aiReturn_FAILURE;
    at_ = to;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override {
    struct stat status {};
    return fstat(descriptor_, &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
  }
  void Flush() override {}

 private:
  const int descriptor_;
  std::size_t at_ = 0;
};

}  // namespace

bool OnlyFile::isIt(const std::string& file) const { return file == name_ || file == "./" + name_; }

bool OnlyFile::Exists(const char* file) const {
  if (isIt(file)) return true;
  std::string last(file);
  last.erase(0, last.find_last_of("/\\") + 1);
  std::replace_if(
      last.begin(), last.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  constexpr std::size_t kLongest = 60;
  if (!last.empty() && !last.starts_with(kStem) && missing_.size() < kMaxMissing)
    missing_.insert(last.substr(0, kLongest));
  return false;
}

Assimp::IOStream* OnlyFile::Open(const char* file, const char* mode) {
  const bool to_read = std::string(mode).find_first_of("wa+") == std::string::npos;
  if (!Exists(file) || !to_read) return nullptr;
  if (text_) return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(text_->data()), text_->size());
  return new FileStream(descriptor_);
}

}  // namespace hl
