// hld: the server alone, for a network or a machine without a screen. Runs in the foreground and logs to stderr; ends
// with code 0 on SIGINT and SIGTERM, and with one line and code 2 on bad input.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <optional>

#include "base/error.h"
#include "base/realtime.h"
#include "base/utf8.h"
#include "hld_options.h"
#include "load_snapshot.h"
#include "monitor/ros_metrics.h"
#include "monitor/share_metrics.h"
#include "monitor/touch_monitor.h"
#include "option_errors.h"
#include "page/viewer_feed.h"
#include "record/recorder.h"
#include "serving.h"
#include "session/touch_server.h"
#include "standard_streams.h"
#include "systemd_notify.h"
#include "token_file.h"

namespace hl {

namespace {

std::shared_ptr<const Snapshot> sceneOf(const HldOptions& options) {
  if (!options.scene.scene.empty()) return loadSnapshot(options.scene);
  requireNoReading(options.scene);
  return makeSnapshot(std::vector<Instance>{},
                      options.share.world.empty() ? "the clients' world" : "the world " + options.share.world);
}

HttpServerSettings serverSettings(const HldOptions& options) {
  HttpServerSettings settings = options.server;
  if (settings.page_folder.empty()) settings.page_folder = defaultPageFolder();
  if (options.token_file.empty()) return settings;
  settings.token = readTokenFile(options.token_file);
  if (isReadableByOthers(options.token_file)) {
    logEvent(LogLevel::kWarning, "token_is_no_secret",
             {{"file", options.token_file}, {"reason", "everybody on this machine may read it; chmod 600 it"}});
  }
  return settings;
}

void logFault(const std::string& device, const std::string& line) {
  if (device.empty()) return logEvent(LogLevel::kError, "fault", {{"reason", line}});
  logEvent(LogLevel::kError, "fault", {{"device", device}, {"reason", line}});
}

// Of several devices: which is which.
void logDevice(const TouchSession& session) {
  const std::string& name = session.label().name;
  const std::string& why = session.grant().why;
  if (!name.empty())
    logEvent(LogLevel::kInfo, "device",
             {{"name", name},
              {"model", session.deviceInfo().name},
              {"number", std::to_string(session.label().number)},
              {"rate_Hz", fmt::format("{:g}", session.servoRate_Hz())}});
  if (why.empty()) return;
  if (name.empty()) return logEvent(LogLevel::kWarning, "not_real_time", {{"reason", why}});
  logEvent(LogLevel::kWarning, "not_real_time", {{"device", name}, {"reason", why}});
}

std::string namesOf(TouchServer& touch) {
  std::string names;
  for (std::size_t i = 0; i < touch.devices(); ++i) {
    const TouchSession& session = touch.device(i);
    const std::string& name = session.label().name;
    names += (i == 0 ? "" : ", ") + (name.empty() ? "" : name + ": ") + session.deviceInfo().name;
  }
  return names;
}

void logReady(const HldOptions& options, TouchServer& touch, std::uint16_t port) {
  const TouchSession& session = touch.device();
  const bool v6 = options.server.listen.find(':') != std::string::npos;
  logEvent(LogLevel::kInfo, "ready",
           {{"address", fmt::format(fmt::runtime(v6 ? "{}://[{}]:{}/" : "{}://{}:{}/"),
                                    options.server.tls.empty() ? "http" : "https", options.server.listen, port)},
            {"token", options.token_file.empty() ? "none" : "asked_for"},
            {"device", namesOf(touch)},
            {"scene", options.scene.scene},
            {"primitives", std::to_string(session.snapshot()->primitives)}});
  for (std::size_t i = 0; i < touch.devices(); ++i) logDevice(touch.device(i));
}

void reloadToken(HttpServer& server, const std::string& file) {
  if (file.empty()) return;
  try {
    server.setToken(readTokenFile(file));
    logEvent(LogLevel::kInfo, "token_read_again", {{"file", file}});
  } catch (const Error& error) {
    logEvent(LogLevel::kError, "token_kept", {{"reason", error.what()}});
  }
}

void serve(HldOptions& options) {
  openEventLog(options.log_format, options.log_level);
  giveFreedMemoryBack();
  lockProcessMemory();
  const sigset_t signals = blockSignals();
  options.recorder.version = HL_VERSION;
  const std::vector<NamedDevice> devices = devicesOf(options.devices);
  options.recorder.report = logFault;
  options.touch.sink = recorderWith(options.recorder);
  const HttpServerSettings http = serverSettings(options);
  TouchServer touch(sceneOf(options), {options.touch, devices, http.limits, HL_VERSION, options.devices.faults_joined});
  TouchSession& session = touch.device();
  const auto ros = makeRosBridge(options.ros, touch, [](const std::string& line) {
    logEvent(LogLevel::kWarning, "ros", {{"reason", line}});
  });
  const auto share = makeShareBridge(options.share, touch, [](const std::string& line) {
    logEvent(LogLevel::kInfo, "share", {{"news", line}});
  });
  const ViewerFeedSettings page = pageOf(touch, readerOf(share.get()));
  MonitorCallbacks monitor = withRosMetrics(makeTouchMonitor(session, &touch), ros.get());
  HttpServer server(http, makeViewerFeed(session, HL_VERSION, page), &touch,
                    withShareMetrics(std::move(monitor), page.share));
  touch.start();
  if (ros) ros->start();
  if (share) share->start();
  server.start();
  logReady(options, touch, server.port());
  notifySystemd("READY=1");
  std::optional<int> received = waitForSignal(signals);
  for (; received == SIGHUP; received = waitForSignal(signals)) reloadToken(server, options.token_file);
  logEvent(LogLevel::kInfo, "stopping", {{"reason", received == SIGINT ? "SIGINT" : "SIGTERM"}});
  notifySystemd("STOPPING=1");
  server.stop();
  if (share) share->stop();
  if (ros) ros->stop();
  touch.stop();
}

}  // namespace

}  // namespace hl

namespace {

// With the file that options are read from, where there is one.
std::string errorText(const CLI::App& app, const CLI::ParseError& error) {
  constexpr std::string_view kUnknown = "INI was not able to parse ";
  std::string text = hl::errorText(error);
  if (text.starts_with(kUnknown)) text = "there is no option '" + text.substr(kUnknown.size()) + "'";
  text = hl::validUtf8(text);
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, '?');
  const CLI::Option* const config = app.get_config_ptr();
  const bool of_file = !config->empty() && text.find("--config") == std::string::npos;
  return of_file ? text + ", on the command line or in " + config->as<std::string>() : text;
}

int run(int argc, char** argv) {
  CLI::App app("The HL server: a haptic device and a scene, for clients and pages.", "hld");
  app.set_version_flag("--version", std::string("hld ") + HL_VERSION);
  hl::HldOptions options;
  hl::addHldOptions(app, options);
  hl::refuseEmptyWords(app);
  try {
    app.parse(argc, argv);
    hl::serve(options);
  } catch (const CLI::Success& asked) {  // --help, --version
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    hl::tell("hld: {} (try --help)\n", hl::printable(errorText(app, error)));
    return 2;
  } catch (const hl::Error& error) {
    hl::tell("hld: {}\n", hl::printable(error.what()));
    return 2;
  } catch (const std::bad_alloc&) {
    hl::tell("hld: not enough memory for this scene\n");
    return 2;
  } catch (const std::exception& error) {
    hl::tell("hld: unexpected failure: {}\n", hl::printable(error.what()));
    return 1;
  }
  return 0;
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): only when there is no memory for a line
int main(int argc, char** argv) {
  hl::prepareStreams();
  return hl::codeWithOutput(run(argc, argv), "hld");
}
