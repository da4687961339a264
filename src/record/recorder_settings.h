// Recorder settings: what is recorded of a session, and where to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "record/page_recordings.h"

namespace hl {

struct RecorderSettings {
  std::string file;                          ///< of the session; empty: it is not recorded
  bool several = false;                      ///< devices: each has a file of its own, see recordingOf()
  std::uint64_t most_bytes = 4'000'000'000;  ///< of that file; then the recording ends, not the session
  std::shared_ptr<PageRecordings> pages;     ///< what pages ask for, of the first device; null: they cannot
  std::string black_box_folder;              ///< made when needed; empty: no black boxes
  std::size_t black_boxes = 20;              ///< kept there, >= 1; the oldest go
  std::string version;                       ///< of HL, for the files
  /// Gets the name of the device and a line when a file is written or can not be; or empty.
  std::function<void(const std::string& device, const std::string& line)> report;
  /// Called when a recording of the session ends before it, and not by most_bytes: the disk is full; or empty.
  std::function<void()> lost;
};

/// The file of one device of several: session.hlr becomes session-left.hlr.
std::string recordingOf(const std::string& file, const std::string& device);

}  // namespace hl
