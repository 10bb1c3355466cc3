#include "logs/tools/json_fields.h"

#include <gtest/gtest.h>

#include <limits>

namespace roomwise {
namespace {

std::string base64_of(std::string_view text) {
  return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

TEST(Base64, IsAsRfc4648Has) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of("\xff\xff\xff"), "////");
}

TEST(JsonFields, TextThatIsNotPlainIsEscaped) {
  EXPECT_EQ(json_string("a\"\\\n\xe4"), R"("a\"\\\u000a\u00e4")");
}

TEST(JsonFields, NumbersThatAreNotFiniteAreNull) {
  EXPECT_EQ(as_json(0.1), "0.1");
  EXPECT_EQ(as_json(std::numeric_limits<double>::quiet_NaN()), "null");
  EXPECT_EQ(as_json(-std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(as_json(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
}

TEST(JsonFields, MessagesNestAndSchemasDescribeThem) {
  training_rectangle_t rectangle{};
  segment_training_t training{};
  training.rectangles = {rectangle, rectangle};
  const std::string json = as_json(training);
  EXPECT_NE(json.find(R"("rectangles":[{)"), std::string::npos) << json;
  const std::string schema = json_schema_of<segment_training_t>();
  EXPECT_NE(schema.find(R"("rectangles":{"type":"array","items":{"type":"object")"),
            std::string::npos)
      << schema;
}

}  // namespace
}  // namespace roomwise
