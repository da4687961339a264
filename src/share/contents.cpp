#include "share/contents.h"

#include <algorithm>
#include <utility>

#include "io/sha256.h"

namespace hl {

namespace {

// Of one server, which asks for no more than a window: more is no request of HL.
constexpr std::size_t kMaxAnswers = 256;

}  // namespace

ContentName nameOf(std::string_view content) {
  Sha256 sha256;
  sha256.add(content);
  const Digest256 digest = sha256.end();
  return {std::string(digest.begin(), digest.end()), content.size()};
}

Content Contents::find(const ContentName& name) const {
  const auto found = here_.find(name.sha256);
  return found == here_.end() || found->second->size() != name.bytes ? nullptr : found->second;
}

std::uint64_t Contents::used_bytes() const {
  std::uint64_t bytes = 0;
  for (const auto& [_, content] : here_) bytes += content->size();
  for (const auto& [_, fetch] : fetches_) bytes += fetch.bytes;
  return bytes;
}

bool Contents::want(const ContentName& name, const std::vector<ServerId>& from, std::int64_t now_ns) {
  const auto under_way = fetches_.find(name.sha256);
  if (under_way != fetches_.end()) {
    under_way->second.from = from;
    return true;
  }
  if (name.bytes == 0 || name.bytes > kMax_bytes || used_bytes() + name.bytes > kMax_bytes) return false;
  Fetch& fetch = fetches_[name.sha256];
  fetch.bytes = name.bytes;
  fetch.from = from;
  fetch.heard_ns = now_ns;
  return true;
}

void Contents::keepOnly(const std::function<bool(const std::string& sha256)>& wanted) {
  // Others hold them still: without it here they take as much memory.
  std::erase_if(here_, [&](const auto& entry) { return entry.second.use_count() == 1 && !wanted(entry.first); });
  std::erase_if(fetches_, [&](const auto& entry) { return !wanted(entry.first); });
}

void Contents::hear(const proto::ShareRequest& request) {
  if (answers_.size() >= kMaxAnswers || request.count() > kWindow || request.first() > kMax_bytes) return;
  answers_.push_back({request.from(), request.sha256(), request.first(), request.first() + request.count()});
}

void Contents::hear(const proto::SharePart& part, std::int64_t now_ns) {
  const auto found = fetches_.find(part.sha256());
  if (found == fetches_.end()) return;
  Fetch& fetch = found->second;
  const bool asked_of = fetch.source < fetch.from.size() && fetch.from[fetch.source] == part.from();
  if (!asked_of || part.number() * kPart_bytes != fetch.so_far.size()) return;
  const std::uint64_t expected = std::min<std::uint64_t>(kPart_bytes, fetch.bytes - fetch.so_far.size());
  if (part.data().size() != expected) {
    fetch.heard_ns = now_ns - kPatience_ns;  // it has none: the next one is asked
    return;
  }
  fetch.so_far += part.data();
  fetch.heard_ns = now_ns;
  fetched_bytes_ += expected;
  if (fetch.so_far.size() < fetch.bytes) return;
  if (nameOf(fetch.so_far).sha256 == part.sha256()) {
    here_[part.sha256()] = std::make_shared<const std::string>(std::move(fetch.so_far));
    fetches_.erase(found);
  } else {
    fetch.so_far.clear();
    fetch.heard_ns = now_ns - kPatience_ns;
  }
}

// One part; whether more are left and the line takes more.
bool Contents::answerOne(Answer& answer) {
  const auto found = here_.find(answer.sha256);
  const std::uint64_t first = answer.next * kPart_bytes;
  proto::ShareMessage message;
  proto::SharePart& part = *message.mutable_part();
  part.set_from(self_);
  part.set_sha256(answer.sha256);
  part.set_number(answer.next);
  if (found != here_.end() && first < found->second->size()) part.set_data(found->second->substr(first, kPart_bytes));
  if (!send_(answer.to, message)) return false;
  answer.next = part.data().empty() ? answer.end : answer.next + 1;
  return answer.next < answer.end;
}

void Contents::ask(const std::string& sha256, Fetch& fetch, std::int64_t now_ns) {
  if (fetch.from.empty()) return;
  if (now_ns - fetch.heard_ns >= kPatience_ns) {
    fetch.source = (fetch.source + 1) % fetch.from.size();
    fetch.asked = fetch.so_far.size() / kPart_bytes;
    fetch.heard_ns = now_ns;
  }
  fetch.source %= fetch.from.size();
  const std::uint64_t here = fetch.so_far.size() / kPart_bytes;
  const std::uint64_t until = std::min(fetch.parts(), here + kWindow);
  // In halves of a window: a request for each part would be a packet for each part.
  if (fetch.asked >= until || (until - fetch.asked < kWindow / 2 && until < fetch.parts())) return;
  proto::ShareMessage message;
  proto::ShareRequest& request = *message.mutable_request();
  request.set_from(self_);
  request.set_sha256(sha256);
  request.set_first(fetch.asked);
  request.set_count(until - fetch.asked);
  if (send_(fetch.from[fetch.source], message)) fetch.asked = until;
}

void Contents::step(std::int64_t now_ns) {
  for (auto& [sha256, fetch] : fetches_) ask(sha256, fetch, now_ns);
  for (Answer& answer : answers_) {
    while (answerOne(answer)) {
    }
  }
  std::erase_if(answers_, [](const Answer& answer) { return answer.next >= answer.end; });
}

}  // namespace hl
