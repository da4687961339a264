// The options of hl touch, and hl record too.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "device_options.h"
#include "record/recorder.h"
#include "ros_options.h"
#include "scene_options.h"
#include "share_options.h"
#include "touch/touch_session.h"

namespace hl {

struct TouchOptions {
  SceneOptions scene;
  TouchSettings settings;
  RecorderSettings recorder;
  RosOptions ros;
  ShareOptions share;
  DeviceOptions devices;
  int port = 1997;
  bool no_open = false;
  std::string hand = "light";
  std::string explore = "on";
  std::string hand_path;
  std::string upload = "on";
  std::string page_folder;
  double scale = 0;
  double duration_s = 0;
};

/// `options` must outlive `command`.
void addTouchOptions(CLI::App& command, TouchOptions& options);

/// Serves until a signal comes or the duration is over. Throws hl::Error.
void runTouch(TouchOptions options);

}  // namespace hl
