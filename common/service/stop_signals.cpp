#include "common/service/stop_signals.h"

#include <atomic>
#include <csignal>

namespace roomwise {
namespace {

// A signal handler can reach nothing but globals.
std::atomic<bool> signalled{false};
std::atomic<Bus*> bus_to_stop{nullptr};

void on_signal(int) {
  signalled.store(true);
  if (Bus* bus = bus_to_stop.load()) bus->stop();
}

void handle_with(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;  // no SA_RESTART: a signal must end poll()
  for (const int signal : {SIGINT, SIGTERM}) ::sigaction(signal, &action, nullptr);
}

}  // namespace

StopSignals::StopSignals() { handle_with(on_signal); }

StopSignals::~StopSignals() { handle_with(SIG_DFL); }

StopOnSignal::StopOnSignal(Bus& bus) {
  bus_to_stop.store(&bus);
  if (signalled.load()) bus.stop();
}

StopOnSignal::~StopOnSignal() { bus_to_stop.store(nullptr); }

}  // namespace roomwise
