#include "services/segment_svc/model_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/segment_svc/support/taught.h"
#include "tests/support/scratch_folder.h"

namespace roomwise::segment {
namespace {

const ColorModel kModel = taught_greys({{{11.5, 22.5}, {108.25, 61.375}, {71.0, 51.5}}});

std::string complaint(const std::filesystem::path& path) {
  try {
    static_cast<void>(load_model(path));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(ModelFile, ReadsBackWhatWasSaved) {
  const ScratchFolder folder;
  const auto path = folder.path() / "model.txt";
  save_model(path, kModel);
  save_model(path, kModel);  // over an older one
  const auto read = load_model(path);
  EXPECT_EQ(read.grey[1].mean_levels, 108.25);
  EXPECT_EQ(read.grey[2].sigma_levels, 51.5);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(ModelFile, RefusalNamesFileAndReason) {
  const ScratchFolder folder;
  const auto path = folder.path() / "model.txt";
  EXPECT_EQ(complaint(path), path.string() + ": cannot read the model");
  std::ofstream(path) << "roomwise-segment-model 9 fused\n";
  EXPECT_NE(complaint(path).find(path.string() + ": model of another version"), std::string::npos);
  save_model(path, kModel);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 2);
  EXPECT_EQ(complaint(path), path.string() + ": damaged: its CRC differs");
}

TEST(ModelFile, SavingWhereNothingCanBeWrittenNamesTheFile) {
  EXPECT_THROW(save_model("/nowhere/at/all/model.txt", kModel), std::runtime_error);
}

}  // namespace
}  // namespace roomwise::segment
