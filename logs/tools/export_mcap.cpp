#include <fmt/core.h>

#include <map>
#include <stdexcept>

#include "common/frames/frame_decoder.h"
#include "logs/tools/foxglove_messages.h"
#include "logs/tools/json_fields.h"
#include "logs/tools/log_replay.h"
#include "logs/tools/mcap_writer.h"
#include "logs/tools/subcommands.h"
#include "logs/tools/whole_file.h"

namespace roomwise {
namespace {

/// Topics appear in the file with their first message.
class McapExport {
 public:
  explicit McapExport(const std::filesystem::path& path)
      : mcap_(path), decoder_(ColorUse::kDecode) {}

  void subscribe(Bus& bus) {
    std::apply([&](const auto&... channel) { (subscribe_to(bus, channel), ...); }, kAllChannels);
  }
  std::uint64_t close() {
    mcap_.close();
    return count_;
  }

 private:
  struct Schema {
    std::string name;
    std::string json;
  };

  template <class Message>
  void subscribe_to(Bus& bus, const Channel<Message>& channel) {
    if constexpr (std::same_as<Message, kinect_frame_t>) {
      bus.subscribe(channel, [this, &bus](const kinect_frame_t& m) { on_frame(bus, m); });
    } else {
      const std::string topic = fmt::format("/{}", channel.name);
      const Schema schema{fmt::format("roomwise.{}", Message::getTypeName()),
                          json_schema_of<Message>()};
      bus.subscribe(channel, [this, &bus, topic, schema](const Message& message) {
        if constexpr (std::same_as<Message, pose_t>) on_pose(bus, message);
        write(bus, topic, schema, message.utime, as_json(message));
      });
    }
  }

  /// Pictures by schemas viewers know; the message as it is would be two of each.
  void on_frame(Bus& bus, const kinect_frame_t& message) {
    const FrameResult result = decoder_.decode(message, frame_);
    if (result != FrameResult::kOk) {
      bus.count(counter_name(result));
      return;
    }
    const std::int64_t utime = message.utime;
    write(bus, "/camera/depth", text(kRawImageSchema), utime,
          depth_image_json(utime, frame_.depth));
    write(bus, "/camera/depth/calibration", text(kCameraCalibrationSchema), utime,
          calibration_json(utime, frame_.depth_camera, frame_.depth.width_px,
                           frame_.depth.height_px));
    write(bus, "/tf", text(kFrameTransformSchema), utime,
          transform_json(utime, "robot", "camera", frame_.T_robot_camera));
    if (!frame_.color.empty()) write_color(bus, message);
  }

  void write_color(Bus& bus, const kinect_frame_t& message) {
    const std::int64_t utime = message.utime;
    if (message.color_encoding == kinect_frame_t::COLOR_JPEG) {
      write(bus, "/camera/color", text(kCompressedImageSchema), utime,
            compressed_image_json(utime, message.color_data));
    } else {
      write(bus, "/camera/color/raw", text(kRawImageSchema), utime,
            color_image_json(utime, frame_.color));
    }
    write(bus, "/camera/color/calibration", text(kCameraCalibrationSchema), utime,
          calibration_json(utime, frame_.color_camera, frame_.color.width_px,
                           frame_.color.height_px));
  }

  void on_pose(Bus& bus, const pose_t& pose) {
    if (!std::isfinite(pose.x_m + pose.y_m + pose.heading_rad)) return;
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.rotate(Eigen::AngleAxisd(pose.heading_rad, Eigen::Vector3d::UnitZ()));
    T.translation() << pose.x_m, pose.y_m, 0.0;
    write(bus, "/tf", text(kFrameTransformSchema), pose.utime,
          transform_json(pose.utime, "map", "robot", T));
  }

  static Schema text(const FoxgloveSchema& schema) {
    return {std::string(schema.name), std::string(schema.schema)};
  }

  void write(const Bus& bus, const std::string& topic, const Schema& schema, std::int64_t utime,
             const std::string& json) {
    auto known = topics_.find(topic);
    if (known == topics_.end()) {
      known = topics_.emplace(topic, mcap_.add_channel(topic, schema.name, schema.json)).first;
    }
    mcap_.write(known->second, utime_of(bus.now()), utime, json);
    ++count_;
  }

  McapWriter mcap_;
  FrameDecoder decoder_;
  RgbdFrame frame_;
  std::map<std::string, std::uint16_t> topics_;
  std::uint64_t count_ = 0;
};

void run_export_mcap(const std::filesystem::path& log, const std::filesystem::path& out) {
  ReplacedFile file(out);
  McapExport mcap(file.temporary());
  const LogReading reading = replay_log(log, [&](Bus& bus) { mcap.subscribe(bus); });
  const std::uint64_t count = mcap.close();
  file.commit();
  fmt::print("{} messages\n", count);
  reading.raise_complaints(log);
}

struct McapOptions {
  std::filesystem::path log;
  std::filesystem::path out;
};

}  // namespace

void add_export_mcap(CLI::App& parent) {
  CLI::App& command = *parent.add_subcommand("mcap", "For Foxglove and Lichtblick: JSON in MCAP.");
  const auto options = std::make_shared<McapOptions>();
  command.add_option("LOG", options->log, "a log")->required();
  command.add_option("-o", options->out, "file to write")->required();
  command.callback([options] { run_export_mcap(options->log, options->out); });
}

}  // namespace roomwise
