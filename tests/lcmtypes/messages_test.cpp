// What every message owes its readers: one fingerprint, fixed bytes, and a decoder nothing breaks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "common/bus/wire.h"
#include "common/channels.h"
#include "tests/lcmtypes/examples.h"
#include "tests/support/build_paths.h"

namespace roomwise {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Lower-case hexadecimal, 16 bytes a line, as xxd -p -c 16 writes and xxd -r -p reads it.
std::string to_hex(const Bytes& bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    text += {kDigits[bytes[i] >> 4U], kDigits[bytes[i] & 15U]};
    if (i % 16 == 15 || i + 1 == bytes.size()) text += '\n';
  }
  return text;
}

template <class Message>
Bytes example_bytes() {
  Bytes bytes;
  encode(example<Message>(), bytes);
  return bytes;
}

template <class Message>
std::filesystem::path golden_path() {
  return source_folder() / "tests/lcmtypes/golden" / (std::string(Message::getTypeName()) + ".hex");
}

template <class Message>
class EveryMessage : public ::testing::Test {};

template <class Tuple>
struct TypesOf;
template <class... Message>
struct TypesOf<std::tuple<Message...>> {
  using Types = ::testing::Types<Message...>;
};

TYPED_TEST_SUITE(EveryMessage, TypesOf<AllMessages>::Types);

TYPED_TEST(EveryMessage, HasItsGoldenBytes) {
  const std::string hex = to_hex(example_bytes<TypeParam>());
  if (std::getenv("ROOMWISE_REWRITE_GOLDEN") != nullptr) {
    std::ofstream(golden_path<TypeParam>()) << hex;
    GTEST_SKIP() << "wrote " << golden_path<TypeParam>() << "; review it and commit";
  }
  std::stringstream golden;
  golden << std::ifstream(golden_path<TypeParam>()).rdbuf();
  EXPECT_EQ(hex, golden.str())
      << "a changed type breaks old logs: give it a new name (_v2_t), or if that is meant, "
         "run scripts/update_goldens and review the difference";
}

TYPED_TEST(EveryMessage, ComesBackAsItWasSent) {
  const Bytes sent = example_bytes<TypeParam>();
  TypeParam message;
  ASSERT_EQ(decode(sent, message), DecodeResult::kOk);
  Bytes again;
  encode(message, again);
  EXPECT_EQ(to_hex(again), to_hex(sent));
}

TYPED_TEST(EveryMessage, IsRefusedWhenCutAnywhere) {
  const Bytes whole = example_bytes<TypeParam>();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    TypeParam message;
    EXPECT_NE(decode(cut, message), DecodeResult::kOk) << "cut to " << size << " bytes";
  }
}

TYPED_TEST(EveryMessage, IsRefusedWithBytesLeftOver) {
  Bytes bytes = example_bytes<TypeParam>();
  bytes.push_back(0);
  TypeParam message;
  EXPECT_EQ(decode(bytes, message), DecodeResult::kTrailing);
}

TYPED_TEST(EveryMessage, IsRefusedWithAnyOtherFingerprint) {
  for (std::size_t bit = 0; bit < 64; ++bit) {
    Bytes bytes = example_bytes<TypeParam>();
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << bit % 8));
    TypeParam message;
    EXPECT_EQ(decode(bytes, message), DecodeResult::kForeign) << "bit " << bit;
  }
}

/// Whatever stands in any four bytes, decode says so or gives a message that encodes to as many
/// bytes. Under the sanitizers this also shows that nothing is read or allocated beyond.
TYPED_TEST(EveryMessage, SurvivesAbsurdNumbersEverywhere) {
  const Bytes whole = example_bytes<TypeParam>();
  for (const std::uint32_t absurd :
       {0xFFFFFFFFU, 0x80000000U, 0x7FFFFFFFU, 0x77359400U, 0x00010000U}) {
    for (std::size_t at = 8; at + 4 <= whole.size(); ++at) {
      Bytes bytes = whole;
      for (std::size_t i = 0; i < 4; ++i) {
        bytes[at + i] = static_cast<std::uint8_t>(absurd >> (24 - 8 * i));
      }
      TypeParam message;
      if (decode(bytes, message) != DecodeResult::kOk) continue;
      Bytes again;
      encode(message, again);
      EXPECT_EQ(again.size(), bytes.size()) << absurd << " at byte " << at;
    }
  }
}

template <class... Message>
std::map<std::int64_t, std::vector<std::string>> names_by_fingerprint(std::tuple<Message...>*) {
  std::map<std::int64_t, std::vector<std::string>> names;
  (names[Message::getHash()].emplace_back(Message::getTypeName()), ...);
  return names;
}

TEST(AllMessages, HaveFingerprintsOfTheirOwn) {
  const auto names = names_by_fingerprint(static_cast<AllMessages*>(nullptr));
  EXPECT_EQ(names.size(), std::tuple_size_v<AllMessages>);
  for (const auto& [fingerprint, alike] : names) {
    EXPECT_EQ(alike.size(), 1U) << ::testing::PrintToString(alike) << " decode as each other";
  }
}

template <class... Message>
std::vector<std::string> golden_names(std::tuple<Message...>*) {
  return {golden_path<Message>().filename().string()...};
}

TEST(AllMessages, AreWhatTheGoldenFolderHolds) {
  std::vector<std::string> found;
  for (const auto& entry :
       std::filesystem::directory_iterator(source_folder() / "tests/lcmtypes/golden")) {
    found.push_back(entry.path().filename().string());
  }
  EXPECT_THAT(found, ::testing::UnorderedElementsAreArray(
                         golden_names(static_cast<AllMessages*>(nullptr))));
}

TEST(AllChannels, HaveNamesOfTheirOwnThatLcmCarries) {
  std::map<std::string_view, int> times;
  std::apply([&times](const auto&... channel) { (++times[channel.name], ...); }, kAllChannels);
  constexpr std::size_t kLongestChannelName = 63;  // LCM_MAX_CHANNEL_NAME_LENGTH
  for (const auto& [name, count] : times) {
    EXPECT_EQ(count, 1) << name;
    EXPECT_LE(name.size(), kLongestChannelName) << name;
  }
}

/// A count on the wire: which message it is in and at which byte it starts.
struct WireCount {
  std::string type;
  Bytes bytes;
  std::size_t at;
  DecodeResult (*decode)(std::span<const std::uint8_t>);
};

std::ostream& operator<<(std::ostream& out, const WireCount& count) { return out << count.type; }

template <class Message>
WireCount wire_count(std::size_t at) {
  return {Message::getTypeName(), example_bytes<Message>(), at,
          [](std::span<const std::uint8_t> bytes) {
            Message message;
            return decode(bytes, message);
          }};
}

class Counts : public ::testing::TestWithParam<WireCount> {};

TEST_P(Counts, ThatAreNegativeHugeOrOneTooManyAreRefused) {
  const auto& [type, whole, at, decode_it] = GetParam();
  ASSERT_EQ(decode_it(whole), DecodeResult::kOk);
  const auto true_count = static_cast<std::uint32_t>(whole[at + 3]);
  for (const std::uint32_t wrong :
       {0xFFFFFFFFU, 0x80000000U, 0x7FFFFFFFU, 2'000'000'000U, true_count + 1, true_count - 1}) {
    Bytes bytes = whole;
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[at + i] = static_cast<std::uint8_t>(wrong >> (24 - 8 * i));
    }
    EXPECT_NE(decode_it(bytes), DecodeResult::kOk) << type << ' ' << wrong;
  }
}

// Fingerprint 8, utime 8, seq 8, then as the .lcm file has it.
INSTANTIATE_TEST_SUITE_P(OfArraysAndStrings, Counts,
                         ::testing::Values(wire_count<landmark_list_t>(8 + 3 * 8 + 2 * 4),
                                           wire_count<landmark_map_t>(8 + 2 * 8),
                                           wire_count<segment_training_t>(8 + 3 * 8),
                                           wire_count<params_t>(8 + 2 * 8),
                                           wire_count<named_count_t>(8)));

TEST(Encode, ThrowsWhenACountIsNotItsVectorsSize) {
  auto map = example<landmark_map_t>();
  Bytes bytes;
  for (const int wrong : {-1, 0, 1, 3}) {
    map.map_count = wrong;
    EXPECT_THROW(encode(map, bytes), std::logic_error) << wrong;
  }
}

TEST(Encode, ThrowsWhenACountInsideAnElementIsWrong) {
  auto health = example<health_t>();
  health.channel_count = 1;
  Bytes bytes;
  EXPECT_THROW(encode(health, bytes), std::logic_error);
}

// lcm-gen sizes a string by its length and writes it up to its first NUL.
TEST(Encode, ThrowsWhenAStringHasANulInside) {
  named_count_t message{};
  message.name = std::string("a\0b", 3);
  Bytes bytes;
  EXPECT_THROW(encode(message, bytes), std::logic_error);
}

TEST(Decode, RefusesAStringWithANulInside) {
  named_count_t message{};
  message.name = "a?b";
  Bytes bytes;
  encode(message, bytes);
  *std::find(bytes.begin(), bytes.end(), '?') = 0;
  EXPECT_EQ(decode(std::span<const std::uint8_t>(bytes), message), DecodeResult::kBadCounts);
}

TEST(Decode, AReusedMessageKeepsNothingOfTheOneBefore) {
  safety_state_t message{};
  message.reasons = {velocity_command_t::REASON_MODE};
  message.reason_count = 1;
  std::vector<std::uint8_t> full;
  std::vector<std::uint8_t> empty;
  encode(message, full);
  encode(safety_state_t{}, empty);
  ASSERT_EQ(decode(full, message), DecodeResult::kOk);
  ASSERT_EQ(decode(empty, message), DecodeResult::kOk);
  EXPECT_TRUE(message.reasons.empty());
}

}  // namespace
}  // namespace roomwise
