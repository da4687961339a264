// What the programs that serve have in common: where the page is, and the signals that end or command them.
#pragma once

#include <signal.h>

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "page/viewer_feed.h"
#include "record/recorder.h"
#include "session/touch_server.h"

namespace hl {

/// Has malloc() return what is freed to the system, so that the memory of this process is what it uses. Before any
/// other thread is started.
void giveFreedMemoryBack();

/// Blocks SIGINT, SIGTERM and SIGHUP in this thread and all that it starts, so that waitForSignal() takes them; SIGPIPE
/// is ignored. Call it before any thread is started.
sigset_t blockSignals();

/// The next of `signals`; nothing when none came in `longest_s`, where that is given.
std::optional<int> waitForSignal(const sigset_t& signals, std::optional<double> longest_s = std::nullopt);

/// The built page: viewer/dist (as built) or share/hl/viewer (as installed) in a folder above the program.
std::string defaultPageFolder();

/// Where black boxes are kept unless set otherwise; empty where there is no place for them.
std::string defaultBlackBoxFolder();
/// What pages see of `server` and may do to it, but for recordings and files; it must outlive them.
ViewerFeedSettings pageOf(TouchServer& server, ReadShare share);

/// --black-box, over the default folder.
void addBlackBoxOption(CLI::App& command, RecorderSettings& recorder);

}  // namespace hl
