#include "dds/share_participant.h"

#include <share.h>

#include <array>
#include <utility>

#include "base/guarded_thread.h"

namespace hl {

namespace {

// A server that has ended without a word is lost for those that wait for it.
constexpr double kLease_s = 4;
constexpr std::int64_t kLook_ns = 100'000'000;
constexpr std::array kLanes{Lane::kItems, Lane::kInbox, Lane::kStream};

}  // namespace

ShareParticipant::ShareParticipant(const ShareTask& task, Tell tell)
    : task_(task),
      tell_(std::move(tell)),
      node_({"hl-share", task.domain, task.reach, kLease_s}, [] {}),
      out_(node_.participant(), task),
      thread_(startThread("take", [this] { run(); })) {}

ShareParticipant::~ShareParticipant() {
  running_ = false;
  thread_.join();
}

void ShareParticipant::run() {
  const dds_entity_t waitset = made(dds_create_waitset(node_.participant()), "waitset");
  std::array<dds_entity_t, kLanes.size()> readers;
  for (std::size_t i = 0; i < kLanes.size(); ++i) {
    readers[i] = makeShareReader(node_.participant(), task_, kLanes[i]);
    const dds_entity_t condition = made(dds_create_readcondition(readers[i], DDS_ANY_STATE), "condition");
    made(dds_waitset_attach(waitset, condition, 0), "condition of the waitset");
  }
  while (running_) {
    dds_waitset_wait(waitset, nullptr, 0, kLook_ns);
    for (std::size_t i = 0; i < kLanes.size(); ++i) take(kLanes[i], readers[i]);
  }
}

void ShareParticipant::take(Lane lane, dds_entity_t reader) const {
  void* samples[1] = {nullptr};
  dds_sample_info_t infos[1];
  while (running_ && dds_take(reader, samples, infos, 1, 1) > 0) {
    const auto& packet = *static_cast<const hl_share_Packet*>(samples[0]);
    if (infos[0].valid_data && packet.bytes._length <= kMostPacket_bytes) {
      const char* const bytes = reinterpret_cast<const char*>(packet.bytes._buffer);
      tell_({lane, packet.key, std::string(bytes, packet.bytes._length)});
    }
    dds_return_loan(reader, samples, 1);
  }
}

}  // namespace hl
