#include "http/page_feed.h"

#include <boost/asio/co_spawn.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <utility>

#include "base/clock.h"
#include "base/flag.h"
#include "base/guarded_thread.h"
#include "session/message_rate.h"

namespace hl {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

// Among the pages, until what listens to it has ended, however that came.
class PageFeed::Membership {
 public:
  Membership(PageFeed& feed, PagePointer page) : feed_(feed), page_(std::move(page)) { feed_.pages_.insert(page_); }
  ~Membership() {
    feed_.pages_.erase(page_);
    if (feed_.callbacks_.gone) guarded([this] { feed_.callbacks_.gone(page_->number); });
  }
  Membership(const Membership&) = delete;
  Membership& operator=(const Membership&) = delete;

 private:
  PageFeed& feed_;
  PagePointer page_;
};

// Messages on their way to a page. When they do not all arrive the page does not know what it lacks: it is closed, and
// will come again.
class PageFeed::Delivery {
 public:
  explicit Delivery(Page& page) : page_(page) { page_.busy = true; }
  ~Delivery() {
    page_.busy = !arrived_;
    if (!arrived_) page_.connection->stream.close();
  }
  Delivery(const Delivery&) = delete;
  Delivery& operator=(const Delivery&) = delete;
  void arrived() { arrived_ = true; }

 private:
  Page& page_;
  bool arrived_ = false;
};

PageFeed::PageFeed(asio::io_context& context, Workers& worker, double rate_Hz, FeedCallbacks callbacks,
                   std::function<void()> beat, const Limits& limits, Traffic& traffic)
    : context_(context),
      worker_(worker),
      rate_Hz_(rate_Hz),
      callbacks_(std::move(callbacks)),
      beat_(std::move(beat)),
      limits_(limits),
      traffic_(traffic),
      timer_(context) {}

void PageFeed::keepFeeding() {
  if (!feeding_ && !stopped_) asio::co_spawn(context_, feed(), reportEnd);
}

void PageFeed::stop() {
  stopped_ = true;
  timer_.cancel();
}

asio::awaitable<void> PageFeed::serve(ConnectionPointer connection, http::request<http::string_body> request) {
  auto page = std::make_shared<Page>(connection, ++last_page_);
  page->stream.setTimeout(websocket::stream_base::timeout::suggested(beast::role_type::server));
  page->stream.setReadLimit(limits_.page_message_bytes);
  page->stream.setText(false);
  auto [refused] = co_await page->stream.accept(request);
  if (refused) co_return;
  const Membership membership(*this, page);
  asio::co_spawn(context_, greet(page), reportEnd);
  co_await listen(page);
}

asio::awaitable<void> PageFeed::greet(PagePointer page) {
  Delivery delivery(*page);
  const auto hello = co_await doOn(worker_, [&] {
    page->scene = callbacks_.scene();
    return std::make_shared<const std::string>(callbacks_.hello());
  });
  const bool greeted = co_await write(page, hello);
  if (greeted) delivery.arrived();
}

// Reads until the page goes away, sends too fast or breaks the protocol.
asio::awaitable<void> PageFeed::listen(PagePointer page) {
  MessageRate rate(limits_.page_messages_Hz);
  while (true) {
    beast::flat_buffer buffer;
    auto [error, bytes] = co_await page->stream.read(buffer);
    if (error) {
      if (error == websocket::error::message_too_big) traffic_.refuse(RefusedBecause::kTooLarge);
      co_return;
    }
    ++traffic_.messages_in;
    traffic_.bytes_in += bytes;
    if (!rate.allow(monotonicNow_ns())) {
      traffic_.refuse(RefusedBecause::kTooFast);
      co_await page->stream.close({websocket::close_code::policy_error, "too many messages"});
      co_return;
    }
    co_await doOn(worker_, [&] {
      return guarded([&] { callbacks_.receive(page->number, beast::buffers_to_string(buffer.data())); });
    });
  }
}

// The same state to every page that is ready for one.
asio::awaitable<void> PageFeed::feed() {
  const auto period = std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / rate_Hz_));
  const Flag feeding(feeding_);
  while (!stopped_) {
    timer_.expires_after(period);
    co_await timer_.async_wait(kAwait);
    if (stopped_) co_return;
    const auto state = co_await doOn(worker_, [this] { return newestState(); });
    if (!state) continue;
    for (const PagePointer& page : pages_) {
      if (!page->busy) asio::co_spawn(context_, send(page, state), reportEnd);
    }
  }
}

// Null where there was no memory for it.
std::shared_ptr<const std::string> PageFeed::newestState() {
  std::shared_ptr<const std::string> state;
  guarded([&] {
    if (beat_) beat_();
    state = std::make_shared<const std::string>(callbacks_.state());
  });
  return state;
}

// What the page lacks of the scene goes first; while it is on its way the page gets no states.
asio::awaitable<void> PageFeed::send(PagePointer page, std::shared_ptr<const std::string> state) {
  Delivery delivery(*page);
  while (true) {
    const auto message = co_await doOn(worker_, [&] { return page->scene(); });
    if (!message) break;
    const bool sent = co_await write(page, message);
    if (!sent) co_return;
  }
  const bool sent = co_await write(page, state);
  if (sent) delivery.arrived();
}

asio::awaitable<bool> PageFeed::write(PagePointer page, std::shared_ptr<const std::string> message) {
  auto [error, bytes] = co_await page->stream.write(asio::buffer(*message));
  ++traffic_.messages_out;
  traffic_.bytes_out += bytes;
  co_return !error;
}

}  // namespace hl
