// A failed allocation in any thread of a running server costs one piece of work: clients and pages are served on, the
// servo makes its steps, and whoever watches is notified.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "base/guarded_thread.h"
#include "guard/failing_allocation.h"
#include "http/http_server.h"
#include "monitor/touch_monitor.h"
#include "page/viewer_feed.h"
#include "plain_client.h"
#include "record/recorder.h"
#include "record/recording_file.h"
#include "record/replay.h"
#include "session/touch_server.h"
#include "temp_folder.h"
#include "wait_for.h"

namespace hl::test_failing_threads {
namespace {

using test::PlainClient;

TouchServerSettings serverSettings(const std::string& recording) {
  TouchServerSettings settings;
  settings.touch.world_per_device = 1;
  RecorderSettings recorder;
  recorder.file = recording;
  settings.touch.sink = recorderWith(recorder);
  settings.version = "test";
  return settings;
}

// A floor under the hand, at another height with each frame, so that it is refitted; with so many vertices that nothing
// uses that it is no light work to decode.
proto::ClientMessage floorFrame(std::uint64_t number) {
  proto::ClientMessage message;
  proto::Frame& frame = *message.mutable_frame();
  frame.set_number(number);
  proto::ObjectDefinition& object = *frame.add_objects();
  object.set_id(4);
  const double y = 0.001 * static_cast<double>(number % 4);
  proto::Primitives& floor = *object.add_items()->mutable_primitives();
  for (const double v : {-1.0, y, 1.0, 1.0, y, 1.0, 1.0, y, -1.0, -1.0, y, -1.0}) floor.add_vertices(v);
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) floor.add_triangles(i);
  constexpr int kUnused = 3'000;
  for (int i = 0; i < kUnused; ++i) floor.add_vertices(0);
  frame.mutable_world()->add_items()->set_call(4);
  return message;
}

// A client that comes again when its connection was what the failure cost.
class Client {
 public:
  explicit Client(std::uint16_t port) : port_(port) {}

  // A frame with its answer, and a state. False: the connection has ended.
  bool work() try {
    if (!client_) connect();
    client_->send(floorFrame(++number_));
    bool answered = false, felt = false;
    while (!answered || !felt) {
      const auto reply = client_->next();
      if (!reply) return leave();
      answered = answered || reply->frame_shown().number() == number_ || reply->refusal().frame() == number_;
      felt = felt || reply->has_state();
    }
    return true;
  } catch (const boost::system::system_error&) {
    return leave();
  }

 private:
  void connect() {
    client_.emplace(port_);
    client_->send(test::openMessage(1000));
    number_ = 0;
  }
  bool leave() {
    client_.reset();
    return false;
  }

  std::uint16_t port_;
  std::optional<PlainClient> client_;
  std::uint64_t number_ = 0;
};

// A page that comes again too.
class Page {
 public:
  explicit Page(std::uint16_t port) : port_(port) {}

  // One message of what it is sent.
  bool work() try {
    if (!page_) page_.emplace(port_, test::Headers{{test::http::field::origin, origin()}}, "/viewer");
    if (page_->nextBytes()) return true;
    page_.reset();
    return false;
  } catch (const boost::system::system_error&) {
    page_.reset();
    return false;
  }

 private:
  std::string origin() const { return "http://127.0.0.1:" + std::to_string(port_); }

  std::uint16_t port_;
  std::optional<PlainClient> page_;
};

class FailingThreads : public testing::TestWithParam<const char*> {
 protected:
  FailingThreads()
      : folder_(),
        recording_((folder_.path() / "session.hlr").string()),
        touch_(makeSnapshot(std::vector<Instance>{}), serverSettings(recording_)),
        server_(httpSettings(), makeViewerFeed(touch_.device(), "test"), &touch_,
                makeTouchMonitor(touch_.device(), &touch_)) {
    touch_.start();
    server_.start();
  }
  ~FailingThreads() override {
    server_.stop();
    touch_.stop();
  }

  static HttpServerSettings httpSettings() {
    HttpServerSettings settings;
    settings.port = 0;
    return settings;
  }

  test::TempFolder folder_;
  std::string recording_;
  TouchServer touch_;
  HttpServer server_;
};

// So many rounds of work at the most until the allocation has failed: a thread need not make so many.
constexpr int kMaxRounds = 40;
constexpr int kAllocations = 60;  // that fail one by one

TEST_P(FailingThreads, CostOnePieceOfWork) {
  Client client(server_.port());
  Page page(server_.port());
  std::uint64_t failed = 0;
  for (int nth = 1; nth <= kAllocations; ++nth) {
    test::waitFor([&] { return client.work() && page.work(); });
    const std::uint64_t steps = touch_.device().servoTotals().steps;
    FailingAllocation::arm(GetParam(), nth);
    for (int round = 0; round < kMaxRounds && !FailingAllocation::hasFailed(); ++round) {
      client.work();
      page.work();
    }
    failed += FailingAllocation::disarm() ? 1 : 0;
    test::waitFor([&] { return client.work(); });
    test::waitFor([&] { return page.work(); });
    test::waitFor([&] { return touch_.device().servoTotals().steps > steps; });
  }
  EXPECT_GT(failed, 0u) << "the thread allocates";
  server_.stop();
  touch_.stop();
  const ReplayReport report = replay(recording_);
  EXPECT_FALSE(report.difference) << "what was recorded all the same is what was felt";
}

INSTANTIATE_TEST_SUITE_P(All, FailingThreads,
                         testing::Values("publisher", "builder", "recorder", "events", "network", "pages", "worker",
                                         "light worker", "page meshes"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::erase(name, ' ');
                           return name;
                         });

// A driver that throws in a call of the servo.
class ThrowingDevice final : public Device {
 public:
  void open() override { own_->open(); }
  void close() override { own_->close(); }
  const DeviceInfo& info() const override { return own_->info(); }
  DeviceSample read(std::int64_t now_ns) override {
    if (throw_in_read) throw std::bad_alloc();
    return own_->read(now_ns);
  }
  void write(const Vec3& force_N) override {
    if (throw_in_write && !force_N.isZero()) throw std::bad_alloc();
    zeros = force_N.isZero() ? zeros + 1 : 0;
    own_->write(force_N);
  }
  std::atomic<bool> throw_in_read{false}, throw_in_write{false};
  std::atomic<int> zeros{0};  // in a row

 private:
  std::unique_ptr<Device> own_ = openDevice("sim");
};

void expectZeroForce(std::atomic<bool> ThrowingDevice::*where) {
  auto owned = std::make_unique<ThrowingDevice>();
  ThrowingDevice& device = *owned;
  TouchSession session(makeSnapshot(std::vector<Instance>{}), {}, std::move(owned));
  session.start();
  ServoView servo;
  ProxyView proxy;
  const auto safetyIs = [&](SafetyState state) {
    return [&, state] {
      session.views(servo, proxy);
      return servo.safety == state;
    };
  };
  test::waitFor(safetyIs(SafetyState::kOn));
  (device.*where) = true;
  if (&(device.*where) == &device.throw_in_read) {
    test::waitFor(safetyIs(SafetyState::kFault));
    EXPECT_EQ(servo.fault, FaultReason::kDeviceLost);
    test::waitFor([&] { return device.zeros.load() > 100; });
  }
  const std::uint64_t steps = session.servoTotals().steps;
  test::waitFor([&] { return session.servoTotals().steps > steps + 100; });
  session.stop();
}

TEST(ThrowingDriver, InReadIsALostDeviceAndZeroForce) { expectZeroForce(&ThrowingDevice::throw_in_read); }
TEST(ThrowingDriver, InWriteTheServoGoesOn) { expectZeroForce(&ThrowingDevice::throw_in_write); }

}  // namespace
}  // namespace hl::test_failing_threads
