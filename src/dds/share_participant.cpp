#include "dds/share_participant.h"

#include <share.h>

#include <utility>

#include "base/guarded_thread.h"

namespace hl {

namespace {

// A server that has ended without a word is lost for those that wait for it.
constexpr double kLease_s = 4;
constexpr std::int64_t kLook_ns = 100'000'000;

}  // namespace

ShareParticipant::ShareParticipant(const ShareTask& task, Send send)
    : task_(task),
      send_(std::move(send)),
      node_({"hl-share", task.domain, task.reach, kLease_s}, [this] { ++malformed_; }),
      waitset_(made(dds_create_waitset(node_.participant()), "waitset")),
      readers_{makeReader(Lane::kStream), makeReader(Lane::kInbox), makeReader(Lane::kItems)},
      out_(node_.participant(), task) {}

ShareParticipant::~ShareParticipant() {
  running_ = false;
  if (thread_.joinable()) thread_.join();
}

void ShareParticipant::start() {
  running_ = true;
  thread_ = startThread("take", [this] { run(); });
}

ShareParticipant::Reader ShareParticipant::makeReader(Lane lane) const {
  const dds_entity_t reader = makeShareReader(node_.participant(), task_, lane);
  const dds_entity_t condition = made(dds_create_readcondition(reader, DDS_ANY_STATE), "condition");
  made(dds_waitset_attach(waitset_, condition, 0), "condition of the waitset");
  return {lane, reader};
}

// One of each lane by turns: many items do not hold up the stream.
void ShareParticipant::run() {
  while (running_) {
    dds_waitset_wait(waitset_, nullptr, 0, kLook_ns);
    for (bool more = true; more && running_;) {
      more = false;
      for (const Reader& reader : readers_) more |= takeOne(reader);
    }
    for (std::uint64_t left = malformed_.exchange(0); left > 0 && running_; --left) send_({});
  }
}

// False: there is none.
bool ShareParticipant::takeOne(const Reader& reader) const {
  void* samples[1] = {nullptr};
  dds_sample_info_t infos[1];
  if (dds_take(reader.entity, samples, infos, 1, 1) <= 0) return false;
  const auto& packet = *static_cast<const hl_share_Packet*>(samples[0]);
  if (infos[0].valid_data && packet.bytes._length <= kMaxPacket_bytes) {
    const char* const bytes = reinterpret_cast<const char*>(packet.bytes._buffer);
    send_({reader.lane, packet.key, std::string(bytes, packet.bytes._length)});
  } else if (infos[0].valid_data) {
    send_({});
  }
  dds_return_loan(reader.entity, samples, 1);
  return true;
}

}  // namespace hl
