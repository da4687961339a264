#include "dds/dds_node.h"

#include <ifaddrs.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "dds/dds_security.h"
#include "dds/loopback_only.h"
#include "dds/repeated_handshakes.h"

namespace hl {

namespace {

// Whether the machine has an address besides loopback, at which programs on it look for each other.
bool hasAddress() {
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return false;
  bool found = false;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    found |= one->ifa_addr != nullptr && one->ifa_addr->sa_family == AF_INET && (one->ifa_flags & IFF_UP) != 0 &&
             (one->ifa_flags & IFF_LOOPBACK) == 0;
  }
  freeifaddrs(all);
  return found;
}

std::string peersXml(const std::vector<std::string>& addresses) {
  std::string peers;
  for (const std::string& address : addresses) peers += "<Peer Address=\"" + address + "\"/>";
  return "<Peers>" + peers + "</Peers>";
}

// No packet of UDP is longer than a frame of Ethernet, with what DDS Security adds: of one that IP has split the whole
// is lost with a part of it. Many samples of many parts may be incomplete at once, as on a long line that loses some;
// none is longer than those of HL.
constexpr const char* kSizes =
    "<General><MaxMessageSize>1300B</MaxMessageSize><FragmentSize>1100B</FragmentSize></General><Internal>"
    "<MaxSampleSize>100kB</MaxSampleSize><DefragReliableMaxSamples>256</DefragReliableMaxSamples>"
    "<PrimaryReorderMaxSamples>1024</PrimaryReorderMaxSamples>"
    "<SecondaryReorderMaxSamples>1024</SecondaryReorderMaxSamples></Internal>";

// The program ends by SIGALRM after it.
constexpr unsigned kLongestEnd_s = 5;

// Whatever CYCLONEDDS_URI says. Participants are looked for each second, as the next one may come at any time, at so
// many ports of each peer.
std::string configuration(const std::string& interfaces, const char* multicast, const std::vector<std::string>& peers,
                          int ports, double lease_s) {
  return "<CycloneDDS><Domain Id=\"any\"><General><Interfaces>" + interfaces + "</Interfaces><AllowMulticast>" +
         multicast + "</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>" +
         "<MaxAutoParticipantIndex>" + std::to_string(ports - 1) + "</MaxAutoParticipantIndex>" + peersXml(peers) +
         "<LeaseDuration>" + std::to_string(lease_s) + "s</LeaseDuration>" +
         "<SPDPInterval>1s</SPDPInterval></Discovery>" + kSizes + "</Domain></CycloneDDS>";
}

// At the machine's own address, as other programs send it by default, and at that of those that are kept to this
// machine. Without multicast, which lo does not have.
std::string loopbackConfiguration(double lease_s) {
  const std::string own = hasAddress() ? R"(<NetworkInterface autodetermine="true" multicast="false"/>)" : "";
  return configuration(own + R"(<NetworkInterface address="127.0.0.1" multicast="false"/>)", "false", {"127.0.0.1"},
                       100, lease_s);
}

// Others are found by multicast, and at the addresses of peers; samples go to each by itself.
std::string networkConfiguration(const DdsReach& reach, double lease_s) {
  return configuration("<NetworkInterface name=\"" + reach.interface_name + "\"/>", "spdp", reach.peers, 32, lease_s);
}

// The first few: whoever sends what is no packet may send it for ever.
void reportLine(const char* program, std::string_view text) {
  constexpr int kMax = 20;
  static std::atomic<int> reported{0};
  const int number = ++reported;
  if (number > kMax) return;
  while (text.ends_with('\n')) text.remove_suffix(1);
  std::fprintf(stderr, "%s: Cyclone DDS: %.*s%s\n", program, static_cast<int>(text.size()), text.data(),
               number == kMax ? " (no more of its lines are told)" : "");
}

/// Until there is a participant: the first that Cyclone DDS says of why there is none. Several threads may say it.
struct StartLog {
  std::mutex mutex;
  std::string reason;
};

void hearStart(void* start_log, const dds_log_data_t* line) {
  StartLog& start = *static_cast<StartLog*>(start_log);
  const std::scoped_lock lock(start.mutex);
  if ((line->priority & (DDS_LC_FATAL | DDS_LC_ERROR)) == 0 || !start.reason.empty()) return;
  const std::string_view text(line->message, line->size);
  start.reason = text.substr(0, text.find('\n'));
}

}  // namespace

dds_entity_t made(dds_entity_t entity, const char* what) {
  if (entity < 0) throw Error(std::string("Cyclone DDS makes no ") + what + ": " + dds_strretcode(entity));
  return entity;
}

// Cyclone DDS says by its log alone that it could not read something: as a warning, one for each.
void DdsNode::hearLog(void* node, const dds_log_data_t* line) {
  const DdsNode& self = *static_cast<const DdsNode*>(node);
  const std::string_view text(line->message, line->size);
  if ((line->priority & (DDS_LC_FATAL | DDS_LC_ERROR)) != 0) {
    reportLine(self.program_, text);
  } else if (text.find("deserialization") != text.npos || text.find("malformed packet") != text.npos ||
             text.find("oversize") != text.npos) {
    self.report_malformed_();
  }
}

DdsNode::DdsNode(const DdsNodeSettings& settings, ReportMalformed report)
    : program_(settings.program), report_malformed_(std::move(report)) {
  const bool stays = settings.reach.interface_name == "lo";
  if (!stays) leaveLoopback();
  const Qos qos = emptyQos();
  if (!settings.reach.enclave.empty()) {
    addSecurity(*qos, readEnclave(settings.reach.enclave, settings.domain));
    repeatHandshakes();
  }
  const std::string xml =
      stays ? loopbackConfiguration(settings.lease_s) : networkConfiguration(settings.reach, settings.lease_s);
  StartLog start;
  dds_set_log_sink(&hearStart, &start);
  domain_ = dds_create_domain(settings.domain, xml.c_str());
  participant_ = domain_ < 0 ? domain_ : dds_create_participant(settings.domain, qos.get(), nullptr);
  dds_set_log_sink(&hearLog, this);
  try {
    if (participant_ < 0)
      throw Error("Cyclone DDS makes no participant: " +
                  (start.reason.empty() ? dds_strretcode(participant_) : start.reason));
    if (stays) requireLoopbackOnly();
  } catch (...) {
    end();
    throw;
  }
}

DdsNode::~DdsNode() { end(); }

// Cyclone DDS ends its threads by packets to itself, which do not come where the network has gone: it would wait for
// ever, and its program outlive its server.
void DdsNode::end() {
  alarm(kLongestEnd_s);
  if (domain_ > 0) dds_delete(domain_);
  alarm(0);
  dds_set_log_sink(nullptr, nullptr);
}

}  // namespace hl
