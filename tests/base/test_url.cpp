// Addresses that people write: what of them is understood, what is refused, and that a token is never repeated.
#include "base/url.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace hl::test_url {
namespace {

TEST(Url, IsTakenApart) {
  const Url url = parseUrl("hls://[::1]:2000/a?name=b%20c&token=x+y&flag");
  EXPECT_EQ(url.scheme, "hls");
  EXPECT_EQ(url.host, "::1");
  EXPECT_EQ(url.port, 2000);
  EXPECT_EQ(url.path, "/a");
  ASSERT_EQ(url.options.size(), 3U);
  EXPECT_EQ(url.options[0].value, "b c");
  EXPECT_EQ(url.options[1].value, "x+y");
  EXPECT_FALSE(url.options[2].value);
}

TEST(Url, WhatIsNotThereIsAbsent) {
  const Url url = parseUrl("inproc:");
  EXPECT_FALSE(url.host);
  EXPECT_FALSE(url.port);
  EXPECT_TRUE(url.options.empty());
}

TEST(Url, NonsenseIsRefusedWithoutRepeatingIt) {
  for (const char* text :
       {"", "lab", "hl://secret:", "hl://secret:0", "hl://secret:70000", "hl://secret:99999", "hl://secret:111955",
        "hl://a secret", "hl://[::1", "hl://u@secret", "hl://h?token=secret%4", "hl://h?token=secret#x", "hl://"}) {
    try {
      parseUrl(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find("secret"), std::string::npos) << error.what();
    }
  }
}

TEST(Url, HostsAndPortsAreWrittenAsTheyAreRead) {
  EXPECT_EQ(hostAndPort("lab", 80), "lab:80");
  EXPECT_EQ(hostAndPort("::1", 80), "[::1]:80");
}

TEST(Url, QueriesAreTakenApart) {
  EXPECT_EQ(queryValue("/?token=abc", "token"), "abc");
  EXPECT_EQ(queryValue("/?a=1&token=abc&b=2#token=x", "token"), "abc");
  for (const char* target :
       {"/", "/?", "/?tokens=abc", "/?atoken=abc", "/token=abc", "/?&&=", "/?token", "/?#token=abc", "?#", "?"}) {
    EXPECT_EQ(queryValue(target, "token"), "") << target;
  }
}

}  // namespace
}  // namespace hl::test_url
