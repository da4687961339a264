// Messages of pages: what the settings then are, and what every page is sent of it.
#include "page/viewer_feed.h"
#include "refusal.h"

namespace {

using namespace hl;

void requireBounded(const TouchSession& session) {
  const double stiffness_N_m = session.live().stiffness_N_m();
  fuzz::require(stiffness_N_m >= 0 && stiffness_N_m <= session.deviceInfo().stiffness_max_N_m);
  const MaterialOverride surfaces = session.live().surfaces();
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const std::optional<double>& value = surfaces.number(i);
    fuzz::require(!value || (*value >= 0 && *value <= kQuantityInfo[i].most_set));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static TouchSession session(makeSnapshot(std::vector<Instance>{}, "nothing"), {});
  static const FeedCallbacks feed = makeViewerFeed(session, "fuzzer");
  feed.receive(PageNumber{1}, fuzz::textOf(data, size));
  requireBounded(session);
  feed.gone(PageNumber{1});
  fuzz::require(!feed.hello().empty() && !feed.state().empty());
  return 0;
}
