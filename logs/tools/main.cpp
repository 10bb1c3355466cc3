// rwlog: looks into, makes, converts and scores logs.
#include <fmt/core.h>

#include "logs/tools/subcommands.h"

int main(int argc, char** argv) {
  CLI::App rwlog{"Looks into, makes, converts and scores logs.", "rwlog"};
  rwlog.require_subcommand(1);
  try {
    rwlog.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return rwlog.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "rwlog: {}\n", error.what());
    return 1;
  }
}
