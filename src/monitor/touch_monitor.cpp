#include "monitor/touch_monitor.h"

#include <fmt/core.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/guarded_thread.h"

namespace hl {

namespace {

// Loops run at 100 Hz at the least; a quarter of a second without a step is no hiccup.
constexpr std::int64_t kStalled_ns = 250'000'000;
constexpr std::array<const char*, 5> kSafetyNames{"off", "arming", "on", "fault", "waiting"};

// When a loop made its newest step, as seen from outside.
class StepWatch {
 public:
  void observe(std::uint64_t steps, std::int64_t now_ns) {
    if (steps == steps_ && moved_ns_ != 0) return;
    steps_ = steps;
    moved_ns_ = now_ns;
  }
  bool stalled(std::int64_t now_ns) const { return moved_ns_ != 0 && now_ns - moved_ns_ > kStalled_ns; }

 private:
  std::uint64_t steps_ = 0;
  std::int64_t moved_ns_ = 0;  // 0: nothing observed yet
};

// One device, as it is when the numbers are asked for.
struct MonitoredDevice {
  TouchSession& session;
  StepWatch servo_steps{}, proxy_steps{};
  ServoView servo{};
  ProxyView proxy{};
};

// Of a device that has no name there is one.
std::string headOfDevice(const MonitoredDevice& device) {
  const std::string& name = device.session.label().name;
  return name.empty() ? "" : "device '" + name + "': ";
}

std::vector<MonitoredDevice> monitored(TouchSession& session, TouchServer* clients) {
  std::vector<MonitoredDevice> devices;
  if (clients == nullptr) devices.push_back({session});
  for (std::size_t i = 0; clients != nullptr && i < clients->devices(); ++i) devices.push_back({clients->device(i)});
  return devices;
}

class TouchMonitor {
 public:
  TouchMonitor(TouchSession& session, TouchServer* clients, std::shared_ptr<const PageRecordings> recordings)
      : devices_(monitored(session, clients)), clients_(clients), recordings_(std::move(recordings)) {}

  void observe() {
    const std::int64_t now_ns = monotonicNow_ns();
    for (MonitoredDevice& device : devices_) {
      device.servo_steps.observe(device.session.servoTotals().steps, now_ns);
      device.proxy_steps.observe(device.session.proxyTotals().steps, now_ns);
    }
  }

  std::string fault() {
    observe();
    if (const std::string why = faultOfDevices(); !why.empty()) return why;
    for (const ThreadFailures& thread : threadFailures()) {
      if (thread.now) return std::string("the thread '") + thread.thread + "' fails at its work: see the log";
    }
    return {};
  }

  void write(MetricsText& out) {
    for (MonitoredDevice& device : devices_) device.session.views(device.servo, device.proxy);
    writeLoops(out);
    writeSafety(out);
    writeScene(out);
    writeEndings(out);
    writeLedger(out);
    writeBodies(out, devices_.front().proxy.bodies);
    writeFailures(out);
    writeVibration(out);
    if (recordings_) writeRecordings(out, recordings_->status());
    if (clients_ == nullptr) return;
    writeHierarchies(out, clients_->hierarchyCounts());
    writeMemory(out, clients_->memory());
  }

 private:
  using Device = MonitoredDevice;
  struct Loop {
    const char* name;
    LoopSummary second;
    LoopTotals totals;
  };

  // Of devices that stop together, that of the one for whose sake they do.
  std::string faultOfDevices() {
    std::string of_others;
    for (MonitoredDevice& device : devices_) {
      const std::string why = faultOf(device);
      if (why.empty()) continue;
      if (device.servo.fault != FaultReason::kOtherDevice) return headOfDevice(device) + why;
      if (of_others.empty()) of_others = headOfDevice(device) + why;
    }
    return of_others;
  }

  static std::string faultOf(Device& device) {
    const std::int64_t now_ns = monotonicNow_ns();
    if (device.servo_steps.stalled(now_ns)) return "the servo loop stands still";
    if (device.proxy_steps.stalled(now_ns)) return "the proxy loop stands still";
    device.session.views(device.servo, device.proxy);
    if (device.servo.safety != SafetyState::kFault) return {};
    return std::string("the servo is in fault: ") + faultText(device.servo.fault);
  }

  // The samples of each device, with its name.
  template <typename Write>
  void ofEach(MetricsText& out, Write write) const {
    for (const Device& device : devices_) {
      out.setDevice(device.session.label().name);
      write(device);
    }
    out.setDevice("");
  }
  template <typename Value>
  void family(MetricsText& out, const char* name, MetricType type, const char* help, Value value) const {
    out.family(name, type, help);
    ofEach(out, [&](const Device& device) { out.sample(static_cast<double>(value(device))); });
  }

  static std::vector<Loop> loopsOf(const Device& device) {
    std::vector<Loop> loops{{"servo", device.servo.loop, device.session.servoTotals()},
                            {"proxy", device.proxy.loop, device.session.proxyTotals()}};
    if (device.session.settings().timer_reference)
      loops.push_back({"bare timer", {}, device.session.referenceTotals()});
    return loops;
  }

  template <typename Value>
  void loopFamily(MetricsText& out, const char* name, MetricType type, const char* help, Value value) const {
    out.family(name, type, help);
    ofEach(out, [&](const Device& device) {
      for (const Loop& loop : loopsOf(device)) out.sample(static_cast<double>(value(loop)), {{"loop", loop.name}});
    });
  }

  void writeLoops(MetricsText& out) const {
    using enum MetricType;
    loopFamily(out, "hl_loop_rate_hertz", kGauge, "Steps a second, over the last one",
               [](auto& l) { return l.second.rate_Hz; });
    loopFamily(out, "hl_loop_steps_total", kCounter, "Steps since the start", [](auto& l) { return l.totals.steps; });
    loopFamily(out, "hl_loop_deadlines_missed_total", kCounter, "Periods skipped",
               [](auto& l) { return l.totals.missed; });
    loopFamily(out, "hl_loop_page_faults_total", kCounter, "Pages that were not there",
               [](auto& l) { return l.totals.page_faults; });
    loopFamily(out, "hl_loop_waits_total", kCounter, "Waits for anything else than the next deadline",
               [](auto& l) { return l.totals.waits; });
    loopFamily(out, "hl_loop_preempted_total", kCounter, "Times that another thread was given the core",
               [](auto& l) { return l.totals.preempted; });
    writeDuty(out);
    loopFamily(out, "hl_loop_late_max_seconds", kGauge, "Worst wake-up after its deadline since the start",
               [](auto& l) { return seconds(l.totals.late_max_ns); });
    loopFamily(out, "hl_loop_work_max_seconds", kGauge, "Longest work of a step in the last second",
               [](auto& l) { return seconds(l.second.max_ns); });
    out.family("hl_loop_work_seconds", kGauge, "Work of one step in the last second");
    ofEach(out, [&](const Device& device) {
      for (const Loop& loop : loopsOf(device)) {
        out.sample(seconds(loop.second.p50_ns), {{"loop", loop.name}, {"quantile", "0.5"}});
        out.sample(seconds(loop.second.p999_ns), {{"loop", loop.name}, {"quantile", "0.999"}});
      }
    });
  }

  // As Prometheus wants a histogram: each bucket has those below it too.
  void writeDuty(MetricsText& out) const {
    out.family("hl_servo_duty_total", MetricType::kCounter, "Servo steps that took up to this part of their period");
    ofEach(out, [&](const Device& device) {
      const LoopTotals servo = device.session.servoTotals();
      std::uint64_t sum = 0;
      for (std::size_t i = 0; i < servo.duty.size(); ++i) {
        sum += servo.duty[i];
        const std::string bound = i < kDutyBounds.size() ? fmt::format("{}", kDutyBounds[i]) : "+Inf";
        out.sample(static_cast<double>(sum), {{"le", bound}});
      }
    });
  }

  // All devices touch one scene.
  void writeScene(MetricsText& out) const {
    using enum MetricType;
    const std::shared_ptr<const Snapshot> scene = devices_.front().session.snapshot();
    out.single("hl_scene_primitives", kGauge, "Primitives that the finger can touch",
               static_cast<double>(scene->primitives));
    out.single("hl_scene_memory_bytes", kGauge, "Memory of the scene that the finger touches",
               static_cast<double>(memoryOf(*scene)));
  }

  void writeEndings(MetricsText& out) const {
    using enum MetricType;
    family(out, "hl_iteration_caps_total", kCounter, "Ticks that hit the cap on their passes",
           [](const Device& device) { return device.proxy.ended.capped(); });
    family(out, "hl_unplaced_ticks_total", kCounter, "Ticks in which no place for the proxy was clear",
           [](const Device& device) { return device.proxy.ended[Ending::kUnplaced]; });
    out.family("hl_ticks_ended_total", kCounter, "Ticks by why they ended");
    ofEach(out, [&](const Device& device) {
      device.proxy.ended.each([&](Ending ending, std::uint64_t count) {
        out.sample(static_cast<double>(count), {{"ending", nameOf(ending)}});
      });
    });
  }

  void writeSafety(MetricsText& out) const {
    out.family("hl_safety_state", MetricType::kGauge, "1 for the state that the servo is in");
    ofEach(out, [&](const Device& device) {
      for (std::size_t i = 0; i < kSafetyNames.size(); ++i)
        out.sample(static_cast<std::size_t>(device.servo.safety) == i ? 1 : 0, {{"state", kSafetyNames[i]}});
    });
  }

  // The proxy's ledger and the servo's, which books late hand-over, as one.
  void writeLedger(MetricsText& out) const {
    using enum MetricType;
    family(out, "hl_ledger_tank_joules", kGauge, "Energy that the surfaces may still add",
           [](const Device& device) { return device.proxy.ledger.tank_J; });
    family(out, "hl_ledger_injected_joules_total", kCounter, "Energy that the surfaces' rules have added",
           [](const Device& device) { return device.proxy.ledger.injected_J + device.servo.late.injected_J; });
    family(out, "hl_ledger_dissipated_joules_total", kCounter, "Energy that they have taken away",
           [](const Device& device) { return device.proxy.ledger.dissipated_J + device.servo.late.dissipated_J; });
  }

  // Work may have either sign, so it is no counter.
  static void writeBodies(MetricsText& out, const BodyView& bodies) {
    using enum MetricType;
    out.single("hl_bodies", kGauge, "Rigid bodies of the scene that can move", static_cast<double>(bodies.bodies));
    out.family("hl_bodies_energy_joules", kGauge, "Energy of the bodies");
    out.sample(bodies.kinetic_J, {{"kind", "kinetic"}});
    out.sample(bodies.gravity_J, {{"kind", "gravity"}});
    out.family("hl_bodies_work_joules", kGauge,
               "What has changed it: hand + solver - contact - friction, besides joints and clients");
    out.sample(bodies.energy.by_hand_J, {{"by", "hand"}});
    out.sample(bodies.energy.contact_J, {{"by", "contact"}});
    out.sample(bodies.energy.friction_J, {{"by", "friction"}});
    out.sample(bodies.energy.solver_J, {{"by", "solver"}});
    out.single("hl_bodies_lost_seconds_total", kCounter, "By how much the time of the bodies is behind", bodies.lost_s);
    out.single("hl_bodies_contacts_dropped_total", kCounter, "Contacts of bodies that a step had no room for",
               static_cast<double>(bodies.dropped));
    out.single("hl_bodies_unsolved_steps_total", kCounter, "Steps of bodies whose solve ended at its limit of work",
               static_cast<double>(bodies.unsolved));
    out.single("hl_bodies_returned_total", kCounter, "Bodies that left their scene and were put back to their start",
               static_cast<double>(bodies.returned));
  }

  static void writeFailures(MetricsText& out) {
    out.family("hl_thread_failures_total", MetricType::kCounter, "Pieces of work that threads could not do");
    for (const ThreadFailures& thread : threadFailures())
      out.sample(static_cast<double>(thread.count), {{"thread", thread.thread}});
  }

  void writeVibration(MetricsText& out) const {
    using enum MetricType;
    family(out, "hl_vibrations_total", kCounter, "Times that the spring and the hand shook and it was softened",
           [](const Device& device) { return device.servo.vibration.alarms; });
    family(out, "hl_vibration_dissipated_joules_total", kCounter, "Energy that softening and its damper took",
           [](const Device& device) { return device.servo.vibration.dissipated_J; });
    family(out, "hl_spring_limit_newtons_per_metre", kGauge, "The spring is held below it; 0: there is no limit",
           [](const Device& device) { return device.servo.vibration.limit_N_m; });
  }

  static void writeRecordings(MetricsText& out, const PageRecordingStatus& status) {
    using enum MetricType;
    using Phase = PageRecordingStatus::Phase;
    out.single("hl_page_recordings_total", kCounter, "Recordings that pages have begun",
               static_cast<double>(status.begun));
    out.single("hl_page_recording_running", kGauge, "1 while one runs", status.phase == Phase::kRunning ? 1 : 0);
    out.single("hl_page_recording_bytes", kGauge, "Size of the one that runs or can be fetched",
               static_cast<double>(status.bytes));
  }

  static void writeHierarchies(MetricsText& out, const HierarchyCounts& counts) {
    using enum MetricType;
    out.single("hl_hierarchy_refits_total", kCounter, "Redefined objects whose hierarchy was refitted, not built",
               static_cast<double>(counts.refits));
    out.single("hl_hierarchy_rebuilds_total", kCounter, "Refitted hierarchies that were built anew as they were worn",
               static_cast<double>(counts.rebuilds));
  }

  static void writeMemory(MetricsText& out, const MemoryBudget& memory) {
    using enum MetricType;
    out.single("hl_memory_used_bytes", kGauge, "Memory of all clients' scenes and uploads",
               static_cast<double>(memory.used_bytes()));
    out.single("hl_memory_limit_bytes", kGauge, "What they may take; a scene that does not fit is refused",
               static_cast<double>(memory.most_bytes()));
  }

  std::vector<Device> devices_;  // at least one
  const TouchServer* const clients_;
  const std::shared_ptr<const PageRecordings> recordings_;
};

}  // namespace

MonitorCallbacks makeTouchMonitor(TouchSession& session, TouchServer* clients,
                                  std::shared_ptr<const PageRecordings> recordings) {
  const auto monitor = std::make_shared<TouchMonitor>(session, clients, std::move(recordings));
  return {[monitor] { monitor->observe(); }, [monitor] { return monitor->fault(); },
          [monitor](MetricsText& out) { monitor->write(out); }};
}

}  // namespace hl
