#pragma once
#include <filesystem>
#include <string>

#include "services/ekf_svc/core/map_snapshot.h"

namespace roomwise {

/// A map on disk that no power cut can spoil: the new one is written beside it and flushed, then
/// takes its name in one step; the one before is kept as NAME.previous.
class MapFile {
 public:
  explicit MapFile(std::filesystem::path path) : path_(std::move(path)) {}

  struct Loaded {
    ekf::MapSnapshot map;   ///< empty: there is none to go on with
    std::string complaint;  ///< what was wrong with a file that could not be used
  };
  /// The newest whole map. A damaged file is moved to NAME.damaged, and NAME.previous taken.
  Loaded load() const;

  /// Throws std::runtime_error naming the file and why; the map on disk is then the one before.
  void save(const ekf::MapSnapshot& map) const;

 private:
  std::filesystem::path beside(const char* ending) const;

  std::filesystem::path path_;
};

}  // namespace roomwise
