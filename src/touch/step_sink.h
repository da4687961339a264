// StepSink: gets all that the loops do, step by step, such as a recorder. The loops know no more of it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "control/servo_record.h"
#include "touch/proxy_loop.h"

namespace hl {

/// Which of a server's devices it is.
struct DeviceLabel {
  std::string name;          ///< as its user calls it; empty: it has no name, as it is the only one
  std::uint32_t number = 0;  ///< from 0
  std::uint32_t of = 1;      ///< devices
};

/// What is the same in all steps of a session.
struct SessionInfo {
  DeviceInfo device;
  double servo_rate_Hz = 1000, proxy_rate_Hz = 1000;
  ProxySettings proxy;
  DeviceLabel label{};
};

/// Made, started, stopped and destroyed by one thread.
class StepSink {
 public:
  StepSink() = default;
  StepSink(const StepSink&) = delete;
  StepSink& operator=(const StepSink&) = delete;
  virtual ~StepSink() = default;

  virtual void start() = 0;
  virtual void stop() = 0;  ///< when the loops have ended; safe to call twice

  /// A step that the servo has made. Its thread; RT-safe.
  virtual void step(const ServoRecord& record) noexcept = 0;
  /// A tick of `proxy`, by the loop that has made it. RT-safe.
  virtual void tick(const TickRequest& request, const ProxyStep& step, const ProxyLoop& proxy,
                    std::int64_t work_ns) noexcept = 0;
  /// Before the loops can take it. Any thread but theirs.
  virtual void scene(std::shared_ptr<const Snapshot> scene) noexcept = 0;
  /// The watchdog has found the servo standing still. Any thread.
  virtual void stall() noexcept = 0;
};

/// For a session that nobody records.
class NoSink final : public StepSink {
 public:
  void start() override {}
  void stop() override {}
  void step(const ServoRecord&) noexcept override {}
  void tick(const TickRequest&, const ProxyStep&, const ProxyLoop&, std::int64_t) noexcept override {}
  void scene(std::shared_ptr<const Snapshot>) noexcept override {}
  void stall() noexcept override {}
};

/// May throw hl::Error.
using MakeStepSink = std::function<std::unique_ptr<StepSink>(const SessionInfo&)>;

}  // namespace hl
