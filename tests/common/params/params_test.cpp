#include "common/params/params.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdint>
#include <stdexcept>

#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

struct SampleParams {
  double range_noise_m = 0.05;
  int rows_min = 18;
  bool publish_edges = true;
  std::string method = "disparity";
  std::string model_path;
  std::vector<std::string> fault;

  template <class Field>
  void visit_fields(Field&& field) {
    field("range_noise_m", range_noise_m, 1e-3, 1.0);
    field("rows_min", rows_min, 1, 480);
    field("publish_edges", publish_edges);
    field("method", method, {"thesis", "disparity"});
    field("model_path", model_path);
    field("fault", fault);
  }
};

std::string refusal(const std::string& toml) {
  SampleParams params;
  const std::string before = to_toml(ParamFields(params));
  try {
    apply_toml(toml, "p.toml", ParamFields(params));
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(to_toml(ParamFields(params)), before) << "a refused text changed something";
    return error.what();
  }
  return "accepted";
}

TEST(Params, ReadsEveryType) {
  SampleParams params;
  apply_toml("range_noise_m = 1\nrows_min = 20\npublish_edges = false\nmethod = 'thesis'\n",
             "p.toml", ParamFields(params));
  EXPECT_EQ(params.range_noise_m, 1.0);
  EXPECT_EQ(params.rows_min, 20);
  EXPECT_FALSE(params.publish_edges);
  EXPECT_EQ(params.method, "thesis");
}

TEST(Params, RefusesByFileLineAndName) {
  EXPECT_EQ(refusal("rows_min = 3\nrange_noise_m = 5.0"),
            "p.toml:2: range_noise_m must be a number in [0.001, 1]");
  EXPECT_EQ(refusal("range_noise_m = nan"),
            "p.toml:1: range_noise_m must be a number in [0.001, 1]");
  // A whole number that no double equals.
  EXPECT_EQ(refusal("range_noise_m = 9007199254740993"),
            "p.toml:1: range_noise_m must be a number in [0.001, 1]");
  EXPECT_EQ(refusal("range_noise_m = 'x'"),
            "p.toml:1: range_noise_m must be a number in [0.001, 1]");
  EXPECT_EQ(refusal("rows_min = 2.5"), "p.toml:1: rows_min must be a whole number in [1, 480]");
  EXPECT_EQ(refusal("rows_min = 99999999999"),
            "p.toml:1: rows_min must be a whole number in [1, 480]");
  EXPECT_EQ(refusal("publish_edges = 1"), "p.toml:1: publish_edges must be true or false");
  EXPECT_EQ(refusal("method = 'x'"), "p.toml:1: method must be one of \"thesis\", \"disparity\"");
  EXPECT_EQ(refusal("\nrows = 3"),
            "p.toml:2: rows must be one of the parameters range_noise_m, rows_min, publish_edges, "
            "method, model_path, fault");
  EXPECT_EQ(refusal("[rows_min]\na = 1"), "p.toml:1: rows_min must be a whole number in [1, 480]");
}

TEST(Params, ReadsAListOfTexts) {
  SampleParams params;
  apply_toml("fault = ['at_s=1', 'at_s=2']", "p.toml", ParamFields(params));
  EXPECT_EQ(params.fault, (std::vector<std::string>{"at_s=1", "at_s=2"}));
  EXPECT_NE(to_toml(ParamFields(params)).find("fault = [\"at_s=1\", \"at_s=2\"]\n"),
            std::string::npos);
  EXPECT_EQ(refusal("fault = 'at_s=1'"), "p.toml:1: fault must be a list of texts");
  EXPECT_EQ(refusal("fault = [1]"), "p.toml:1: fault must be a list of texts");
}

TEST(Params, ACommandLineSetsEveryType) {
  SampleParams params;
  const ParamFields fields(params);
  const std::vector<std::vector<std::string>> kTexts = {{"0.5"},    {"20"},      {"false"},
                                                        {"thesis"}, {"a \"b\""}, {"one", "two"}};
  for (std::size_t i = 0; i < kTexts.size(); ++i) apply_text(fields.fields()[i], kTexts[i], fields);
  EXPECT_EQ(params.range_noise_m, 0.5);
  EXPECT_EQ(params.rows_min, 20);
  EXPECT_FALSE(params.publish_edges);
  EXPECT_EQ(params.method, "thesis");
  EXPECT_EQ(params.model_path, "a \"b\"");
  EXPECT_EQ(params.fault, (std::vector<std::string>{"one", "two"}));
}

TEST(Params, ACommandLineIsJudgedAsAFileIs) {
  SampleParams params;
  const ParamFields fields(params);
  try {
    apply_text(fields.fields()[1], {"481"}, fields);
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "command line:1: rows_min must be a whole number in [1, 480]");
  }
}

TEST(Params, RefusesTextThatIsNotToml) {
  EXPECT_EQ(refusal("rows_min = 3\nrows_min = = 4").substr(0, 27), "p.toml:2: text must be TOML");
  EXPECT_EQ(refusal("rows_min = 3\nrows_min = 4").substr(0, 27), "p.toml:2: text must be TOML");
}

TEST(Params, NamesAFileThatCannotBeRead) {
  ScratchFolder folder;
  try {
    load_params<SampleParams>(folder.path() / "none.toml");
    FAIL() << "read";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("none.toml: cannot read"), std::string::npos);
  }
}

RC_GTEST_PROP(Params, TextOfTheValuesReadsBackExactly, (std::uint32_t fraction, std::string path)) {
  for (char& c : path) c = static_cast<char>(c & 0x7f);  // TOML is UTF-8
  SampleParams params;
  params.range_noise_m = 1e-3 + 0.999 * fraction / 4294967296.0;
  params.model_path = path;
  SampleParams back;
  apply_toml(to_toml(ParamFields(params)), "text", ParamFields(back));
  RC_ASSERT(back.range_noise_m == params.range_noise_m);
  RC_ASSERT(back.model_path == params.model_path);
}

}  // namespace
}  // namespace roomwise
