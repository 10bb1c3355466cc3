// A trained segmentation model of any bytes: refused with a reason, or one that writes the
// same text again and classifies every grey.
#include <zlib.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <variant>

#include "services/segment_svc/core/color/color_table.h"
#include "services/segment_svc/core/color/model_text.h"

namespace {

using namespace roomwise::segment;

/// The fuzzer's bytes between a right first line and a right CRC: without those no line is read.
std::string file_of(std::string_view lines) {
  std::string text = "roomwise-segment-model 2\n";
  text += lines;
  const auto* bytes = reinterpret_cast<const Bytef*>(text.data());
  char crc[16];
  std::snprintf(crc, sizeof crc, "crc32 %08lx\n",
                ::crc32(0, bytes, static_cast<uInt>(text.size())));
  return text + crc;
}

void check(const std::string& text) {
  const auto model = parse_model(text);
  if (const auto* fault = std::get_if<ModelFault>(&model)) {
    if (reason_of(*fault).empty()) __builtin_trap();
    return;
  }
  const auto& taught = std::get<ColorModel>(model);
  if (format_model(taught) != text) __builtin_trap();
  const ColorTable table(taught.mixtures);
  const GreyClassifier classifier(taught.grey);
  for (int grey = 0; grey < 256; ++grey) {
    const Label label = classifier.classify(static_cast<std::uint8_t>(grey));
    if (label != kObstacle && label != kWall && label != kAccessible) __builtin_trap();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(data, data + size);
  check(bytes);
  check(file_of(bytes));
  return 0;
}
