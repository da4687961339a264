#include "client/inproc_link.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

#include "base/error.h"
#include "session/touch_server.h"

namespace hl::client {

namespace {

// The process's server: it is started for the first link and stopped after the last. `sim`: the model of its device,
// where the client wants a certain one.
std::shared_ptr<SessionHost> processServer(const std::string& sim) {
  static std::mutex mutex;
  static std::weak_ptr<TouchServer> running;
  static std::string device;  // of the running one
  static pid_t process = 0;   // that has its threads
  const std::lock_guard lock(mutex);
  const std::string wanted = sim.empty() ? "sim" : "sim:" + sim;
  std::shared_ptr<TouchServer> server = running.lock();
  if (server && process != getpid())
    throw Error(
        "the server of this process is in the one that it was forked from: start a program of its own, by exec,"
        " to use inproc: there");
  if (server && !sim.empty() && device != wanted)
    throw Error("the server of this process has the device " + device + " already, and " + wanted + " is wanted");
  if (server) return server;
  TouchServerSettings settings;
  settings.devices = {{"", wanted}};
  settings.touch.explore = false;
  settings.version = HL_VERSION;
  server = std::make_shared<TouchServer>(makeSnapshot(std::vector<Instance>{}, "inproc"), settings);
  server->start();
  running = server;
  process = getpid();
  device = wanted;
  return server;
}

// What the server's threads call when there is a reply.
struct Bell {
  std::mutex mutex;
  std::condition_variable rung_or_late;
  bool rung = false;

  void ring() {
    {
      const std::lock_guard lock(mutex);
      rung = true;
    }
    rung_or_late.notify_one();
  }
  void waitFor(std::chrono::duration<double> longest) {
    std::unique_lock lock(mutex);
    rung_or_late.wait_for(lock, longest, [this] { return rung; });
    rung = false;
  }
};

class InprocLink final : public Link {
 public:
  explicit InprocLink(std::shared_ptr<SessionHost> host)
      : host_(std::move(host)),
        bell_(std::make_shared<Bell>()),
        session_(host_->connect([bell = bell_] { bell->ring(); })) {}

  void send(proto::ClientMessage message) override { session_->receive(std::move(message)); }
  std::size_t queuedBytes() const override { return 0; }

  bool take(proto::ServerReply& reply) override {
    if (next_) {
      reply = std::move(*next_);
      next_.reset();
      return true;
    }
    return session_->take(reply);
  }

  bool wait(std::chrono::nanoseconds longest) override {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + longest;
    while (!arrived() && session_->end().empty()) {
      const std::chrono::duration<double> left = end - Clock::now();
      if (left.count() <= 0) return false;
      bell_->waitFor(std::min(left, std::chrono::duration<double>(std::min(session_->nextState_s(), kLongestNap_s))));
    }
    return next_.has_value();
  }

  std::string ended() const override { return session_->end(); }

 private:
  static constexpr double kLongestNap_s = 1;

  bool arrived() {
    if (next_) return true;
    proto::ServerReply reply;
    if (session_->take(reply)) next_ = std::move(reply);
    return next_.has_value();
  }

  // In this order: the session goes before the server.
  std::shared_ptr<SessionHost> host_;
  std::shared_ptr<Bell> bell_;
  std::unique_ptr<ClientSession> session_;
  std::optional<proto::ServerReply> next_;
};

}  // namespace

std::unique_ptr<Link> openInproc(const ServerUrl& url) {
  if (!url.host.empty()) throw Error("inproc: is this process; it takes no host (got '" + url.host + "')");
  return linkTo(processServer(url.sim));
}

std::unique_ptr<Link> linkTo(std::shared_ptr<SessionHost> host) {
  return std::make_unique<InprocLink>(std::move(host));
}

}  // namespace hl::client
