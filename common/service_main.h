#pragma once
#include <functional>
#include <memory>
#include <string_view>

#include "common/bus/bus.h"
#include "common/params/params.h"

namespace roomwise {

/// Makes the service on a bus; what it returns lives until the bus stops.
using ServiceFactory = std::function<std::shared_ptr<void>(Bus&)>;

/// Everything a process does that is not its service: command line, parameters, the bus, HEALTH and
/// PARAMS at 1 Hz, signals, errors. Returns the exit status: 0 after SIGINT, SIGTERM or the end of
/// a whole log; 1 after a damaged log, a bad parameter or any other error, said in one line on
/// stderr.
int run_service(std::string_view name, int argc, const char* const* argv, const ParamFields& params,
                const ServiceFactory& make_service);

/// main() of a service: `Service` has a type Params and a constructor (Bus&, const Params&).
///
/// Every parameter is also an option, --NAME VALUE, that overrides the file.
///
///   NAME [--params FILE]                                  live, on LCM_DEFAULT_URL
///   NAME [--params FILE] --replay IN [--record OUT]       offline, as fast as it can
template <class Service>
int service_main(std::string_view name, int argc, const char* const* argv) {
  typename Service::Params params;
  return run_service(name, argc, argv, ParamFields(params), [&params](Bus& bus) {
    return std::static_pointer_cast<void>(std::make_shared<Service>(bus, params));
  });
}

}  // namespace roomwise
