// apply_toml() on any text: it is refused and changes nothing, or what it sets can be written and
// read back.
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/params/params.h"

namespace {

struct SampleParams {
  double range_noise_m = 0.05;
  int rows_min = 10;
  bool publish_edges = false;
  std::string method = "thesis";
  std::string label = "any text";

  template <class Field>
  void visit_fields(Field&& field) {
    field("range_noise_m", range_noise_m, 1e-3, 1.0);
    field("rows_min", rows_min, 1, 480);
    field("publish_edges", publish_edges);
    field("method", method, {"thesis", "disparity"});
    field("label", label);
  }
};

std::string text_of(SampleParams& params) {
  return roomwise::to_toml(roomwise::ParamFields(params));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view toml(reinterpret_cast<const char*>(data), size);
  SampleParams params;
  const std::string before = text_of(params);
  try {
    roomwise::apply_toml(toml, "fuzz.toml", roomwise::ParamFields(params));
  } catch (const std::runtime_error&) {
    if (text_of(params) != before) __builtin_trap();
    return 0;
  }
  const std::string after = text_of(params);
  SampleParams again;
  roomwise::apply_toml(after, "again.toml", roomwise::ParamFields(again));
  if (text_of(again) != after) __builtin_trap();
  return 0;
}
