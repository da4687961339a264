// Files that pages send, over real sockets: what is taken and what is refused, each in one line, with nothing left
// behind.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <boost/asio/write.hpp>
#include <filesystem>
#include <fstream>
#include <future>
#include <mutex>
#include <string>
#include <vector>

#include "base/error.h"
#include "fake_pages.h"
#include "http/http_server.h"
#include "http/upload_request.h"
#include "plain_client.h"
#include "wait_for.h"

namespace hl::test_upload {
namespace {

namespace fs = std::filesystem;
namespace beast = boost::beast;
namespace http = beast::http;
using boost::asio::ip::tcp;

constexpr std::uint64_t kLimit_bytes = 300'000;
constexpr const char* kToken = "correct-horse-battery";

struct Answer {
  unsigned status = 0;  // 0: the connection ended without one
  std::string text;
};

std::string contentOf(int descriptor) {
  std::string content;
  char piece[4096];
  for (off_t at = 0;;) {
    const ssize_t got = pread(descriptor, piece, sizeof piece, at);
    if (got <= 0) return content;
    content.append(piece, static_cast<std::size_t>(got));
    at += got;
  }
}

/// Files of this process that have no name any more.
std::ptrdiff_t namelessFiles() {
  std::ptrdiff_t count = 0;
  for (const auto& entry : fs::directory_iterator("/proc/self/fd")) {
    std::error_code error;
    const std::string target = fs::read_symlink(entry.path(), error).string();
    count += target.starts_with(fs::temp_directory_path().string()) && target.ends_with("(deleted)") ? 1 : 0;
  }
  return count;
}

class Upload : public testing::Test {
 protected:
  struct Opened {
    std::string name, content;
    unsigned mode = 0;
  };

  HttpServerSettings settings(std::uint64_t limit_bytes = kLimit_bytes, const std::string& token = "") {
    HttpServerSettings out;
    out.port = 0;
    out.page_folder = "/nonexistent";
    out.token = token;
    out.upload.limit_bytes = limit_bytes;
    out.upload.open = [this](int descriptor, const std::string& name) { return open(descriptor, name); };
    return out;
  }
  std::string open(int descriptor, const std::string& name) {
    struct stat status {};
    fstat(descriptor, &status);
    opened_.push_back({name, contentOf(descriptor), status.st_mode & 0777U});
    inside_ = true;
    while (hold_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (name == "bad.obj") throw Error("bad.obj: is no good");
    return "{}";
  }

  std::string headOf(const std::string& target, const std::string& rest) const {
    return "POST " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server_->port()) + "\r\n" + rest +
           "\r\n";
  }
  tcp::socket connect() {
    tcp::socket socket(context_);
    socket.connect({boost::asio::ip::address_v4::loopback(), server_->port()});
    return socket;
  }
  static Answer answerOf(tcp::socket& socket) {
    beast::flat_buffer buffer;
    http::response<http::string_body> response;
    beast::error_code error;
    http::read(socket, buffer, response, error);
    return error ? Answer{} : Answer{response.result_int(), response.body()};
  }
  Answer send(const std::string& target, const std::string& body, const std::string& rest = "") {
    tcp::socket socket = connect();
    beast::error_code ignored;  // of a server that has refused already
    boost::asio::write(
        socket,
        boost::asio::buffer(headOf(target, rest + "Content-Length: " + std::to_string(body.size()) + "\r\n") + body),
        ignored);
    return answerOf(socket);
  }
  std::string metrics() const { return test::request(server_->port(), "/metrics").body(); }
  bool counted(const std::string& result, int times = 1) const {
    return metrics().find("hl_uploads_total{result=\"" + result + "\"} " + std::to_string(times) + "\n") !=
           std::string::npos;
  }
  void start(const HttpServerSettings& settings) {
    server_ = std::make_unique<HttpServer>(settings, test::fakePages());
    server_->start();
  }
  void expectRefused(const Answer& answer, unsigned status, const std::string& words) {
    EXPECT_EQ(answer.status, status) << words;
    EXPECT_NE(answer.text.find(words), std::string::npos) << answer.text;
    EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
  }

  boost::asio::io_context context_;
  std::vector<Opened> opened_;
  std::atomic<bool> hold_{false}, inside_{false};
  std::unique_ptr<HttpServer> server_;
};

TEST_F(Upload, ComesWholeIntoAFileThatOnlyItsUserMayOpenAndThatIsGoneAfterwards) {
  start(settings());
  std::string content(kLimit_bytes, 'x');
  for (std::size_t i = 0; i < content.size(); ++i) content[i] = static_cast<char>(i * 7 % 251);
  const Answer answer = send("/upload?name=a%20b.obj", content);
  EXPECT_EQ(answer.status, 200u) << answer.text;
  EXPECT_EQ(answer.text, "{}");
  ASSERT_EQ(opened_.size(), 1u);
  EXPECT_EQ(opened_[0].name, "a b.obj");
  EXPECT_EQ(opened_[0].mode, 0600u);
  EXPECT_EQ(opened_[0].content, content);
  EXPECT_EQ(namelessFiles(), 0);
  EXPECT_TRUE(counted("opened"));
  EXPECT_NE(metrics().find("hl_upload_bytes_total 300000\n"), std::string::npos);
}

TEST_F(Upload, ComesInChunksAndAfterTheWordToGoOn) {
  start(settings());
  tcp::socket socket = connect();
  boost::asio::write(socket, boost::asio::buffer(headOf("/upload?name=a.obj",
                                                        "Expect: 100-continue\r\nTransfer-Encoding: chunked\r\n")));
  beast::flat_buffer buffer;
  http::response_parser<http::empty_body> go_on;
  http::read_header(socket, buffer, go_on);
  EXPECT_EQ(go_on.get().result(), http::status::continue_);
  boost::asio::write(socket, boost::asio::buffer(std::string("3\r\nabc\r\n2\r\nde\r\n0\r\n\r\n")));
  EXPECT_EQ(answerOf(socket).status, 200u);
  ASSERT_EQ(opened_.size(), 1u);
  EXPECT_EQ(opened_[0].content, "abcde");
}

TEST_F(Upload, KeepsTheConnectionForTheNextRequest) {
  start(settings());
  tcp::socket socket = connect();
  for (int i = 0; i < 2; ++i) {
    boost::asio::write(socket, boost::asio::buffer(headOf("/upload?name=a.obj", "Content-Length: 1\r\n") + "x"));
    EXPECT_EQ(answerOf(socket).status, 200u);
  }
}

TEST_F(Upload, IsRefusedBeforeItComes) {
  start(settings());
  const std::string origin = "Origin: http://127.0.0.1:" + std::to_string(server_->port()) + "\r\n";
  EXPECT_EQ(send("/upload?name=a.obj", "x", origin).status, 200u);
  opened_.clear();
  expectRefused(send("/upload?name=a.obj", "x", "Origin: http://evil.example\r\n"), 403, "only this server's own page");
  expectRefused(send("/upload?name=a.obj", "x", "Origin: null\r\n"), 403, "only this server's own page");
  expectRefused(send("/upload?name=a.obj", ""), 400, "empty");
  expectRefused(send("/upload", "x"), 400, "no name");
  expectRefused(send("/upload?name=", "x"), 400, "no name");
  expectRefused(send("/upload?name=..", "x"), 400, "no name");
  expectRefused(send("/upload?name=a%00.obj", "x"), 400, "control characters");
  expectRefused(send("/upload?name=a%0a.obj", "x"), 400, "control characters");
  expectRefused(send("/upload?name=%ff.obj", "x"), 400, "no UTF-8");
  expectRefused(send("/upload?name=" + std::string(10'000, 'a') + ".obj", "x"), 400, "longer than 255 bytes");
  const auto get = test::request(server_->port(), "/upload?name=a.obj");
  expectRefused({get.result_int(), get.body()}, 405, "POST only");
  EXPECT_TRUE(counted("denied", 2));
  EXPECT_TRUE(counted("malformed", 9));
  EXPECT_TRUE(opened_.empty());
  EXPECT_EQ(namelessFiles(), 0);
}

TEST_F(Upload, OfTooManyBytesIsRefusedByItsHeadOrOnItsWay) {
  start(settings());
  tcp::socket socket = connect();
  boost::asio::write(socket, boost::asio::buffer(headOf("/upload?name=a.obj", "Content-Length: 2147483648\r\n")));
  expectRefused(answerOf(socket), 413, "too large");  // and not a byte of it has been sent
  tcp::socket chunked = connect();
  boost::asio::write(chunked, boost::asio::buffer(headOf("/upload?name=a.obj", "Transfer-Encoding: chunked\r\n")));
  const std::string piece = "10000\r\n" + std::string(0x10000, 'x') + "\r\n";
  beast::error_code error;
  for (int i = 0; i < 32 && !error; ++i) boost::asio::write(chunked, boost::asio::buffer(piece), error);
  expectRefused(answerOf(chunked), 413, "too large");
  EXPECT_TRUE(counted("too_large", 2));
  EXPECT_TRUE(opened_.empty());
  test::waitFor([] { return namelessFiles() == 0; });
}

TEST_F(Upload, OfASilentOrAGoneSenderIsGivenUp) {
  HttpServerSettings impatient = settings();
  impatient.upload.silence_s = 2;
  start(impatient);
  tcp::socket silent = connect();
  boost::asio::write(silent, boost::asio::buffer(headOf("/upload?name=a.obj", "Content-Length: 1000\r\n") + "half"));
  expectRefused(answerOf(silent), 408, "too slowly");
  {
    tcp::socket gone = connect();
    boost::asio::write(gone, boost::asio::buffer(headOf("/upload?name=a.obj", "Content-Length: 1000\r\n") + "half"));
  }
  test::waitFor([&] { return counted("cut"); });
  EXPECT_TRUE(counted("slow"));
  EXPECT_TRUE(opened_.empty());
  test::waitFor([] { return namelessFiles() == 0; });
  EXPECT_EQ(send("/upload?name=a.obj", "x").status, 200u);  // the place is free again
}

TEST_F(Upload, IsOneAtATimeAndTheServerAnswersMeanwhile) {
  start(settings());
  hold_ = true;
  auto first = std::async(std::launch::async, [&] { return send("/upload?name=a.obj", "x"); });
  test::waitFor([&] { return inside_.load(); });
  expectRefused(send("/upload?name=b.obj", "y"), 409, "busy");
  EXPECT_EQ(test::request(server_->port(), "/healthz").result_int(), 200u);
  hold_ = false;
  EXPECT_EQ(first.get().status, 200u);
  EXPECT_EQ(opened_.size(), 1u);
  EXPECT_TRUE(counted("busy"));
}

TEST_F(Upload, ThatCannotBeReadSaysWhy) {
  start(settings());
  expectRefused(send("/upload?name=bad.obj", "x"), 422, "bad.obj: is no good");
  EXPECT_TRUE(counted("unreadable"));
  EXPECT_EQ(namelessFiles(), 0);
}

TEST_F(Upload, NeedsTheTokenWhereOneIsAskedFor) {
  start(settings(kLimit_bytes, kToken));
  expectRefused(send("/upload?name=a.obj", "x"), 401, "token");
  expectRefused(send("/upload?name=a.obj", "x", "Authorization: Bearer wrong-horse-battery\r\n"), 401, "token");
  EXPECT_TRUE(opened_.empty());
  EXPECT_EQ(send("/upload?name=a.obj", "x", std::string("Authorization: Bearer ") + kToken + "\r\n").status, 200u);
}

TEST_F(Upload, IsNotTakenWhereNoneIsOffered) {
  start(settings(0));
  expectRefused(send("/upload?name=a.obj", "x"), 404, "takes no files");
  EXPECT_TRUE(counted("not_taken"));
}

TEST_F(Upload, EndsWithTheServer) {
  start(settings());
  tcp::socket half = connect();
  boost::asio::write(half, boost::asio::buffer(headOf("/upload?name=a.obj", "Content-Length: 1000\r\n") + "half"));
  test::waitFor([] { return namelessFiles() == 1; });
  server_->stop();
  EXPECT_EQ(namelessFiles(), 0);
}

TEST(UploadName, IsTheLastPartAndNamesNothing) {
  EXPECT_EQ(uploadName("/upload?name=a.obj"), "a.obj");
  EXPECT_EQ(uploadName("/upload?name=..%2F..%2Fetc%2Fpasswd"), "passwd");
  EXPECT_EQ(uploadName("/upload?name=C%3A%5Ca.obj"), "a.obj");
  EXPECT_EQ(uploadName("/upload?name=%E2%82%AC.obj"), "\xe2\x82\xac.obj");
  EXPECT_EQ(uploadName("/upload?name=a%E2%80%AEjbo.obj"), "a?jbo.obj");  // U+202E turns what follows
  EXPECT_EQ(uploadName("/upload?name=%E2%82.obj"), "");
  EXPECT_EQ(uploadName("/upload?name=a%2F"), "");
  EXPECT_EQ(uploadName("/upload?name=a%"), "");
}

}  // namespace
}  // namespace hl::test_upload
