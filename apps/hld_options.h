// What hld can be set to do, on its command line or in its configuration file: the same names in both.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "device_options.h"
#include "http/http_server.h"
#include "monitor/event_log.h"
#include "record/recorder.h"
#include "ros_options.h"
#include "scene_options.h"
#include "share_options.h"
#include "touch/touch_session.h"

namespace hl {

struct HldOptions {
  SceneOptions scene;         ///< of an empty name: nothing to touch at first
  HttpServerSettings server;  ///< but for the token
  TouchSettings touch;
  RecorderSettings recorder;
  RosOptions ros;
  ShareOptions share;
  std::string token_file;  ///< empty: no token
  DeviceOptions devices;
  LogFormat log_format = LogFormat::kKeyValue;
  LogLevel log_level = LogLevel::kInfo;
};

/// `options` must outlive `app`.
void addHldOptions(CLI::App& app, HldOptions& options);

}  // namespace hl
