// The child sends records through a pipe: a tag, a length, the bytes.
//   'p' double        progress                'e' text    error               'm' arrays  the model, the last record
#include "io/isolated.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <vector>

#include "base/error.h"

namespace hl {

namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{16} << 30;

bool sendAll(int fd, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = ::write(fd, at, size);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool receiveAll(int fd, void* data, std::size_t size) {
  char* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = ::read(fd, at, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

// The other end is the same program: the bytes of a value are the message.
template <typename T>
bool sendList(int fd, const std::vector<T>& list) {
  const std::uint64_t count = list.size();
  return sendAll(fd, &count, sizeof count) && sendAll(fd, list.data(), count * sizeof(T));
}

template <typename T>
bool receiveList(int fd, std::vector<T>& list) {
  std::uint64_t count = 0;
  if (!receiveAll(fd, &count, sizeof count) || count > kMostBytes / sizeof(T)) return false;
  list.resize(count);
  return receiveAll(fd, list.data(), count * sizeof(T));
}

std::vector<char> joined(const std::vector<std::string>& lines) {
  std::vector<char> text;
  for (const std::string& line : lines) {
    text.insert(text.end(), line.begin(), line.end());
    text.push_back('\n');
  }
  return text;
}

bool sendTextures(int fd, const std::vector<Texture>& textures) {
  const std::uint64_t count = textures.size();
  bool sent = sendAll(fd, &count, sizeof count);
  for (const Texture& texture : textures) {
    const std::array<std::uint64_t, 2> size{texture.width, texture.height};
    sent = sent && sendAll(fd, size.data(), sizeof size) && sendList(fd, texture.texels);
  }
  return sent;
}

bool receiveTextures(int fd, std::vector<Texture>& textures) {
  constexpr std::uint64_t kMost = 10'000;
  std::uint64_t count = 0;
  if (!receiveAll(fd, &count, sizeof count) || count > kMost) return false;
  for (std::uint64_t i = 0; i < count; ++i) {
    std::array<std::uint64_t, 2> size{};
    Texture texture;
    if (!receiveAll(fd, size.data(), sizeof size) || !receiveList(fd, texture.texels)) return false;
    texture.width = size[0];
    texture.height = size[1];
    if (texture.width == 0 || texture.texels.size() / texture.width != texture.height) return false;
    textures.push_back(std::move(texture));
  }
  return true;
}

void sendModel(int fd, const Model& model) {
  const char tag = 'm';
  (void)(sendAll(fd, &tag, 1) && sendList(fd, model.positions) && sendList(fd, model.normals) &&
         sendList(fd, model.texcoords) && sendList(fd, model.triangles) && sendList(fd, model.segments) &&
         sendList(fd, model.points) && sendTextures(fd, model.textures) && sendList(fd, model.materials) &&
         sendList(fd, model.triangle_materials) && sendList(fd, model.segment_materials) &&
         sendList(fd, model.point_materials) && sendList(fd, joined(model.warnings)));
}

bool receiveModel(int fd, Model& model) {
  std::vector<char> warnings;
  const bool whole = receiveList(fd, model.positions) && receiveList(fd, model.normals) &&
                     receiveList(fd, model.texcoords) && receiveList(fd, model.triangles) &&
                     receiveList(fd, model.segments) && receiveList(fd, model.points) &&
                     receiveTextures(fd, model.textures) && receiveList(fd, model.materials) &&
                     receiveList(fd, model.triangle_materials) && receiveList(fd, model.segment_materials) &&
                     receiveList(fd, model.point_materials) && receiveList(fd, warnings);
  std::string line;
  for (const char c : warnings) {
    if (c == '\n') {
      model.warnings.push_back(line);
      line.clear();
    } else {
      line += c;
    }
  }
  return whole;
}

void setLimits(const IsolationLimits& limits) {
  const rlimit cpu{limits.cpu_s, limits.cpu_s + 2};
  setrlimit(RLIMIT_CPU, &cpu);
  const rlimit core{0, 0};
  setrlimit(RLIMIT_CORE, &core);
#ifndef HL_SANITIZED  // sanitizers reserve terabytes of addresses
  const rlimit memory{limits.memory_bytes, limits.memory_bytes};
  setrlimit(RLIMIT_AS, &memory);
#endif
}

[[noreturn]] void runChild(int fd, const IsolationLimits& limits,
                           const std::function<Model(const std::function<void(double)>&)>& parse) {
  for (const int handled : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGINT, SIGTERM}) signal(handled, SIG_DFL);
  setLimits(limits);
  const int quiet = open("/dev/null", O_WRONLY);  // parsers chat
  dup2(quiet, STDERR_FILENO);
  dup2(quiet, STDOUT_FILENO);
  const auto report = [fd](double fraction) {
    const char tag = 'p';
    if (!sendAll(fd, &tag, 1) || !sendAll(fd, &fraction, sizeof fraction)) _exit(1);
  };
  std::string failure;
  try {
    sendModel(fd, parse(report));
    _exit(0);
  } catch (const std::bad_alloc&) {
    failure = "needs more memory than it may have";
  } catch (const std::exception& error) {
    failure = error.what();
  }
  const char tag = 'e';
  const std::vector<char> text(failure.begin(), failure.end());
  (void)(sendAll(fd, &tag, 1) && sendList(fd, text));
  _exit(0);
}

// Reads records until the model, an error, or the end of the pipe.
bool receiveResult(int fd, Model& model, std::string& failure, const std::function<void(double)>& progress) {
  char tag = 0;
  while (receiveAll(fd, &tag, 1)) {
    if (tag == 'm') return receiveModel(fd, model);
    if (tag == 'e') {
      std::vector<char> text;
      if (receiveList(fd, text)) failure.assign(text.begin(), text.end());
      return false;
    }
    double fraction = 0;
    if (tag != 'p' || !receiveAll(fd, &fraction, sizeof fraction)) return false;
    if (progress) progress(fraction);
  }
  return false;
}

std::string causeOf(int status) {
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) {
    return "reading it takes too long: the file is corrupt, or too large";
  }
  if (WIFSIGNALED(status)) return "its reader crashed: the file is corrupt";
  return "its reader stopped: the file is corrupt";
}

// The first line only: errors are one line.
std::string firstLine(const std::string& text) { return text.substr(0, text.find_first_of("\r\n")); }

}  // namespace

Model runIsolated(const std::string& name, const IsolationLimits& limits,
                  const std::function<Model(const std::function<void(double)>&)>& parse,
                  const std::function<void(double)>& progress) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw Error(name + ": no pipe: " + std::strerror(errno));
  const pid_t child = fork();
  if (child < 0) {
    close(ends[0]);
    close(ends[1]);
    throw Error(name + ": no process to read it in: " + std::strerror(errno));
  }
  if (child == 0) {
    close(ends[0]);
    runChild(ends[1], limits, parse);
  }
  close(ends[1]);
  Model model;
  std::string failure;
  const bool whole = receiveResult(ends[0], model, failure, progress);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!whole) throw Error(name + ": " + (failure.empty() ? causeOf(status) : firstLine(failure)));
  return model;
}

}  // namespace hl
