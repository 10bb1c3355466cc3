// No decision allocates memory once the service runs.
#include <gtest/gtest.h>

#include "tests/safety_svc/support/driven_world.h"
#include "tests/support/allocation_counter.h"

namespace roomwise::safety {
namespace {

TEST(Allocation, NoneAfterTheFirstSecond) {
  DrivenWorld drive;
  drive.discs = {{{2.0, 0.1}, 0.1}};
  drive.ask(0.4, 0.1);
  drive.run(std::chrono::seconds(1));
  const long before = allocations_so_far();
  ASSERT_GT(before, 0);
  drive.run(std::chrono::seconds(4));
  EXPECT_EQ(allocations_so_far(), before);
}

}  // namespace
}  // namespace roomwise::safety
