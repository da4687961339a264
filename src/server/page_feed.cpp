#include "server/page_feed.h"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <utility>

#include "base/clock.h"
#include "server/message_rate.h"

namespace hl {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

PageFeed::PageFeed(asio::io_context& context, double rate_Hz, FeedCallbacks callbacks, std::function<void()> beat,
                   const Limits& limits, Traffic& traffic)
    : context_(context),
      rate_Hz_(rate_Hz),
      callbacks_(std::move(callbacks)),
      beat_(std::move(beat)),
      limits_(limits),
      traffic_(traffic),
      timer_(context) {}

void PageFeed::start() { asio::co_spawn(context_, feed(), asio::detached); }

void PageFeed::stop() {
  stopped_ = true;
  timer_.cancel();
}

asio::awaitable<void> PageFeed::serve(ConnectionPointer connection, http::request<http::string_body> request) {
  auto page = std::make_shared<Page>(connection);
  page->stream.setTimeout(websocket::stream_base::timeout::suggested(beast::role_type::server));
  page->stream.setReadLimit(limits_.page_message_bytes);
  page->stream.setText(false);
  auto [refused] = co_await page->stream.accept(request);
  if (refused) co_return;
  pages_.insert(page);
  asio::co_spawn(context_, greet(page), asio::detached);
  co_await listen(page);
  pages_.erase(page);
}

asio::awaitable<void> PageFeed::greet(PagePointer page) {
  page->scene = callbacks_.scene();
  const bool greeted = co_await write(page, std::make_shared<const std::string>(callbacks_.hello()));
  page->busy = !greeted;
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
    callbacks_.receive(beast::buffers_to_string(buffer.data()));
  }
}

// The same state to every page that is ready for one.
asio::awaitable<void> PageFeed::feed() {
  const auto period = std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / rate_Hz_));
  while (!stopped_) {
    timer_.expires_after(period);
    co_await timer_.async_wait(kAwait);
    if (stopped_) co_return;
    if (beat_) beat_();
    const auto state = std::make_shared<const std::string>(callbacks_.state());
    for (const PagePointer& page : pages_) {
      if (page->busy) continue;
      page->busy = true;
      asio::co_spawn(context_, send(page, state), asio::detached);
    }
  }
}

// What the page lacks of the scene goes first; while it is on its way the page gets no states.
asio::awaitable<void> PageFeed::send(PagePointer page, std::shared_ptr<const std::string> state) {
  while (const auto message = page->scene()) {
    const bool sent = co_await write(page, message);
    if (!sent) co_return;
  }
  const bool sent = co_await write(page, state);
  page->busy = !sent;
}

asio::awaitable<bool> PageFeed::write(PagePointer page, std::shared_ptr<const std::string> message) {
  auto [error, bytes] = co_await page->stream.write(asio::buffer(*message));
  ++traffic_.messages_out;
  traffic_.bytes_out += bytes;
  co_return !error;
}

}  // namespace hl
