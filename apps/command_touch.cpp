// hl touch: serves a scene with a device, and the page to see it, and to feel it with the mouse.
#include <fmt/core.h>

#include "base/error.h"
#include "base/realtime.h"
#include "base/utf8.h"
#include "choice_option.h"
#include "commands.h"
#include "file_opener.h"
#include "force_options.h"
#include "http/http_server.h"
#include "io/csv_path.h"
#include "io/load_scene_file.h"
#include "io/output_file.h"
#include "load_snapshot.h"
#include "monitor/ros_metrics.h"
#include "monitor/share_metrics.h"
#include "monitor/touch_monitor.h"
#include "open_browser.h"
#include "page/viewer_feed.h"
#include "record/page_recordings.h"
#include "record/recorder.h"
#include "scene_report.h"
#include "serving.h"
#include "session/touch_server.h"
#include "standard_streams.h"
#include "surface_options.h"
#include "touch_options.h"
#include "value_checks.h"

namespace hl {

namespace {

// "left: " for a device that has a name.
std::string headOf(const std::string& device) { return device.empty() ? "" : device + ": "; }

HandScript readScript(const std::string& file) {
  HandScript script;
  const std::vector<PathSample> path = readPath(file);
  for (const PathSample& sample : path) {
    const double time_s = sample.t - path.front().t;
    script.samples.push_back({time_s, sample.position, sample.turned, sample.gripper_rad});
  }
  return script;
}

// How much of its period a servo step took, and what held it up.
void printDuty(const LoopTotals& servo) {
  std::string text;
  for (std::size_t i = 0; i < servo.duty.size(); ++i) {
    if (servo.duty[i] == 0) continue;
    if (i < kDutyBounds.size())
      text += fmt::format(" {} up to {:.0f} %,", servo.duty[i], 100 * kDutyBounds[i]);
    else
      text += fmt::format(" {} longer,", servo.duty[i]);
  }
  if (!text.empty()) text.back() = ';';
  tell("steps by part of the period:{} {} page faults, {} waits, preempted {} times\n", text, servo.page_faults,
       servo.waits, servo.preempted);
}

void printVibration(TouchSession& session) {
  ServoView servo;
  ProxyView proxy;
  session.views(servo, proxy);
  const VibrationView& vibration = servo.vibration;
  if (vibration.alarms == 0) return;
  tell("the spring and the hand shook {}, and it was softened", counted(vibration.alarms, "time"));
  if (vibration.limit_N_m > 0) tell("; at the end below {:.0f} N/m", vibration.limit_N_m);
  tell("\n");
}

void printBeginning(const std::string& scene, const TouchSession& session) {
  tell("{}: {}; device: {}{}, {:g} Hz; 1 mm of the hand is {:.4g} mm of the scene\n", printable(scene),
       counted(session.snapshot()->primitives, "primitive"), headOf(session.label().name), session.deviceInfo().name,
       session.servoRate_Hz(), session.live().workspace().world_per_device);
  if (!session.grant().why.empty())
    tell("the servo runs without all it asked for: {}see hl doctor\n", session.grant().why);
}

bool hasAnyHand(TouchServer& touch) {
  for (std::size_t i = 0; i < touch.devices(); ++i) {
    if (touch.device(i).hasHand()) return true;
  }
  return false;
}

// No file that is read is overwritten.
void requireRecordable(const TouchOptions& options, const std::vector<NamedDevice>& devices) {
  const std::string& file = options.recorder.file;
  if (file.empty()) return;
  std::vector<std::string> read = replayedFiles(devices);
  read.insert(read.end(), {options.scene.scene, options.hand_path});
  if (devices.size() == 1) return requireNotRead(file, read);
  for (const NamedDevice& device : devices) requireNotRead(recordingOf(file, device.name), read);
}

void printTotals(TouchSession& session) {
  if (!session.label().name.empty()) tell("{}:\n", session.label().name);
  const auto line = [](const char* name, const LoopTotals& t) {
    tell("{:<16}{:>10} steps, {} deadlines missed, at most {:.0f} us late\n", name, t.steps, t.missed,
         1e-3 * static_cast<double>(t.late_max_ns));
  };
  const LoopTotals servo = session.servoTotals();
  line("servo:", servo);
  printDuty(servo);
  const LoopTotals ticks = session.proxyTotals();
  line("proxy:", ticks);
  tell("{} of {} ticks were part of a servo step\n", session.ticksInServoSteps(), ticks.steps);
  printVibration(session);
  if (session.settings().timer_reference) line("bare timer:", session.referenceTotals());
}

// What the options say of the session. Gives whether they leave it to the scene how smooth its surfaces feel.
bool applyToSession(TouchOptions& options) {
  // A scene file says how its surfaces feel; a bare model feels as smooth as it looks.
  const bool shade_unset = !options.settings.surfaces.smooth;
  if (!isSceneFile(options.scene.scene) && shade_unset) options.settings.surfaces.smooth = true;
  if (options.scale) options.settings.world_per_device = *options.scale;
  if (!options.hand_path.empty()) options.settings.script = readScript(options.hand_path);
  return shade_unset;
}

TouchServerSettings serverSettings(const TouchOptions& options, std::vector<NamedDevice> devices,
                                   const Limits& limits) {
  TouchServerSettings settings{options.settings, std::move(devices), limits, HL_VERSION, options.devices.faults_joined};
  RecorderSettings recorder = options.recorder;
  recorder.version = HL_VERSION;
  recorder.several = settings.devices.size() > 1;
  recorder.report = [](const std::string& device, const std::string& line) { tell("{}{}\n", headOf(device), line); };
  settings.touch.sink = recorderWith(recorder);
  return settings;
}

}  // namespace

void runTouch(TouchOptions options) {
  const std::vector<NamedDevice> devices = devicesOf(options.devices);
  requireRecordable(options, devices);
  const auto snapshot = loadSnapshot(options.scene, options.upload ? LaterFiles::kMayCome : LaterFiles::kNone);
  const bool shade_unset = applyToSession(options);
  // hl record has all of the session in its file.
  if (options.recorder.file.empty()) options.recorder.pages = std::make_shared<PageRecordings>();
  giveFreedMemoryBack();
  lockProcessMemory();
  const sigset_t signals = blockSignals();
  HttpServerSettings http;
  http.port = static_cast<std::uint16_t>(options.port);
  http.page_folder = options.page_folder.empty() ? defaultPageFolder() : options.page_folder;
  TouchServer touch(snapshot, serverSettings(options, devices, http.limits));
  TouchSession& session = touch.device();
  if (options.settings.script && !hasAnyHand(touch))
    throw Error("--hand-path moves a simulated hand, and a person holds this device");
  FileOpener opener(touch, options.scene.hierarchy, options.scene.cad, shade_unset);
  if (options.upload) {
    http.upload.limit_bytes = kUpload_bytes;
    http.upload.open = [&](int descriptor, const std::string& name) { return opener.open(descriptor, name); };
  }
  const auto ros = makeRosBridge(options.ros, touch, [](const std::string& line) { tell("{}\n", line); });
  const auto share = makeShareBridge(options.share, touch, [](const std::string& line) { tell("{}\n", line); });
  const auto& recordings = options.recorder.pages;
  ViewerFeedSettings page = pageOf(touch, readerOf(share.get()));
  page.recordings = recordings;
  page.upload_bytes = http.upload.limit_bytes;
  MonitorCallbacks monitor = withRosMetrics(makeTouchMonitor(session, &touch, recordings), ros.get());
  HttpServer server(http, makeViewerFeed(session, HL_VERSION, page), &touch,
                    withShareMetrics(std::move(monitor), page.share));
  touch.start();
  if (ros) ros->start();
  if (share) share->start();
  server.start();
  for (std::size_t i = 0; i < touch.devices(); ++i) printBeginning(options.scene.scene, touch.device(i));
  const std::string address = fmt::format("http://127.0.0.1:{}/", server.port());
  fmt::print("page: {}\n", address);
  std::fflush(stdout);
  if (!options.no_open) openBrowser(address);
  waitForSignal(signals, options.duration_s);
  opener.giveUp();
  server.stop();
  if (share) share->stop();
  if (ros) ros->stop();
  touch.stop();
  for (std::size_t i = 0; i < touch.devices(); ++i) printTotals(touch.device(i));
}

namespace {

void addLoopOptions(CLI::App& command, TouchSettings& settings) {
  command.add_option("--radius", settings.radius_D, "proxy radius in metres at the hand")
      ->check(within(kMinRadius_m, kMaxNumber))
      ->capture_default_str();
  command.add_option("--size", settings.side_D, "metres at the hand of the model's largest side")
      ->check(within(kMinNumber, kMaxNumber))
      ->capture_default_str();
  command.add_option("--kp", settings.stiffness_N_m, "spring of the servo in N/m at the hand (default: the device's)")
      ->check(within(kMinNumber, kMaxNumber));
  command.add_option("--damping", settings.damping_Ns_m, "damping of the servo in N s/m (default: the device's)")
      ->check(within(0, 100));
  command.add_flag("--timer-reference", settings.timer_reference,
                   "run a bare timer on the servo's core and count its misses too");
}

}  // namespace

void addTouchOptions(CLI::App& command, TouchOptions& options) {
  addSceneArgument(command, options.scene, false);
  addDeviceOptions(command, options.devices);
  command.add_option("--port", options.port, "port on 127.0.0.1; 0 for any free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command.add_flag("--no-open", options.no_open, "do not start a browser");
  addGripOption(command, options.settings.hand_firm);
  addSwitch(command, "--explore", options.settings.explore, "the built-in stroking hand, until a person takes over");
  command.add_option(
      "--hand-path", options.hand_path,
      "CSV t,x,y,z[,qw,qx,qy,qz][,gripper_rad] (s, m in the scene, rad) that the simulated hand follows instead");
  command
      .add_option("--scale", options.scale, "metres of the scene for one metre of the hand (default: --size decides)")
      ->check(within(kMinNumber, kMaxNumber));
  addLoopOptions(command, options.settings);
  addForceOptions(command, options.settings.servo, options.settings.servo_rate);
  addSurfaceOptions(command, options.settings.surfaces, options.settings.ledger);
  command.get_option("--shade")->option_text("flat|smooth (default: the scene's; smooth for model files)");
  addHierarchyOption(command, options.scene);
  addReadingOptions(command, options.scene);
  addSwitch(
      command, "--upload", options.upload,
      fmt::format("whether the page may open model files of its user, of {} MB at most, in the place of the scene",
                  kUpload_bytes / 1'000'000));
  command.add_option("--page-dir", options.page_folder, "folder of the built page, or of pages of your own")
      ->check(CLI::ExistingDirectory);
  command.add_option("--duration", options.duration_s, "end by itself after this many seconds")
      ->check(within(kMinNumber, kMaxNumber));
  addBlackBoxOption(command, options.recorder);
  addRosOptions(command, options.ros);
  addShareOptions(command, options.share);
}

void addTouchCommand(CLI::App& app) {
  auto* command = app.add_subcommand("touch", "serve a scene with a device and the page to see and feel it");
  auto options = std::make_shared<TouchOptions>();
  addTouchOptions(*command, *options);
  command->callback([options] { runTouch(*options); });
}

}  // namespace hl
