#include <fmt/core.h>

#include "logs/tools/frame_choice.h"
#include "logs/tools/image_file.h"
#include "logs/tools/labels_picture.h"
#include "logs/tools/landmarks_picture.h"
#include "logs/tools/subcommands.h"

namespace roomwise {
namespace {

struct FramePngOptions {
  std::filesystem::path log;
  std::filesystem::path out;
  std::optional<int> frame;
};

template <class Message, class Draw>
void add_frame_png(CLI::App& parent, const char* name, const char* what,
                   const Channel<Message>& channel, Draw draw) {
  CLI::App& command = *parent.add_subcommand(name, what);
  const auto options = std::make_shared<FramePngOptions>();
  command.add_option("LOG", options->log, "a log with frames and their answers")->required();
  command.add_option("-o", options->out, "PNG to write")->required();
  command.add_option("--frame", options->frame, "KINECT_FRAME.seq - 1; else the middle one")
      ->check(CLI::NonNegativeNumber);
  command.callback([options, &channel, draw] {
    const auto found = choose_frame(options->log, channel, options->frame);
    write_png(options->out, draw(found.frame, found.message));
    found.reading.raise_complaints(options->log);
  });
}

}  // namespace

void add_export_landmarks_png(CLI::App& parent) {
  add_frame_png(parent, "landmarks-png", "Edges and landmarks on the colour image.",
                channels::kLandmarks, draw_landmarks);
}

void add_export_labels_png(CLI::App& parent) {
  add_frame_png(parent, "labels-png", "Labels, floor and free range on the colour image.",
                channels::kSegments, draw_labels);
}

}  // namespace roomwise
