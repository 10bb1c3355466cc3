#include "services/simulator/core/create/oi_packets.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "services/simulator/core/create/oi_odometer.h"
#include "tests/simulator/core/create/oi_host.h"

namespace roomwise::simulator {
namespace {

Bytes data_of(std::uint8_t id, const OiSnapshot& snapshot,
              CreateModel model = CreateModel::kCreate2) {
  Bytes bytes;
  const PacketRange range = packets_of(id, model);
  for (int single = range.first; single <= range.last; ++single) {
    append_packet(static_cast<std::uint8_t>(single), model, snapshot, bytes);
  }
  return bytes;
}

TEST(OiPackets, GroupsAreAsLongAsTheSpecificationSays) {
  const std::pair<int, std::size_t> kGroups[] = {{0, 26},   {1, 10},   {2, 6},  {3, 10},
                                                 {4, 14},   {5, 12},   {6, 52}, {100, 80},
                                                 {101, 28}, {106, 12}, {107, 9}};
  for (const auto& [id, length] : kGroups) {
    EXPECT_EQ(data_of(static_cast<std::uint8_t>(id), {}).size(), length) << id;
  }
}

TEST(OiPackets, WhatAModelLacksIsEmpty) {
  for (const int id : {43, 58, 100, 101, 106, 107, 59, 99, 255}) {
    EXPECT_TRUE(packets_of(static_cast<std::uint8_t>(id), CreateModel::kCreate1).empty()) << id;
  }
  EXPECT_TRUE(packets_of(59, CreateModel::kCreate2).empty());
  EXPECT_FALSE(packets_of(58, CreateModel::kCreate2).empty());
}

TEST(OiPackets, BumpsAndDropsHaveTheirBits) {
  OiSnapshot s;
  s.body.bump.right = true;
  EXPECT_EQ(data_of(7, s), Bytes{1});
  s.body.bump.left = true;
  EXPECT_EQ(data_of(7, s), Bytes{3});
  s.body.wheel_drop = {true, false};
  EXPECT_EQ(data_of(7, s), Bytes{11});
  s.body.caster_drop = true;
  EXPECT_EQ(data_of(7, s), Bytes{11}) << "a Create 2 has no caster switch";
  EXPECT_EQ(data_of(7, s, CreateModel::kCreate1), Bytes{27});
}

TEST(OiPackets, ValuesStandInTheirPlaces) {
  OiSnapshot s;
  s.body.cliff = {false, false, true, false};
  s.body.cliff_signal = {1, 537, 3, 4095};
  s.body.light_signal = {0, 300, 0, 0, 0, 4095};
  s.body.overcurrent = {true, false};
  s.body.wheel_current_ma = {-5, 900};
  s.body.encoder_ticks = {65535, 1};
  s.body.voltage_mv = 16123;
  s.body.current_ma = -250;
  s.body.temperature_c = -3;
  s.body.home_base = true;
  EXPECT_EQ(data_of(11, s), Bytes{1});
  EXPECT_EQ(data_of(29, s), (Bytes{2, 25}));
  EXPECT_EQ(data_of(31, s), (Bytes{15, 255}));
  EXPECT_EQ(data_of(45, s), Bytes{0b100010});
  EXPECT_EQ(data_of(51, s), (Bytes{15, 255}));
  EXPECT_EQ(data_of(14, s), Bytes{16});
  EXPECT_EQ(data_of(54, s), (Bytes{255, 251}));
  EXPECT_EQ(data_of(55, s), (Bytes{3, 132}));
  EXPECT_EQ(data_of(43, s), (Bytes{255, 255}));
  EXPECT_EQ(data_of(44, s), (Bytes{0, 1}));
  EXPECT_EQ(data_of(22, s), (Bytes{62, 251}));
  EXPECT_EQ(data_of(23, s), (Bytes{255, 6}));
  EXPECT_EQ(data_of(24, s), Bytes{253});
  EXPECT_EQ(data_of(34, s), Bytes{2});
}

TEST(OiPackets, NoInfraredCharacterIs255OnACreate1AndZeroOnA2) {
  EXPECT_EQ(data_of(17, {}, CreateModel::kCreate1), Bytes{255});
  EXPECT_EQ(data_of(17, {}), Bytes{0});
}

OiOdometer odometer(bool carries) {
  return OiOdometer({.wheel_base_m = 0.235, .carries = carries});
}

RC_GTEST_PROP(OiOdometer, CarryLosesNothing, ()) {
  OiOdometer counts = odometer(true);
  LeftRight<double> turned_m;
  int distance_mm = 0;
  int angle_deg = 0;
  for (int i = 0; i < 200; ++i) {
    turned_m.left += *rc::gen::inRange(-8, 9) * 1e-3;
    turned_m.right += *rc::gen::inRange(-8, 9) * 1e-3;
    counts.sample(turned_m);
    distance_mm += counts.take_distance_mm();
    angle_deg += counts.take_angle_deg();
  }
  RC_ASSERT(std::abs(distance_mm - 500.0 * (turned_m.left + turned_m.right)) < 1.001);
  RC_ASSERT(std::abs(angle_deg - 57.29578 * (turned_m.right - turned_m.left) / 0.235) < 1.001);
}

TEST(OiOdometer, TruncateReadsSlowTurnsAsZero) {
  OiOdometer counts = odometer(false);
  LeftRight<double> turned_m;
  for (int i = 0; i < 1000; ++i) {  // 60 degrees a second, read every 15 ms
    const double quarter_m = 60.0 / 57.29578 * 0.015 * 0.235 / 2.0;
    turned_m = {turned_m.left - quarter_m, turned_m.right + quarter_m};
    counts.sample(turned_m);
    ASSERT_EQ(counts.take_angle_deg(), 0);
  }
}

TEST(OiOdometer, IsCappedAtSixteenBits) {
  for (const bool carries : {false, true}) {
    OiOdometer counts = odometer(carries);
    counts.sample({1000.0, 1000.0});
    EXPECT_EQ(counts.take_distance_mm(), 32767);
    EXPECT_EQ(counts.take_distance_mm(), 0);
    counts.sample({-1000.0, -1000.0});
    EXPECT_EQ(counts.take_distance_mm(), -32768);
  }
}

TEST(OldFirmware, GetsAngleThenDistanceWrong) {
  const auto read = [](const char* firmware) {
    OpenInterfaceParams params;
    params.firmware = firmware;
    OiHost host(params);
    host.send({128});
    host.readings.turned_m = {1.0, 1.5};
    host.wait(1);
    const Bytes reply = host.ask({149, 2, 19, 20});
    return std::pair{word_at(reply, 0), word_at(reply, 2)};
  };
  EXPECT_EQ(read("3.7.7"), (std::pair{1250, 121}));
  EXPECT_EQ(read("3.4.0"), (std::pair{1250, 39}));
  EXPECT_EQ(read("3.2.6"), (std::pair{625, 39}));
}

TEST(OiOdometer, EveryPacketIsResetByItsOwnRead) {
  OiHost host;
  host.send({128});
  host.readings.turned_m = {0.1, 0.2};
  host.wait(1);
  EXPECT_EQ(word_at(host.ask({142, 19}), 0), 150);
  EXPECT_EQ(word_at(host.ask({142, 19}), 0), 0);
  EXPECT_EQ(word_at(host.ask({142, 20}), 0), 24);
  host.readings.turned_m = {0.2505, 0.3};
  host.wait(1);
  EXPECT_EQ(word_at(host.ask({142, 2}), 2), 125) << "a group reads it too";
  EXPECT_EQ(word_at(host.ask({142, 19}), 0), 0);
}

}  // namespace
}  // namespace roomwise::simulator
