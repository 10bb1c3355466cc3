#pragma once
#include <filesystem>
#include <iosfwd>
#include <string>

namespace roomwise {

/// Which part of a log becomes text.
struct CsvRequest {
  std::filesystem::path log;
  std::string channel;
  std::string list;  ///< a row for each element of this list instead of each message; empty: none
};

/// Writes comma separated values (RFC 4180, lines end in \n): a header, then a row for each message
/// on the channel, or for each element of one list with its message's utime and seq and its index.
/// Throws std::runtime_error if the channel or list is unknown, or, after all whole messages are
/// written, if the log is damaged or a message could not be decoded.
void write_csv(const CsvRequest& request, std::ostream& out);

}  // namespace roomwise
