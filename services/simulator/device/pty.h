#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace roomwise::simulator {

/// A serial port made of a pseudo-terminal, under a stable name: a symbolic link to its slave.
///
/// Its own slave stays open, so that a host may come and go; a host that does not read loses what
/// no longer fits (about 20 kB), as behind a UART. It starts raw, at the terminal's usual 38400
/// baud: a host that does not set its speed gets garbage from a robot, as in real life.
class Pty {
 public:
  /// Makes the link, and its folder if need be; one left behind is replaced. Throws
  /// std::runtime_error naming the link if that or the terminal fails.
  explicit Pty(std::filesystem::path link);
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;
  /// Takes the link away, if it is still its own.
  ~Pty();

  /// Appends what the host has written, `most` bytes at most. Never waits.
  void read(std::size_t most, std::vector<std::uint8_t>& bytes);

  /// Hands bytes to the host; how many did not fit and are lost. Never waits.
  [[nodiscard]] std::size_t write(std::span<const std::uint8_t> bytes);

  /// The speed the host has set; 0 if it has hung up or set none there is.
  int host_baud() const;

  /// As if the cable were pulled: whoever has the port open gets a hang-up, and the link goes.
  void hang_up();
  /// A new terminal under the old name. Throws as the constructor.
  void reopen();
  bool is_open() const { return master_ >= 0; }

 private:
  void open();
  void make_link() const;
  void remove_link() const;

  std::filesystem::path link_;
  std::filesystem::path slave_path_;
  int master_ = -1;
  int slave_ = -1;
};

}  // namespace roomwise::simulator
