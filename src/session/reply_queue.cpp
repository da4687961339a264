#include "session/reply_queue.h"

#include "base/error.h"

namespace hl {

namespace {

constexpr std::size_t kMaxReplies = 4096;  // that a client has not read: it does not read at all
constexpr std::size_t kReply_bytes = 64;   // for each that waits besides its message

}  // namespace

ReplyQueue::Waiting ReplyQueue::counted(proto::ServerReply reply) const {
  MemoryShare memory(memory_);
  memory.take(kReply_bytes + bytesOfMessage(reply.SpaceUsedLong()));
  return {std::move(reply), std::move(memory)};
}

void ReplyQueue::add(Waiting waiting) {
  waiting_.push_back(std::move(waiting));
  if (waiting_.size() > kMaxReplies && end_.empty()) end_ = "the client does not read what it is told";
}

void ReplyQueue::push(proto::ServerReply reply) {
  try {
    Waiting waiting = counted(std::move(reply));
    const std::lock_guard lock(mutex_);
    add(std::move(waiting));
  } catch (const Error& error) {
    return end(error.what());
  }
  wake_();
}

void ReplyQueue::pushProgress(std::uint64_t frame, double built) {
  proto::ServerReply reply;
  reply.mutable_progress()->set_frame(frame);
  reply.mutable_progress()->set_built(built);
  try {
    const std::lock_guard lock(mutex_);
    if (!waiting_.empty() && waiting_.back().reply.has_progress()) {
      waiting_.back().reply = std::move(reply);
    } else if (built < 1) {
      add(counted(std::move(reply)));
    } else {
      return;
    }
  } catch (const Error&) {
    return;
  }
  wake_();
}

bool ReplyQueue::take(proto::ServerReply& reply) {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty()) return false;
  reply = std::move(waiting_.front().reply);
  waiting_.pop_front();
  return true;
}

void ReplyQueue::end(const std::string& why) {
  {
    const std::lock_guard lock(mutex_);
    if (end_.empty()) end_ = why;
  }
  wake_();
}

std::string ReplyQueue::end() const {
  const std::lock_guard lock(mutex_);
  return end_;
}

}  // namespace hl
