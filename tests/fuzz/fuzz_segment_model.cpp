// A trained segmentation model of any bytes: refused with a reason, or Gaussians that write the
// same text again and classify every grey.
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <variant>

#include "services/segment_svc/core/model_text.h"

namespace {

using namespace roomwise::segment;
using Gaussians = GreyClassifier::Gaussians;

/// The fuzzer's bytes between a right first line and a right CRC: without those no line is read.
std::string file_of(std::string_view lines) {
  std::string text = "roomwise-segment-model 1 gaussian\n";
  text += lines;
  char crc[16];
  std::snprintf(crc, sizeof crc, "crc32 %08x\n", crc32_of(text));
  return text + crc;
}

void check(const std::string& text) {
  const auto model = parse_model(text);
  if (const auto* fault = std::get_if<ModelFault>(&model)) {
    if (reason_of(*fault).empty()) __builtin_trap();
    return;
  }
  const auto& gaussians = std::get<Gaussians>(model);
  if (format_model(gaussians) != text) __builtin_trap();
  const GreyClassifier classifier(gaussians);
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
