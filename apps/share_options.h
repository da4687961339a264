// Options of shared worlds, the same for hl and hld, and the bridge that they ask for.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "ros/dds_reach.h"
#include "session/touch_server.h"
#include "share/share_bridge.h"

namespace hl {

struct ShareOptions {
  std::string world;  ///< empty: none is shared
  std::string name;   ///< of this server in it; empty: as the machine is called
  bool adopt = true;  ///< takes over what a lost server leaves behind
  DdsReach reach;
};

/// `options` must outlive `app`.
void addShareOptions(CLI::App& app, ShareOptions& options);

/// With hl-share started, for the scene and devices of `server`, which must outlive it; null when nobody asks for a
/// shared world. Throws hl::Error when hl-share cannot be had. Before other threads are started.
std::unique_ptr<ShareBridge> makeShareBridge(const ShareOptions& options, TouchServer& server,
                                             ShareBridge::ReportLine report);

/// What a bridge reports; empty where there is none. It must outlive what reads it.
ReadShare readerOf(const ShareBridge* bridge);

/// Of what a person may expect of --share here, in one line: for hl doctor.
std::string sharePresence();

}  // namespace hl
