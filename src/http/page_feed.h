// PageFeed: the viewer pages. Each gets a greeting, the scene, and then the newest state at the feed's rate; nothing is
// queued: a page that reads slowly misses states.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <cstddef>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "http/connection.h"
#include "http/traffic.h"
#include "http/workers.h"
#include "page/feed_callbacks.h"
#include "session/limits.h"
#include "wire/websocket.h"

namespace hl {

/// In the context's thread.
class PageFeed {
 public:
  /// `callbacks` and `beat`, which is called before each state, run on the one thread of `worker`.
  PageFeed(boost::asio::io_context& context, Workers& worker, double rate_Hz, FeedCallbacks callbacks,
           std::function<void()> beat, const Limits& limits, Traffic& traffic);

  void start() { keepFeeding(); }
  /// Feeds again where that has ended for want of memory.
  void keepFeeding();
  void stop();  ///< no more states; the pages end with their connections
  bool full() const { return pages_.size() >= limits_.pages; }
  std::size_t pages() const { return pages_.size(); }

  /// Takes a connection that asks for a page's WebSocket, until it ends.
  boost::asio::awaitable<void> serve(ConnectionPointer connection,
                                     boost::beast::http::request<boost::beast::http::string_body> request);

 private:
  struct Page {
    Page(ConnectionPointer owner, PageNumber its_number)
        : connection(std::move(owner)), number(its_number), stream(connection->stream) {}
    ConnectionPointer connection;
    PageNumber number;
    Websocket stream;
    SceneSource scene;  // on the worker
    bool busy = true;   // a write is under way
  };
  using PagePointer = std::shared_ptr<Page>;
  class Membership;
  class Delivery;

  boost::asio::awaitable<void> feed();
  std::shared_ptr<const std::string> newestState();  // on the worker
  boost::asio::awaitable<void> greet(PagePointer page);
  boost::asio::awaitable<void> listen(PagePointer page);
  boost::asio::awaitable<void> send(PagePointer page, std::shared_ptr<const std::string> state);
  boost::asio::awaitable<bool> write(PagePointer page, std::shared_ptr<const std::string> message);

  boost::asio::io_context& context_;
  Workers& worker_;
  double rate_Hz_;
  FeedCallbacks callbacks_;
  std::function<void()> beat_;
  const Limits& limits_;
  Traffic& traffic_;
  boost::asio::steady_timer timer_;
  std::set<PagePointer> pages_;
  PageNumber last_page_ = 0;
  bool feeding_ = false, stopped_ = false;
};

}  // namespace hl
