#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "services/create_driver/core/oi_encoder.h"
#include "services/create_driver/core/wheel_speeds.h"

namespace roomwise::create {
namespace {

WheelSpeeds any_speeds() {
  const auto mmps = rc::gen::inRange(-10'000, 10'001);
  return {1e-3 * *mmps, 1e-3 * *mmps};
}

RC_GTEST_PROP(WheelSpeedsLaw, LimitingKeepsTheCurvature, ()) {
  const WheelSpeeds wanted = any_speeds();
  const WheelSpeeds got = limited(wanted, 0.5);
  RC_ASSERT(std::abs(got.left_mps * wanted.right_mps - got.right_mps * wanted.left_mps) < 1e-12);
  RC_ASSERT(got.left_mps * wanted.left_mps >= 0.0);
  RC_ASSERT(got.right_mps * wanted.right_mps >= 0.0);
}

RC_GTEST_PROP(WheelSpeedsLaw, NoWheelIsFasterThanTheLimitNorThanWanted, ()) {
  const WheelSpeeds wanted = any_speeds();
  const WheelSpeeds got = limited(wanted, 0.3);
  for (const auto& [a, b] :
       {std::pair(got.left_mps, wanted.left_mps), std::pair(got.right_mps, wanted.right_mps)}) {
    RC_ASSERT(std::abs(a) <= 0.3 + 1e-12);
    RC_ASSERT(std::abs(a) <= std::abs(b) + 1e-12);
  }
}

RC_GTEST_PROP(WheelSpeedsLaw, WhatIsWithinTheLimitIsLeftAlone, ()) {
  const WheelSpeeds wanted{1e-3 * *rc::gen::inRange(-300, 301),
                           1e-3 * *rc::gen::inRange(-300, 301)};
  RC_ASSERT(limited(wanted, 0.3) == wanted);
}

RC_GTEST_PROP(WheelSpeedsLaw, BodySpeedsComeBackFromTheWheels, ()) {
  const double speed_mps = 1e-3 * *rc::gen::inRange(-500, 501);
  const double rate_radps = 1e-3 * *rc::gen::inRange(-4000, 4001);
  const WheelSpeeds wheels = wheel_speeds(speed_mps, rate_radps, 0.235);
  RC_ASSERT(std::abs(0.5 * (wheels.left_mps + wheels.right_mps) - speed_mps) < 1e-12);
  RC_ASSERT(std::abs((wheels.right_mps - wheels.left_mps) / 0.235 - rate_radps) < 1e-12);
}

RC_GTEST_PROP(WheelSpeedsLaw, EncodedSpeedsComeBackToTheNearestMillimetre, ()) {
  const WheelSpeeds wanted = limited(any_speeds(), 0.5);
  Bytes bytes;
  append_drive(wanted, bytes);
  const auto word = [&](std::size_t at) {
    return static_cast<std::int16_t>(bytes[at] << 8 | bytes[at + 1]);
  };
  RC_ASSERT(std::abs(1e-3 * word(1) - wanted.right_mps) <= 0.5e-3 + 1e-12);
  RC_ASSERT(std::abs(1e-3 * word(3) - wanted.left_mps) <= 0.5e-3 + 1e-12);
}

}  // namespace
}  // namespace roomwise::create
