// The options of hl touch, and hl record too.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
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
  bool no_open = false;  ///< no browser
  std::string hand_path;
  bool upload = true;  ///< pages may open files
  std::string page_folder;
  std::optional<double> scale;       ///< metres of the scene for one of the hand; absent: settings.side_D decides
  std::optional<double> duration_s;  ///< absent: until a signal comes
};

/// `options` must outlive `command`.
void addTouchOptions(CLI::App& command, TouchOptions& options);

/// Serves until a signal comes or the duration is over. Throws hl::Error.
void runTouch(TouchOptions options);

}  // namespace hl
