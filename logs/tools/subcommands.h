#pragma once
#include <CLI/CLI.hpp>

namespace roomwise {

// One function a subcommand: adds it, with its options, to `parent`. What it does runs while the
// command line is parsed; it throws std::runtime_error, naming the file, when it cannot.

}  // namespace roomwise
