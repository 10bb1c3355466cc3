#include "common/auth/secret_key.h"

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

namespace roomwise {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw std::runtime_error("key " + path.string() + ": " + why);
}

[[noreturn]] void refuse_with_errno(const fs::path& path) {
  refuse(path, std::generic_category().message(errno));
}

fs::path or_default(const fs::path& path) { return path.empty() ? default_key_path() : path; }

/// A descriptor closed at the end of its scope.
class OpenFile {
 public:
  OpenFile(const fs::path& path, int flags, mode_t mode = 0)
      : fd_(::open(path.c_str(), flags, mode)) {
    if (fd_ < 0) refuse_with_errno(path);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() { ::close(fd_); }
  int fd() const { return fd_; }

 private:
  int fd_;
};

/// Whoever can write to the folder can put a key of his own there. A folder like /tmp, where nobody
/// removes another's files, will do.
void check_folder(const fs::path& folder) {
  struct stat found {};
  if (::stat(folder.c_str(), &found) != 0) refuse_with_errno(folder);
  const bool is_sticky = (found.st_mode & S_ISVTX) != 0;
  const bool is_others = found.st_uid != ::getuid() && found.st_uid != 0;
  const bool is_open = (found.st_mode & (S_IWGRP | S_IWOTH)) != 0;
  if (is_others || (is_open && !is_sticky)) refuse(folder, "somebody else may write there");
}

}  // namespace

fs::path default_key_path() { return "/tmp/roomwise-" + std::to_string(::getuid()) + "/drive.key"; }

SecretKey make_key_file(const fs::path& chosen) {
  if (sodium_init() < 0) throw std::runtime_error("libsodium has no random numbers");
  const fs::path path = or_default(chosen);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (::mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST) refuse_with_errno(folder);
  check_folder(folder);
  SecretKey key{};
  randombytes_buf(key.data(), key.size());
  const fs::path fresh = path.string() + "." + std::to_string(::getpid());
  ::unlink(fresh.c_str());
  {
    const OpenFile file(fresh, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                        S_IRUSR | S_IWUSR);
    const ssize_t written = ::write(file.fd(), key.data(), key.size());
    if (written != static_cast<ssize_t>(key.size())) refuse_with_errno(fresh);
  }
  if (::rename(fresh.c_str(), path.c_str()) != 0) refuse_with_errno(path);
  return key;
}

SecretKey read_key_file(const fs::path& chosen) {
  const fs::path path = or_default(chosen);
  const OpenFile file(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  struct stat found {};
  if (::fstat(file.fd(), &found) != 0) refuse_with_errno(path);
  if (!S_ISREG(found.st_mode) || found.st_size != static_cast<off_t>(SecretKey().size())) {
    refuse(path, "is no key");
  }
  if (found.st_uid != ::getuid() || (found.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    refuse(path, "somebody else may read or write it");
  }
  SecretKey key{};
  if (::read(file.fd(), key.data(), key.size()) != static_cast<ssize_t>(key.size())) {
    refuse(path, "cannot be read");
  }
  return key;
}

}  // namespace roomwise
