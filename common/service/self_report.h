#pragma once
#include <chrono>
#include <string>

#include "common/bus/bus.h"
#include "common/service/process_use.h"

namespace roomwise {

/// Publishes HEALTH and PARAMS for a process, once a second and when asked. In replay whatever is
/// measured on this machine is left 0, so that the same log gives the same bytes.
class SelfReport {
 public:
  /// `params_toml`: the effective parameters as text.
  SelfReport(Bus& bus, std::string service, std::string params_toml);

  void publish(Time time);

 private:
  health_t health_at(Time time);
  void measure(health_t& health);

  Bus& bus_;
  std::string service_;
  std::string params_toml_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_measured_ = started_;
  ProcessUse last_use_ = process_use();
};

}  // namespace roomwise
