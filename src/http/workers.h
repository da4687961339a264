// Workers: threads that do what the server's thread asks of them, so that it only moves bytes.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/bind_cancellation_slot.hpp>
#include <boost/asio/cancellation_signal.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <exception>
#include <thread>
#include <type_traits>
#include <vector>

#include "base/guarded_thread.h"

namespace hl {

/// Made and joined by one thread.
class Workers {
 public:
  using Executor = boost::asio::io_context::executor_type;

  /// `name`: of each thread.
  Workers(const char* name, unsigned threads) {
    for (unsigned i = 0; i < threads; ++i) threads_.push_back(startThread(name, [this] { context_.run(); }));
  }
  ~Workers() { join(); }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  Executor executor() { return context_.get_executor(); }
  /// When nobody gives them work any more: what they have is done.
  void join() {
    work_.reset();
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }

 private:
  boost::asio::io_context context_;
  boost::asio::executor_work_guard<Executor> work_{context_.get_executor()};
  std::vector<std::thread> threads_;
};

/// How a coroutine that nobody waits for ends: what it threw is counted and reported.
inline void reportEnd(std::exception_ptr thrown) {
  if (thrown) guarded([&] { std::rethrow_exception(thrown); });
}

/// Does `work` there and comes back with its result, or with what it throws. It cannot be cancelled: Boost 1.81 keeps a
/// bare pointer to what is cancelled while it asks the worker, and by then that may be gone.
template <typename Work>
boost::asio::awaitable<std::invoke_result_t<Work>> doOn(Workers& workers, Work work) {
  using Result = std::invoke_result_t<Work>;
  co_return co_await boost::asio::co_spawn(
      workers.executor(), [&work]() -> boost::asio::awaitable<Result> { co_return work(); },
      boost::asio::bind_cancellation_slot(boost::asio::cancellation_slot(), boost::asio::use_awaitable));
}

}  // namespace hl
