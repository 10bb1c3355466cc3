#include "logs/tools/train.h"

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <map>
#include <stdexcept>
#include <variant>

#include "logs/tools/frame_choice.h"
#include "logs/tools/log_replay.h"
#include "logs/tools/subcommands.h"
#include "logs/tools/whole_file.h"
#include "services/segment_svc/core/color/model_text.h"
#include "services/segment_svc/core/labels.h"

namespace roomwise {
namespace {

std::optional<int> number_of(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<int> label_of(std::string_view text) {
  if (text == "obstacle") return segment::kObstacle;
  if (text == "wall") return segment::kWall;
  if (text == "accessible" || text == "floor") return segment::kAccessible;
  return number_of(text);
}

bool is_wanted(const Training& training, const kinect_frame_t& message) {
  return training.frame ? message.seq == *training.frame + 1 : message.utime == training.utime;
}

[[noreturn]] void refuse(const std::filesystem::path& log, std::string_view reason) {
  throw std::runtime_error(fmt::format("{}: {}", log.string(), reason));
}

ColorImage find_color(const Training& training) {
  std::optional<kinect_frame_t> found;
  static_cast<void>(replay_log(training.log, [&](Bus& bus) {
    bus.subscribe(channels::kKinectFrame, [&](const kinect_frame_t& message) {
      if (!found && is_wanted(training, message)) found = message;
    });
  }));
  if (!found) refuse(training.log, "has no such frame");
  try {
    return decode_colored(*found).color;
  } catch (const std::runtime_error& error) {
    refuse(training.log, error.what());
  }
}

std::string_view reason_of(segment::TrainingFault fault) {
  switch (fault) {
    case segment::TrainingFault::kNoColor:
      return "the frame has no colour";
    case segment::TrainingFault::kUnknownLabel:
      return "a rectangle's label is none of obstacle, wall, accessible";
    case segment::TrainingFault::kOutsideImage:
      return "a rectangle is empty or reaches out of the image";
    case segment::TrainingFault::kClassMissing:
      return "obstacle, wall and accessible need a rectangle each";
    case segment::TrainingFault::kTooFewPixels:
      return "a class has fewer than ten pixels";
    case segment::TrainingFault::kClassesAlike:
      return "two classes have the same statistics: nothing tells them apart";
  }
  return "training failed";
}

void print(const segment::ColorModel& model) {
  constexpr std::array<std::string_view, 3> kNames = {"obstacle", "wall", "accessible"};
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    fmt::print("{} mean_levels {:.3f} sigma_levels {:.3f} parts {}\n", kNames[k],
               model.grey[k].mean_levels, model.grey[k].sigma_levels,
               model.mixtures[k].parts().size());
  }
}

}  // namespace

segment::TrainingRectangle rectangle_of(std::string_view text) {
  const auto refuse_text = [text] {
    throw std::runtime_error(fmt::format("'{}' must be label,left,top,width,height", text));
  };
  std::array<std::optional<int>, 5> fields;
  std::string_view rest = text;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::size_t comma = rest.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == fields.size())) refuse_text();
    const std::string_view field = rest.substr(0, comma);
    fields[i] = i == 0 ? label_of(field) : number_of(field);
    if (!fields[i]) refuse_text();
    if (comma != std::string_view::npos) rest.remove_prefix(comma + 1);
  }
  return {.label = *fields[0],
          .left_px = *fields[1],
          .top_px = *fields[2],
          .width_px = *fields[3],
          .height_px = *fields[4]};
}

segment::ColorModel train_model(const Training& training) {
  std::vector<segment::TrainingRectangle> rectangles;
  for (const std::string& text : training.rectangles) rectangles.push_back(rectangle_of(text));
  auto learned = segment::train(find_color(training), rectangles, training.statistics);
  if (const auto* fault = std::get_if<segment::TrainingFault>(&learned)) {
    refuse(training.log, reason_of(*fault));
  }
  auto model = std::get<segment::ColorModel>(std::move(learned));
  write_whole_file(training.model, segment::format_model(model));
  return model;
}

void add_train(CLI::App& parent) {
  CLI::App& command = *parent.add_subcommand(
      "train", "Teaches segment_svc how obstacles, walls and floor look, from rectangles.");
  const auto training = std::make_shared<Training>();
  command.add_option("LOG", training->log, "log with KINECT_FRAME in colour")->required();
  auto* which = command.add_option_group("frame", "which frame the rectangles lie on");
  which->add_option("--frame", training->frame, "its number, from 0");
  which->add_option("--utime", training->utime, "its time [us]");
  which->require_option(1);
  command
      .add_option("--rect", training->rectangles,
                  "label,left,top,width,height; label: obstacle, wall or accessible")
      ->required()
      ->expected(1, -1);
  const std::map<std::string, segment::GreyStatistics> statistics = {
      {"average", segment::GreyStatistics::kAverage},
      {"threshold", segment::GreyStatistics::kThreshold}};
  command.add_option("--statistics", training->statistics, "average or threshold")
      ->transform(CLI::CheckedTransformer(statistics));
  command.add_option("-o", training->model, "model file to write")->required();
  command.callback([training] { print(train_model(*training)); });
}

}  // namespace roomwise
