// Who may talk to the server: hosts, origins, tokens and the cookies made of them.
#include "http/access.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace hl::test_access {
namespace {

constexpr const char* kToken = "correct-horse-battery";

AccessSettings beyondLoopback() { return {false, true, 1997, kToken}; }

// What a browser sends back of a Set-Cookie.
std::string sentBack(const std::string& cookie) { return cookie.substr(0, cookie.find(';')); }

TEST(Access, OnLoopbackOnlyLoopbackHostsAndOriginsAreOurs) {
  const Access access({true, false, 1997, ""});
  for (const char* host : {"127.0.0.1:1997", "127.0.0.2:1997", "localhost:1997", "[::1]:1997"}) {
    EXPECT_TRUE(access.allowsHost(host)) << host;
    EXPECT_TRUE(access.allowsOrigin("http://" + std::string(host), "localhost:1997")) << host;
  }
  for (const char* host : {"127.0.0.1", "evil.example:1997", "127.0.0.1:80", "127.0.0.1.evil.example:1997",
                           "128.0.0.1:1997", "127.1:1997", ""}) {
    EXPECT_FALSE(access.allowsHost(host)) << host;
  }
  EXPECT_TRUE(access.allowsOrigin("", "localhost:1997"));
  for (const char* origin : {"null", "https://evil.example", "http://127.0.0.1:1998", "http://evil.example:1997",
                             "https://localhost:1997"}) {
    EXPECT_FALSE(access.allowsOrigin(origin, "localhost:1997")) << origin;
  }
}

TEST(Access, BeyondLoopbackTheOriginIsTheHostItself) {
  const Access access(beyondLoopback());
  EXPECT_TRUE(access.allowsHost("lab.example:1997"));
  EXPECT_TRUE(access.allowsOrigin("", "lab.example:1997"));
  EXPECT_TRUE(access.allowsOrigin("https://lab.example:1997", "lab.example:1997"));
  for (const char* origin : {"null", "http://lab.example:1997", "https://evil.example", "https://lab.example",
                             "https://lab.example:1997.evil.example"}) {
    EXPECT_FALSE(access.allowsOrigin(origin, "lab.example:1997")) << origin;
  }
}

TEST(Access, WithoutATokenEverybodyIsTrusted) {
  const Access access({true, false, 1997, ""});
  EXPECT_FALSE(access.wantsToken());
  EXPECT_TRUE(access.allowsToken(""));
  EXPECT_TRUE(access.allowsCookies(""));
  EXPECT_TRUE(access.allowsBearer(""));
}

TEST(Access, OnlyTheTokenItselfIsTheToken) {
  const Access access(beyondLoopback());
  EXPECT_TRUE(access.wantsToken());
  EXPECT_TRUE(access.allowsToken(kToken));
  EXPECT_TRUE(access.allowsBearer(std::string("Bearer ") + kToken));
  EXPECT_TRUE(access.allowsBearer(std::string("bearer  ") + kToken));
  for (const char* wrong : {"", "correct-horse-batter", "correct-horse-battery-", "Correct-horse-battery"}) {
    EXPECT_FALSE(access.allowsToken(wrong)) << wrong;
    EXPECT_FALSE(access.allowsBearer(std::string("Bearer ") + wrong)) << wrong;
  }
  EXPECT_FALSE(access.allowsBearer(kToken));
}

TEST(Access, TheCookieStandsForTheTokenAndHidesIt) {
  const Access access(beyondLoopback());
  const std::string cookie = access.cookie();
  for (const char* part : {"; HttpOnly", "; SameSite=Strict", "; Secure", "; Path=/"}) {
    EXPECT_NE(cookie.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(cookie.find(kToken), std::string::npos);
  EXPECT_TRUE(access.allowsCookies(sentBack(cookie)));
  EXPECT_TRUE(access.allowsCookies("theme=dark; " + sentBack(cookie) + "; other=1"));
  EXPECT_FALSE(access.allowsCookies(""));
  EXPECT_FALSE(access.allowsCookies(std::string("hl_page_1997=") + kToken));
  EXPECT_FALSE(access.allowsCookies("x" + sentBack(cookie)));
  EXPECT_FALSE(access.allowsCookies(sentBack(cookie) + "0"));
  EXPECT_FALSE(access.allowsCookies("hl_page_1997=;;;=;"));
}

TEST(Access, ANewTokenEndsTheOldOneAndItsCookies) {
  Access access(beyondLoopback());
  const std::string old = sentBack(access.cookie());
  EXPECT_THROW(access.setToken("short"), Error);
  EXPECT_TRUE(access.allowsToken(kToken));
  access.setToken("another-horse-battery");
  EXPECT_FALSE(access.allowsToken(kToken));
  EXPECT_FALSE(access.allowsCookies(old));
  EXPECT_TRUE(access.allowsToken("another-horse-battery"));
}

TEST(Access, ATokenIsLongEnoughAndFitsIntoAnAddress) {
  for (const char* bad : {"", "fifteen-letters", "with a space in it", "percent%20percent", "semi;colon;semi;colon"}) {
    try {
      checkToken(bad);
      FAIL() << bad;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("openssl rand"), std::string::npos);
    }
  }
  EXPECT_NO_THROW(checkToken("0123456789abcdef"));
  EXPECT_THROW(checkToken(std::string(257, 'a')), Error);
}

}  // namespace
}  // namespace hl::test_access
