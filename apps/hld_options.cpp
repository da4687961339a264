#include "hld_options.h"

#include <limits>
#include <map>

#include "choice_option.h"
#include "force_options.h"
#include "serving.h"
#include "value_checks.h"

namespace hl {

namespace {

void addNetworkOptions(CLI::App& app, HldOptions& options) {
  HttpServerSettings& server = options.server;
  app.add_option("--listen", server.listen,
                 "address to listen on; beyond loopback (0.0.0.0, ::, ...) TLS and a token are needed")
      ->capture_default_str()
      ->group("Network");
  app.add_option("--port", server.port, "port; 0 for any free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str()
      ->group("Network");
  app.add_option("--tls-certificate", server.tls.certificate, "PEM file: the certificate and its chain")
      ->group("Network");
  app.add_option("--tls-key", server.tls.key, "PEM file: the certificate's key")->group("Network");
  app.add_option("--token-file", options.token_file, "file with the token that clients must show; read again on SIGHUP")
      ->group("Network");
  app.add_option("--page-dir", server.page_folder, "folder of the built page, or of pages of your own")
      ->check(CLI::ExistingDirectory)
      ->group("Network");
}

void addHandOptions(CLI::App& app, HldOptions& options) {
  addDeviceOptions(app, options.devices);
  addSimulatedDevicesOption(app, options.devices);
  addGripOption(app, options.touch.hand_firm)->group("Device");
  addSwitch(app, "--explore", options.touch.explore,
            "the built-in stroking hand, until a person or a client takes over")
      ->group("Device");
  app.add_option("--radius", options.touch.radius_D, "proxy radius in metres at the hand")
      ->check(within(kMinRadius_m, kMaxNumber))
      ->capture_default_str()
      ->group("Device");
  app.add_flag("--timer-reference", options.touch.timer_reference,
               "run a bare timer on the servo's core and count its misses too")
      ->group("Device");
}

// Less has no room for one session with one triangle.
constexpr std::uint64_t kMinMemory_bytes = 1'000'000;
// Threads: more than there are processors are of no use.
constexpr std::uint32_t kMaxWorkers = 256;

template <typename Number>
void addLimit(CLI::App& app, const std::string& name, Number& limit, const std::string& what, Number least = 1,
              Number most = std::numeric_limits<Number>::max()) {
  CLI::Option* const option = app.add_option("--limit-" + name, limit, what)->capture_default_str()->group("Limits");
  if constexpr (std::is_integral_v<Number>) {
    option->check(whole(least, most));
  } else {
    option->check(within(kMinNumber, kMaxNumber));
  }
}

void addLimitOptions(CLI::App& app, Limits& limits) {
  addLimit(app, "message-bytes", limits.message_bytes, "bytes of one message", limits.open_bytes);
  addLimit(app, "messages", limits.messages_Hz, "messages a second of one client");
  addLimit(app, "objects", limits.objects, "objects of one client");
  addLimit(app, "scene-bytes", limits.scene_bytes, "bytes of memory for the shapes of one client");
  addLimit(app, "instances", limits.instances, "objects in the world of one client");
  addLimit(app, "texture-bytes", limits.texture_bytes, "bytes of the textures of one client");
  addLimit(app, "nesting", limits.nesting, "calls of objects within objects");
  addLimit(app, "upload-bytes", limits.upload_bytes, "bytes of uploads that no frame has used yet, of one client");
  addLimit(app, "frames", limits.frames_Hz, "frames a second of one client");
  addLimit(app, "states", limits.state_rate_Hz, "states a second to one client");
  addLimit(
      app, "memory-bytes", limits.memory_bytes,
      "bytes of memory for all scenes and whatever else clients and pages make the server keep; the program itself "
      "takes about 100 MB beside",
      kMinMemory_bytes);
  addLimit(app, "kept", limits.kept, "clients that have gone and whose objects stay");
  addLimit(app, "sessions", limits.sessions, "clients at once");
  addLimit(app, "pages", limits.pages, "viewer pages at once");
  addLimit(app, "connections", limits.connections, "sockets at once");
  addLimit(app, "workers", limits.workers, "threads that decode messages", 1U, kMaxWorkers);
  addLimit(app, "handshake", limits.handshake_s, "seconds for TLS, the upgrade and Open, each");
  addLimit(app, "idle", limits.idle_s, "seconds of silence after which a client has gone");
  addLimit(app, "write", limits.write_s, "seconds after which a client that reads nothing is ended");
}

void addLogOptions(CLI::App& app, HldOptions& options) {
  const std::map<std::string, LogLevel> levels{{"debug", LogLevel::kDebug},
                                               {"info", LogLevel::kInfo},
                                               {"warning", LogLevel::kWarning},
                                               {"error", LogLevel::kError}};
  const std::map<std::string, LogFormat> formats{{"keyvalue", LogFormat::kKeyValue}, {"json", LogFormat::kJson}};
  app.add_option("--log-level", options.log_level, "what is written to stderr")
      ->transform(oneOf(levels))
      ->option_text("debug|info|warning|error (default: info)")
      ->group("Log");
  app.add_option("--log-format", options.log_format, "one line an event, as key=value or as JSON")
      ->transform(oneOf(formats))
      ->option_text("keyvalue|json (default: keyvalue)")
      ->group("Log");
}

}  // namespace

void addHldOptions(CLI::App& app, HldOptions& options) {
  options.scene.scene.clear();
  options.touch.explore = false;
  app.set_config("--config", "", "read options from this file, one 'name = value' a line; the command line wins")
      ->check(plainFile());
  app.allow_config_extras(CLI::config_extras_mode::error);  // a misspelt name is no silent default
  app.add_option("--scene", options.scene.scene, "a model or scene file, or a built-in scene, to begin with");
  addHierarchyOption(app, options.scene);
  addReadingOptions(app, options.scene);
  addNetworkOptions(app, options);
  addHandOptions(app, options);
  addForceOptions(app, options.touch.servo, options.touch.servo_rate);
  addBlackBoxOption(app, options.recorder);
  addRosOptions(app, options.ros);
  addShareOptions(app, options.share);
  addLimitOptions(app, options.server.limits);
  addLogOptions(app, options);
}

}  // namespace hl
