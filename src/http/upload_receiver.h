// UploadReceiver: takes in the file that a page sends by POST /upload, into a temporary file, and has it opened. One at
// a time; what is refused changes nothing.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <memory>
#include <optional>
#include <string>

#include "http/connection.h"
#include "http/http_answers.h"
#include "http/temporary_file.h"
#include "http/traffic.h"
#include "http/upload_request.h"
#include "http/upload_settings.h"
#include "http/workers.h"

namespace hl {

using HeadParser = boost::beast::http::request_parser<boost::beast::http::empty_body>;

/// All in the context's thread; what is opened is so by a thread of its own.
class UploadReceiver {
 public:
  /// `answers` and `traffic` outlive it.
  UploadReceiver(boost::asio::io_context& context, const UploadSettings& settings, const HttpAnswers& answers,
                 Traffic& traffic);

  /// The request whose head has been read, to its answer. Whether the connection may go on to the next one.
  boost::asio::awaitable<bool> serve(ConnectionPointer connection, boost::beast::flat_buffer& buffer,
                                     HeadParser& parser);
  void join() { worker_.join(); }  ///< when the context runs no more

 private:
  struct Body;
  class TimeLimit;

  boost::asio::awaitable<HttpResponse> take(ConnectionPointer connection, Body& body, const HttpRequest& head);
  boost::asio::awaitable<std::optional<UploadRefusal>> receive(ConnectionPointer connection, Body& body,
                                                               TemporaryFile& file);
  HttpResponse refuse(const HttpRequest& head, const std::string& peer, const UploadRefusal& refusal);

  boost::asio::io_context& context_;
  const UploadSettings settings_;
  const HttpAnswers& answers_;
  Traffic& traffic_;
  Workers worker_;
  bool busy_ = false;
};

}  // namespace hl
