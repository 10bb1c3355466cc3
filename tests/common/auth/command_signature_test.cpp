#include "common/auth/command_signature.h"

#include <gtest/gtest.h>

#include <functional>

namespace roomwise {
namespace {

SecretKey some_key() {
  SecretKey key{};
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = static_cast<std::uint8_t>(7 * i + 1);
  return key;
}

velocity_command_t signed_command() {
  velocity_command_t command{};
  command.utime = 1'700'000'000'000'000;
  command.seq = 4;
  command.allowed_speed_mps = 0.25;
  command.allowed_turn_rate_radps = -0.5;
  command.reason = velocity_command_t::REASON_OBSTACLE;
  command.expiry_utime = command.utime + 200'000;
  command.session = 77;
  command.sequence = 5;
  sign(some_key(), command);
  return command;
}

TEST(CommandSignature, FitsWhatWasSignedWithTheSameKey) {
  EXPECT_EQ(check_signature(some_key(), signed_command()), Signature::kGenuine);
}

TEST(CommandSignature, TheBussOwnCountIsNotPartOfIt) {
  velocity_command_t command = signed_command();
  command.seq = 99;
  EXPECT_EQ(check_signature(some_key(), command), Signature::kGenuine);
}

TEST(CommandSignature, AnyOtherFieldChangedIsForged) {
  const std::vector<std::function<void(velocity_command_t&)>> changes = {
      [](auto& c) { ++c.utime; },
      [](auto& c) { c.allowed_speed_mps = 0.2500001; },
      [](auto& c) { c.allowed_speed_mps = -c.allowed_speed_mps; },
      [](auto& c) { c.allowed_turn_rate_radps = 0.5; },
      [](auto& c) { c.reason = velocity_command_t::REASON_AS_ASKED; },
      [](auto& c) { c.expiry_utime += 1'000'000; },
      [](auto& c) { ++c.session; },
      [](auto& c) { ++c.sequence; },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    velocity_command_t command = signed_command();
    changes[i](command);
    EXPECT_EQ(check_signature(some_key(), command), Signature::kForged) << i;
  }
}

TEST(CommandSignature, AnyBitOfItChangedIsForged) {
  for (std::size_t bit = 0; bit < 8 * signed_command().signature.size(); ++bit) {
    velocity_command_t command = signed_command();
    command.signature[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    EXPECT_EQ(check_signature(some_key(), command), Signature::kForged) << bit;
  }
}

TEST(CommandSignature, AnotherKeyIsForged) {
  SecretKey other = some_key();
  other[31] ^= 0x80;
  EXPECT_EQ(check_signature(other, signed_command()), Signature::kForged);
}

TEST(CommandSignature, OfAnotherLengthIsForgedAndNoneIsMissing) {
  velocity_command_t command = signed_command();
  const auto set_size = [&command](std::size_t size) {
    command.signature.resize(size);
    command.signature_size = static_cast<std::int32_t>(size);
  };
  set_size(33);
  EXPECT_EQ(check_signature(some_key(), command), Signature::kForged);
  set_size(3);
  EXPECT_EQ(check_signature(some_key(), command), Signature::kForged);
  set_size(0);
  EXPECT_EQ(check_signature(some_key(), command), Signature::kMissing);
}

TEST(CommandSignature, WhatDecodingLeftBehindOfAnEarlierMessageIsNone) {
  velocity_command_t command = signed_command();
  command.signature_size = 0;
  EXPECT_EQ(check_signature(some_key(), command), Signature::kMissing);
}

}  // namespace
}  // namespace roomwise
