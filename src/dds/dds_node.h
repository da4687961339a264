// DdsNode: a participant of Cyclone DDS that stays on this machine, or that DDS Security guards. In programs of HL that
// speak DDS only, one in each.
#pragma once

#include <dds/dds.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "ros/dds_reach.h"

namespace hl {

struct DdsNodeSettings {
  const char* program;  ///< its name, for what it says
  std::uint32_t domain = 0;
  DdsReach reach{};
  double lease_s = 10;  ///< others take it for lost when it has been silent for so long
};

class DdsNode {
 public:
  /// Called by threads of Cyclone DDS for what is no packet or sample, or a too long one; it may throw nothing.
  using ReportMalformed = std::function<void()>;

  /// Throws hl::Error when there is no room for a participant in this domain, or its keys do not fit.
  DdsNode(const DdsNodeSettings& settings, ReportMalformed report);
  /// All that it has made, and its listeners, end with it.
  ~DdsNode();
  DdsNode(const DdsNode&) = delete;
  DdsNode& operator=(const DdsNode&) = delete;

  dds_entity_t participant() const { return participant_; }

 private:
  void end();
  static void hearLog(void* node, const dds_log_data_t* line);

  const char* const program_;
  const ReportMalformed report_malformed_;
  dds_entity_t domain_ = 0, participant_ = 0;
};

/// Throws hl::Error, which says `what` it was to be, in the place of an error of Cyclone DDS.
dds_entity_t made(dds_entity_t entity, const char* what);

using Qos = std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)>;
inline Qos emptyQos() { return {dds_create_qos(), dds_delete_qos}; }

}  // namespace hl
