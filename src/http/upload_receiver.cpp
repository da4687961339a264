#include "http/upload_receiver.h"

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <chrono>
#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/flag.h"
#include "base/utf8.h"
#include "monitor/event_log.h"

namespace hl {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

namespace {

constexpr std::size_t kUploadPiece_bytes = std::size_t{64} * 1024;
constexpr double kFarewell_s = 2;                              // for a refused sender to read why
constexpr std::size_t kFarewell_bytes = std::size_t{8} << 20;  // of what it has sent meanwhile

std::chrono::milliseconds milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * seconds));
}

}  // namespace

/// A request's body on its way in.
struct UploadReceiver::Body {
  beast::flat_buffer& buffer;
  http::request_parser<http::buffer_body> parser;
  bool waits;  // for the word to go on
};

/// Ends what the connection waits for when its time is over, and leaves the connection open, so that it gets an answer.
class UploadReceiver::TimeLimit {
 public:
  TimeLimit(asio::io_context& context, ConnectionPointer connection, std::chrono::milliseconds time)
      : timer_(context, time) {
    timer_.async_wait(
        [over = over_, done = done_, connection = std::move(connection)](boost::system::error_code error) {
          if (error || *done) return;
          *over = true;
          connection->stream.tcp().cancel();
        });
  }
  ~TimeLimit() { *done_ = true; }
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;
  bool over() const { return *over_; }

 private:
  const std::shared_ptr<bool> over_ = std::make_shared<bool>(false), done_ = std::make_shared<bool>(false);
  asio::steady_timer timer_;  // goes with this object, and its wait with it
};

UploadReceiver::UploadReceiver(asio::io_context& context, const UploadSettings& settings, const HttpAnswers& answers,
                               Traffic& traffic)
    : context_(context),
      settings_(settings),
      answers_(answers),
      traffic_(traffic),
      worker_("upload", settings.limit_bytes > 0 ? 1 : 0) {}

HttpResponse UploadReceiver::refuse(const HttpRequest& head, const std::string& peer, const UploadRefusal& refusal) {
  traffic_.count(refusal.result);
  if (refusal.result == UploadResult::kDenied) traffic_.refuse(RefusedBecause::kAccess);
  const char* const result = kUploadResultNames[static_cast<std::size_t>(refusal.result)];
  logEvent(LogLevel::kWarning, "upload_refused", {{"peer", peer}, {"result", result}, {"reason", refusal.text}});
  HttpResponse response = HttpAnswers::refuse(head, refusal.status, refusal.text);
  response.keep_alive(false);  // part of the file may still be on its way
  return response;
}

asio::awaitable<bool> UploadReceiver::serve(ConnectionPointer connection, beast::flat_buffer& buffer,
                                            HeadParser& parser) {
  const HttpRequest head(parser.get().base());
  const BodyLength length{
      parser.content_length() ? std::optional<std::uint64_t>(*parser.content_length()) : std::optional<std::uint64_t>(),
      parser.chunked()};
  connection->stream.tcp().expires_never();
  std::optional<UploadRefusal> refusal = refusalOf(head, length, answers_, settings_.limit_bytes);
  if (!refusal && busy_)
    refusal = UploadRefusal{http::status::conflict, UploadResult::kBusy,
                            "busy with another file: send this one again when it is done"};
  Body body{buffer, http::request_parser<http::buffer_body>(std::move(parser)),
            head[http::field::expect] == "100-continue"};
  HttpResponse response;
  if (refusal) {
    response = refuse(head, connection->peer, *refusal);
  } else {
    response = co_await take(connection, body, head);
  }
  const TimeLimit limit(context_, connection, milliseconds(kFarewell_s));
  auto [failed, sent] = co_await http::async_write(connection->stream, response, kAwait);
  if (failed || response.keep_alive()) co_return !failed;
  // A socket that is closed with unread bytes in it takes back what it has said.
  boost::system::error_code ignored;
  connection->stream.tcp().socket().shutdown(asio::socket_base::shutdown_send, ignored);
  std::vector<char> rest(kUploadPiece_bytes);
  for (std::size_t left = kFarewell_bytes; left > rest.size() && !limit.over();) {
    auto [error, got] = co_await connection->stream.tcp().async_read_some(asio::buffer(rest), kAwait);
    if (error) break;
    left -= got;
  }
  co_return false;
}

asio::awaitable<HttpResponse> UploadReceiver::take(ConnectionPointer connection, Body& body, const HttpRequest& head) {
  const Flag busy(busy_);
  const std::string name = uploadName(viewOf(head.target()));
  std::optional<UploadRefusal> refusal;
  std::string answer;
  std::exception_ptr thrown;
  try {
    TemporaryFile file;
    refusal = co_await receive(connection, body, file);
    if (!refusal) answer = co_await doOn(worker_, [&] { return settings_.open(file.descriptor(), name); });
  } catch (const Error& error) {
    refusal = UploadRefusal{http::status::unprocessable_entity, UploadResult::kUnreadable, printable(error.what())};
  } catch (const std::bad_alloc&) {
    refusal = UploadRefusal{http::status::insufficient_storage, UploadResult::kFailed,
                            "the server has no memory for this file"};
  }
  if (refusal) co_return refuse(head, connection->peer, *refusal);
  traffic_.count(UploadResult::kOpened);
  logEvent(LogLevel::kInfo, "upload_opened", {{"peer", connection->peer}, {"name", name}});
  co_return HttpAnswers::reply(head, http::status::ok, "application/json", std::move(answer));
}

asio::awaitable<std::optional<UploadRefusal>> UploadReceiver::receive(ConnectionPointer connection, Body& body,
                                                                      TemporaryFile& file) {
  const auto begin = std::chrono::steady_clock::now();
  const auto end = begin + milliseconds(settings_.whole_s);
  if (body.waits) {
    http::response<http::empty_body> go_on(http::status::continue_, 11);
    co_await http::async_write(connection->stream, go_on, kAwait);
  }
  std::vector<char> piece(kUploadPiece_bytes);
  std::uint64_t bytes = 0;
  body.parser.body_limit(settings_.limit_bytes);
  while (!body.parser.is_done()) {
    body.parser.get().body() = {piece.data(), piece.size(), true};
    const TimeLimit limit(context_, connection, milliseconds(settings_.silence_s));
    auto [error, got] = co_await http::async_read(connection->stream, body.buffer, body.parser, kAwait);
    const std::size_t size = piece.size() - body.parser.get().body().size;
    bytes += size;
    traffic_.upload_bytes += size;
    if (limit.over() || std::chrono::steady_clock::now() > end)
      co_return UploadRefusal{http::status::request_timeout, UploadResult::kSlow,
                              "the file comes too slowly: 64 KiB are to come within some seconds"};
    if (error == http::error::body_limit || bytes > settings_.limit_bytes) co_return tooLarge(settings_.limit_bytes);
    if (error && error != http::error::need_buffer)
      co_return UploadRefusal{http::status::bad_request, UploadResult::kCut, "the file was cut on its way"};
    co_await doOn(worker_, [&] { file.write(piece.data(), size); });
  }
  if (bytes == 0) co_return UploadRefusal{http::status::bad_request, UploadResult::kMalformed, "the file is empty"};
  co_return std::optional<UploadRefusal>();
}

}  // namespace hl
