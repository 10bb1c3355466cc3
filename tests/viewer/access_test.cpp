#include "services/viewer/core/access.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace roomwise::viewer {
namespace {

const Tokens kTokens{"a-token-to-look-on", "a-token-to-drive-by"};

TEST(Endpoint, IsAnAddressAndAPort) {
  EXPECT_EQ(parse_endpoint("127.0.0.1:8090").port, 8090);
  EXPECT_TRUE(parse_endpoint("127.0.0.1:8090").is_loopback());
  EXPECT_FALSE(parse_endpoint("0.0.0.0:8090").is_loopback());
}

TEST(Endpoint, AnythingElseIsRefused) {
  for (const char* text : {"", ":", "8090", "127.0.0.1", "127.0.0.1:", "127.0.0.1:65536", "a:1",
                           "127.0.0.256:1", "127.0.0:1", "127.0.0.1:80,443", "1.2.3.4.5:1"}) {
    EXPECT_THROW((void)parse_endpoint(text), std::runtime_error) << text;
  }
}

TEST(Rights, ViewingAndControlAreApart) {
  EXPECT_EQ(rights_of(kTokens, "a-token-to-look-on"), Rights::kView);
  EXPECT_EQ(rights_of(kTokens, "a-token-to-drive-by"), Rights::kControl);
}

TEST(Rights, AWrongTokenGivesNone) {
  for (const char* token :
       {"", "a", "a-token-to-look-o", "a-token-to-look-on ", "x-token-to-look-on"}) {
    EXPECT_EQ(rights_of(kTokens, token), Rights::kNone) << token;
  }
}

TEST(Rights, WithoutTokensTheLoopbackControls) { EXPECT_EQ(rights_of({}, ""), Rights::kControl); }

TEST(TokenFile, NeedsTwoLongDifferentSecrets) {
  EXPECT_EQ(parse_tokens("view 0123456789abcdef\ncontrol fedcba9876543210\n").control,
            "fedcba9876543210");
  for (const char* text : {"", "view 0123456789abcdef", "view short\ncontrol short2",
                           "view 0123456789abcdef\ncontrol 0123456789abcdef"}) {
    EXPECT_THROW((void)parse_tokens(text), std::runtime_error) << text;
  }
}

TEST(Host, OnTheLoopbackIsOurOwnNameOnly) {
  const Endpoint endpoint{"127.0.0.1", 8090};
  EXPECT_TRUE(is_own_host(endpoint, "127.0.0.1:8090"));
  EXPECT_TRUE(is_own_host(endpoint, "localhost:8090"));
  for (const char* host : {"", "evil.example:8090", "127.0.0.1", "127.0.0.1:8091",
                           "localhost.evil.example:8090", "192.168.1.2:8090"}) {
    EXPECT_FALSE(is_own_host(endpoint, host)) << host;
  }
}

TEST(Host, OnTheLanIsANumericAddress) {
  const Endpoint endpoint{"0.0.0.0", 8090};
  EXPECT_TRUE(is_own_host(endpoint, "192.168.1.2:8090"));
  EXPECT_FALSE(is_own_host(endpoint, "evil.example:8090"));
}

TEST(Origin, IsThePageWeServed) {
  EXPECT_TRUE(is_own_origin("http://127.0.0.1:8090", "127.0.0.1:8090"));
  for (const char* origin : {"", "null", "http://evil.example", "https://127.0.0.1:8090",
                             "http://127.0.0.1:8090.evil.example", "http://127.0.0.1"}) {
    EXPECT_FALSE(is_own_origin(origin, "127.0.0.1:8090")) << origin;
  }
  EXPECT_FALSE(is_own_origin("http://", ""));
}

}  // namespace
}  // namespace roomwise::viewer
