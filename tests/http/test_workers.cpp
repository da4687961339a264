// Work on other threads, for coroutines of the server's own.
#include "http/workers.h"

#include <gtest/gtest.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/post.hpp>
#include <future>
#include <stdexcept>

namespace hl::test_workers {
namespace {

namespace asio = boost::asio;

struct Failed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

TEST(Workers, BringBackTheResultOrWhatIsThrown) {
  asio::io_context context;
  Workers workers("worker", 2);
  int result = 0;
  bool thrown = false;
  const auto ask = [&]() -> asio::awaitable<void> {
    result = co_await doOn(workers, [] { return 42; });
    try {
      co_await doOn(workers, []() -> int { throw Failed("as asked"); });
    } catch (const Failed&) {
      thrown = true;
    }
  };
  asio::co_spawn(context, ask(), reportEnd);
  context.run();
  EXPECT_EQ(result, 42);
  EXPECT_TRUE(thrown);
}

// What stands beside the work fails while the worker is at it and has more to do: nothing that the worker does later
// may reach for what has gone with the coroutine. AddressSanitizer would see it.
TEST(Workers, WhatFailsBesideTheirWorkLeavesNothingBehind) {
  using namespace asio::experimental::awaitable_operators;
  asio::io_context context;
  Workers workers("worker", 1);
  std::promise<void> begun, all_gone;
  const auto works = [&]() -> asio::awaitable<void> {
    co_await doOn(workers, [&] {
      begun.set_value();
      return 0;
    });
  };
  const auto worker_turns = [&] {
    std::promise<void> turned;
    asio::post(workers.executor(), [&] { turned.set_value(); });
    turned.get_future().wait();
  };
  const auto fails = [&]() -> asio::awaitable<void> {
    co_await asio::post(asio::use_awaitable);
    begun.get_future().wait();
    worker_turns();
    worker_turns();  // now the result waits for this thread
    asio::post(workers.executor(), [&] { all_gone.get_future().wait(); });
    throw Failed("as asked");
  };
  const auto both = [&]() -> asio::awaitable<void> { co_await (works() && fails()); };
  std::exception_ptr ended;
  asio::co_spawn(context, both(), [&](std::exception_ptr thrown) { ended = thrown; });
  context.run();
  all_gone.set_value();
  workers.join();
  EXPECT_THROW(std::rethrow_exception(ended), Failed);
}

}  // namespace
}  // namespace hl::test_workers
