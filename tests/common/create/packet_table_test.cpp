#include "common/create/packet_table.h"

#include <gtest/gtest.h>

#include "common/create/sensor_packets.h"

namespace roomwise::create {
namespace {

TEST(PacketTable, GroupsAreAsLongAsTheManualsSay) {
  const std::vector<std::pair<int, std::size_t>> sizes = {{0, 26},   {1, 10},   {2, 6},  {3, 10},
                                                          {4, 14},   {5, 12},   {6, 52}, {100, 80},
                                                          {101, 28}, {106, 12}, {107, 9}};
  for (const auto& [id, size] : sizes) {
    EXPECT_EQ(packet_size(static_cast<std::uint8_t>(id)), size) << "group " << id;
  }
}

TEST(PacketTable, UnknownNumbersAreNothing) {
  for (const int id : {59, 99, 102, 105, 108, 255}) {
    EXPECT_EQ(packet_size(static_cast<std::uint8_t>(id)), 0U) << id;
    EXPECT_FALSE(model_has(Model::kCreate2, static_cast<std::uint8_t>(id))) << id;
  }
}

TEST(PacketTable, CreateOneHasNoEncoders) {
  EXPECT_TRUE(model_has(Model::kCreate1, 6));
  EXPECT_TRUE(model_has(Model::kCreate1, 42));
  for (const int id : {43, 44, 58, 100, 101, 106, 107}) {
    EXPECT_FALSE(model_has(Model::kCreate1, static_cast<std::uint8_t>(id))) << id;
    EXPECT_TRUE(model_has(Model::kCreate2, static_cast<std::uint8_t>(id))) << id;
  }
}

TEST(SensorPackets, EveryValueComesBackAsItsFormCanCarryIt) {
  for (int id = kFirstPacket; id <= kLastPacket; ++id) {
    const auto number = static_cast<std::uint8_t>(id);
    const PacketForm form = packet_form(number);
    const int top = 1 << (8 * form.size - (form.is_signed ? 1 : 0));
    for (const int value : {0, 1, top - 1, form.is_signed ? -top : top / 2}) {
      SensorPackets sent;
      sent.set(static_cast<Packet>(id), value);
      std::vector<std::uint8_t> bytes;
      append_packets(number, sent, bytes);
      SensorPackets got;
      ASSERT_TRUE(read_packets(number, bytes, got));
      EXPECT_EQ(got[static_cast<Packet>(id)], value) << "packet " << id;
    }
  }
}

TEST(SensorPackets, DataOfTheWrongLengthAreRefused) {
  SensorPackets packets;
  const std::vector<std::uint8_t> bytes(81);
  EXPECT_FALSE(read_packets(100, bytes, packets));
  EXPECT_FALSE(read_packets(200, {}, packets));
  EXPECT_FALSE(packets.has(Packet::kWall));
}

TEST(SensorPackets, MergingKeepsWhatTheNewerHasNot) {
  SensorPackets older;
  older.set(Packet::kButtons, 5);
  older.set(Packet::kWall, 1);
  SensorPackets newer;
  newer.set(Packet::kWall, 0);
  older.merge(newer);
  EXPECT_EQ(older[Packet::kButtons], 5);
  EXPECT_EQ(older[Packet::kWall], 0);
  EXPECT_TRUE(older.has(Packet::kButtons));
}

}  // namespace
}  // namespace roomwise::create
