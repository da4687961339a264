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

class TouchMonitor {
 public:
  TouchMonitor(TouchSession& session, const TouchServer* clients, std::shared_ptr<const PageRecordings> recordings)
      : session_(session), clients_(clients), recordings_(std::move(recordings)) {}

  void observe() {
    const std::int64_t now_ns = monotonicNow_ns();
    servo_.observe(session_.servoTotals().steps, now_ns);
    proxy_.observe(session_.proxyTotals().steps, now_ns);
  }

  std::string fault() {
    observe();
    const std::int64_t now_ns = monotonicNow_ns();
    if (servo_.stalled(now_ns)) return "the servo loop stands still";
    if (proxy_.stalled(now_ns)) return "the proxy loop stands still";
    ServoView servo;
    ProxyView proxy;
    session_.views(servo, proxy);
    if (servo.safety == SafetyState::kFault) return std::string("the servo is in fault: ") + faultText(servo.fault);
    for (const ThreadFailures& thread : threadFailures()) {
      if (thread.now) return std::string("the thread '") + thread.thread + "' fails at its work: see the log";
    }
    return {};
  }

  void write(MetricsText& out) {
    ServoView servo;
    ProxyView proxy;
    session_.views(servo, proxy);
    writeLoops(out, servo, proxy);
    writeSafety(out, servo.safety);
    out.single("hl_scene_primitives", MetricType::kGauge, "Primitives that the finger can touch",
               static_cast<double>(session_.snapshot()->primitives));
    out.single("hl_scene_memory_bytes", MetricType::kGauge, "Memory of the scene that the finger touches",
               static_cast<double>(memoryOf(*session_.snapshot())));
    out.single("hl_iteration_caps_total", MetricType::kCounter, "Ticks that hit the cap on their passes",
               static_cast<double>(proxy.ended.capped()));
    out.single("hl_unplaced_ticks_total", MetricType::kCounter, "Ticks in which no place for the proxy was clear",
               static_cast<double>(proxy.ended[Ending::kUnplaced]));
    writeEndings(out, proxy.ended);
    writeLedger(out, proxy.ledger, servo.late);
    writeBodies(out, proxy.bodies);
    writeFailures(out);
    writeVibration(out, servo.vibration);
    if (recordings_) writeRecordings(out, recordings_->status());
    if (clients_ == nullptr) return;
    writeHierarchies(out, clients_->hierarchyCounts());
    writeMemory(out, clients_->memory());
  }

 private:
  void writeLoops(MetricsText& out, const ServoView& servo, const ProxyView& proxy) const {
    struct Loop {
      const char* name;
      LoopSummary second;
      LoopTotals totals;
    };
    std::vector<Loop> loops{{"servo", servo.loop, session_.servoTotals()},
                            {"proxy", proxy.loop, session_.proxyTotals()}};
    if (session_.settings().timer_reference) loops.push_back({"bare timer", {}, session_.referenceTotals()});
    const auto family = [&](const char* name, MetricType type, const char* help, auto value) {
      out.family(name, type, help);
      for (const Loop& loop : loops) out.sample(static_cast<double>(value(loop)), {{"loop", loop.name}});
    };
    using enum MetricType;
    family("hl_loop_rate_hertz", kGauge, "Steps a second, over the last one", [](auto& l) { return l.second.rate_Hz; });
    family("hl_loop_steps_total", kCounter, "Steps since the start", [](auto& l) { return l.totals.steps; });
    family("hl_loop_deadlines_missed_total", kCounter, "Periods skipped", [](auto& l) { return l.totals.missed; });
    family("hl_loop_page_faults_total", kCounter, "Pages that were not there",
           [](auto& l) { return l.totals.page_faults; });
    family("hl_loop_waits_total", kCounter, "Waits for anything else than the next deadline",
           [](auto& l) { return l.totals.waits; });
    family("hl_loop_preempted_total", kCounter, "Times that another thread was given the core",
           [](auto& l) { return l.totals.preempted; });
    writeDuty(out, session_.servoTotals());
    family("hl_loop_late_max_seconds", kGauge, "Worst wake-up after its deadline since the start",
           [](auto& l) { return 1e-9 * static_cast<double>(l.totals.late_max_ns); });
    family("hl_loop_work_max_seconds", kGauge, "Longest work of a step in the last second",
           [](auto& l) { return 1e-9 * static_cast<double>(l.second.max_ns); });
    out.family("hl_loop_work_seconds", kGauge, "Work of one step in the last second");
    for (const Loop& loop : loops) {
      out.sample(1e-9 * static_cast<double>(loop.second.p50_ns), {{"loop", loop.name}, {"quantile", "0.5"}});
      out.sample(1e-9 * static_cast<double>(loop.second.p999_ns), {{"loop", loop.name}, {"quantile", "0.999"}});
    }
  }

  // As Prometheus wants a histogram: each bucket has those below it too.
  static void writeDuty(MetricsText& out, const LoopTotals& servo) {
    out.family("hl_servo_duty_total", MetricType::kCounter, "Servo steps that took up to this part of their period");
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < servo.duty.size(); ++i) {
      sum += servo.duty[i];
      const std::string bound = i < kDutyBounds.size() ? fmt::format("{}", kDutyBounds[i]) : "+Inf";
      out.sample(static_cast<double>(sum), {{"le", bound}});
    }
  }

  static void writeEndings(MetricsText& out, const EndingCounts& ended) {
    out.family("hl_ticks_ended_total", MetricType::kCounter, "Ticks by why they ended");
    ended.each([&](Ending ending, std::uint64_t count) {
      out.sample(static_cast<double>(count), {{"ending", nameOf(ending)}});
    });
  }

  static void writeSafety(MetricsText& out, SafetyState safety) {
    out.family("hl_safety_state", MetricType::kGauge, "1 for the state that the servo is in");
    for (std::size_t i = 0; i < kSafetyNames.size(); ++i) {
      out.sample(static_cast<std::size_t>(safety) == i ? 1 : 0, {{"state", kSafetyNames[i]}});
    }
  }

  // The proxy's ledger and the servo's, which books late hand-over, as one.
  static void writeLedger(MetricsText& out, const Ledger& ledger, const Ledger& late) {
    using enum MetricType;
    out.single("hl_ledger_tank_joules", kGauge, "Energy that the surfaces may still add", ledger.tank_J);
    out.single("hl_ledger_injected_joules_total", kCounter, "Energy that the surfaces' rules have added",
               ledger.injected_J + late.injected_J);
    out.single("hl_ledger_dissipated_joules_total", kCounter, "Energy that they have taken away",
               ledger.dissipated_J + late.dissipated_J);
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

  static void writeVibration(MetricsText& out, const VibrationView& vibration) {
    using enum MetricType;
    out.single("hl_vibrations_total", kCounter, "Times that the spring and the hand shook and it was softened",
               static_cast<double>(vibration.alarms));
    out.single("hl_vibration_dissipated_joules_total", kCounter, "Energy that softening and its damper took",
               vibration.dissipated_J);
    out.single("hl_spring_limit_newtons_per_metre", kGauge, "The spring is held below it; 0: there is no limit",
               vibration.limit_N_m);
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

  TouchSession& session_;
  const TouchServer* const clients_;
  const std::shared_ptr<const PageRecordings> recordings_;
  StepWatch servo_, proxy_;
};

}  // namespace

MonitorCallbacks makeTouchMonitor(TouchSession& session, const TouchServer* clients,
                                  std::shared_ptr<const PageRecordings> recordings) {
  const auto monitor = std::make_shared<TouchMonitor>(session, clients, std::move(recordings));
  return {[monitor] { monitor->observe(); }, [monitor] { return monitor->fault(); },
          [monitor](MetricsText& out) { monitor->write(out); }};
}

}  // namespace hl
