#include "services/kinect_pub/core/reopen_backoff.h"

#include <gtest/gtest.h>

namespace roomwise::kinect {
namespace {

TEST(ReopenBackoff, DoublesUpToItsLimitAndStartsOver) {
  ReopenBackoff backoff;
  EXPECT_EQ(backoff.next(), ReopenBackoff::kShortest);
  EXPECT_EQ(backoff.next(), 2 * ReopenBackoff::kShortest);
  for (int i = 0; i < 100; ++i) EXPECT_LE(backoff.next(), ReopenBackoff::kLongest);
  EXPECT_EQ(backoff.next(), ReopenBackoff::kLongest);
  backoff.reset();
  EXPECT_EQ(backoff.next(), ReopenBackoff::kShortest);
}

}  // namespace
}  // namespace roomwise::kinect
