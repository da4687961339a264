#include "line/line.h"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <sstream>
#include <thread>

#include "line/line_end.h"

namespace hl::line {

namespace {

constexpr int kRefused = 77;  // hl_line's code for it

// Signals are blocked in some tests; hl_line unblocks none, and ends with its input.
pid_t startLine(std::vector<std::string> words, int socket) {
  const std::string file = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "hl_line";
  words.insert(words.begin(), file);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, socket, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, socket, STDOUT_FILENO);
  pid_t id = 0;
  const int error = posix_spawn(&id, file.c_str(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) throw Error(file + " cannot be started: " + std::strerror(error));
  return id;
}

}  // namespace

Line::Line(int ends, const std::string& order, std::uint64_t seed) {
  std::vector<std::string> words{"--ends", std::to_string(ends), "--seed", std::to_string(seed)};
  std::istringstream text(order);
  for (std::string word; text >> word;) words.push_back(word);
  int sockets[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0)
    throw Error(std::string("no socket to hl_line: ") + std::strerror(errno));
  socket_ = sockets[0];
  id_ = startLine(words, sockets[1]);
  close(sockets[1]);
  for (auto line = readLine(); line != "ready"; line = readLine()) {
    if (!line) {
      int status = 0;
      waitpid(id_, &status, 0);
      close(socket_);
      if (WIFEXITED(status) && WEXITSTATUS(status) == kRefused)
        throw LineRefused("no network namespaces with TUN devices are allowed here: hl_line has said why");
      throw Error("hl_line gives no line: it has said why");
    }
    name_spaces_.push_back(line->substr(line->rfind(' ') + 1));
  }
}

Line::~Line() {
  shutdown(socket_, SHUT_WR);
  while (readLine()) continue;
  waitpid(id_, nullptr, 0);
  close(socket_);
}

std::optional<std::string> Line::readLine() {
  std::size_t end;
  while ((end = read_.find('\n')) == read_.npos) {
    std::array<char, 4096> buffer;
    const ssize_t size = recv(socket_, buffer.data(), buffer.size(), 0);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return std::nullopt;
    read_.append(buffer.data(), static_cast<std::size_t>(size));
  }
  const std::string line = read_.substr(0, end);
  read_.erase(0, end + 1);
  return line;
}

std::string Line::say(const std::string& order) {
  const std::string text = order + '\n';
  send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
  std::string answer;
  for (auto line = readLine(); line != "ok"; line = readLine()) {
    if (!line) throw Error("hl_line has ended");
    if (line->starts_with("error: ")) throw Error(line->substr(7));
    answer += *line + '\n';
  }
  return answer;
}

LinkCounts Line::counts(int from, int to) {
  std::istringstream answer(say("count"));
  const std::string wanted = std::to_string(from) + " -> " + std::to_string(to) + ": taken ";
  for (std::string line; std::getline(answer, line);) {
    if (!line.starts_with(wanted)) continue;
    std::istringstream rest(line.substr(wanted.size()));
    LinkCounts n;
    std::string name;
    rest >> n.taken >> name >> n.given >> name >> n.lost >> name >> n.cut >> name >> n.full >> name >> n.waiting;
    return n;
  }
  throw Error("the line has no direction from " + std::to_string(from) + " to " + std::to_string(to));
}

void Line::inside(int end, const std::function<void()>& act) const {
  std::exception_ptr fault;
  std::thread([&] {
    try {
      const int name_space = open(name_spaces_.at(static_cast<std::size_t>(end - 1)).c_str(), O_RDONLY | O_CLOEXEC);
      if (name_space < 0 || setns(name_space, CLONE_NEWNET) != 0)
        throw Error(std::string("the namespace cannot be entered: ") + std::strerror(errno));
      close(name_space);
      act();
    } catch (...) {
      fault = std::current_exception();
    }
  }).join();
  if (fault) std::rethrow_exception(fault);
}

std::optional<std::string> lineRefusal() {
  try {
    const Line line(2);
    return std::nullopt;
  } catch (const LineRefused& refused) {
    return refused.what();
  }
}

}  // namespace hl::line
