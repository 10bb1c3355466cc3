#include "services/create_driver/key_watch.h"

#include <stdexcept>

namespace roomwise {

Signature KeyWatch::check(const velocity_command_t& command) {
  if (command.signature_size == 0) return Signature::kMissing;
  if (key_ && check_signature(*key_, command) == Signature::kGenuine) return Signature::kGenuine;
  read_if_due();
  return key_ ? check_signature(*key_, command) : Signature::kForged;
}

void KeyWatch::read_if_due() {
  const auto now = std::chrono::steady_clock::now();
  if (read_ && now - *read_ < std::chrono::milliseconds(100)) return;
  read_ = now;
  try {
    key_ = read_key_file(path_);
    error_.clear();
  } catch (const std::runtime_error& error) {  // safety_svc has not started yet, or never will
    key_.reset();
    error_ = error.what();
  }
}

}  // namespace roomwise
