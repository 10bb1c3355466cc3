#include "common/auth/secret_key.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <stdexcept>

#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

namespace fs = std::filesystem;

mode_t mode_of(const fs::path& path) {
  struct stat found {};
  return ::stat(path.c_str(), &found) == 0 ? found.st_mode & 0777U : 0;
}

TEST(SecretKey, IsReadBackAsItWasMade) {
  const ScratchFolder folder;
  const SecretKey key = make_key_file(folder.path() / "key");
  EXPECT_EQ(read_key_file(folder.path() / "key"), key);
}

TEST(SecretKey, IsItsOwnersAlone) {
  const ScratchFolder folder;
  make_key_file(folder.path() / "run" / "key");
  EXPECT_EQ(mode_of(folder.path() / "run" / "key"), 0600U);
  EXPECT_EQ(mode_of(folder.path() / "run"), 0700U);
}

TEST(SecretKey, IsAnotherOneEveryTime) {
  const ScratchFolder folder;
  const SecretKey first = make_key_file(folder.path() / "key");
  EXPECT_NE(make_key_file(folder.path() / "key"), first);
  EXPECT_NE(read_key_file(folder.path() / "key"), first);
}

TEST(SecretKey, IsRefusedWhereOthersMayRead) {
  const ScratchFolder folder;
  const fs::path path = folder.path() / "key";
  make_key_file(path);
  for (const mode_t mode : {0640U, 0604U, 0620U, 0602U}) {
    ASSERT_EQ(::chmod(path.c_str(), mode), 0);
    EXPECT_THROW(read_key_file(path), std::runtime_error) << std::oct << mode;
  }
}

TEST(SecretKey, IsRefusedWhereOthersMayWriteToItsFolder) {
  const ScratchFolder folder;
  ASSERT_EQ(::chmod(folder.path().c_str(), 0777), 0);
  EXPECT_THROW(make_key_file(folder.path() / "key"), std::runtime_error);
}

TEST(SecretKey, IsRefusedIfItIsNone) {
  const ScratchFolder folder;
  EXPECT_THROW(read_key_file(folder.path() / "none"), std::runtime_error);
  EXPECT_THROW(read_key_file(folder.path()), std::runtime_error);
  const fs::path path = folder.path() / "short";
  std::ofstream(path) << "too short";
  ASSERT_EQ(::chmod(path.c_str(), 0600), 0);
  EXPECT_THROW(read_key_file(path), std::runtime_error);
  const fs::path key = folder.path() / "key";
  make_key_file(key);
  fs::create_symlink(key, folder.path() / "link");
  EXPECT_THROW(read_key_file(folder.path() / "link"), std::runtime_error);
}

TEST(SecretKey, WhatIsWrongNamesTheFile) {
  try {
    read_key_file("/nonexistent/drive.key");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent/drive.key"), std::string::npos);
  }
}

}  // namespace
}  // namespace roomwise
