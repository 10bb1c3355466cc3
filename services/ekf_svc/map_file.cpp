#include "services/ekf_svc/map_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <vector>

#include "services/ekf_svc/core/map_codec.h"

namespace roomwise {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* what) {
  throw std::runtime_error("map file " + path.string() + ": " + what + ": " + std::strerror(errno));
}

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags)
      : fd_(::open(path.c_str(), flags, 0644)) {
    if (fd_ < 0) fail(path, "open");
  }
  ~Descriptor() { ::close(fd_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int fd() const { return fd_; }

 private:
  int fd_;
};

void write_and_flush(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
  const Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written = ::write(file.fd(), bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(path, "write");
    done += static_cast<std::size_t>(written);
  }
  if (::fsync(file.fd()) != 0) fail(path, "fsync");
}

/// Makes names in the folder last: a rename is not on disk before its folder is.
void flush_folder(const std::filesystem::path& folder) {
  const Descriptor directory(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (::fsync(directory.fd()) != 0) fail(folder, "fsync");
}

std::optional<std::vector<std::uint8_t>> read_whole(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::vector<std::uint8_t>(std::istreambuf_iterator<char>(file), {});
}

}  // namespace

std::filesystem::path MapFile::beside(const char* ending) const {
  std::filesystem::path path = path_;
  return path += ending;
}

MapFile::Loaded MapFile::load() const {
  Loaded loaded;
  for (const auto& path : {path_, beside(".previous")}) {
    const auto bytes = read_whole(path);
    if (!bytes) continue;
    const ekf::MapVerdict verdict = ekf::decode_map(*bytes, loaded.map);
    if (verdict == ekf::MapVerdict::kOk) return loaded;
    loaded.complaint += path.string() + " is " + std::string(ekf::words(verdict)) + "; ";
    std::error_code ignored;  // a folder that cannot be written is said when the map is saved
    std::filesystem::rename(path, beside(".damaged"), ignored);
  }
  return loaded;
}

void MapFile::save(const ekf::MapSnapshot& map) const {
  const auto part = beside(".part");
  const auto link = beside(".link");
  write_and_flush(part, ekf::encode_map(map));
  // NAME must exist at every instant: its second name is made beside it, then moved.
  static_cast<void>(::unlink(link.c_str()));
  if (::link(path_.c_str(), link.c_str()) == 0) {
    if (::rename(link.c_str(), beside(".previous").c_str()) != 0) fail(path_, "rename");
  } else if (errno != ENOENT) {
    fail(path_, "link");
  }
  if (::rename(part.c_str(), path_.c_str()) != 0) fail(path_, "rename");
  flush_folder(path_.parent_path());
}

}  // namespace roomwise
