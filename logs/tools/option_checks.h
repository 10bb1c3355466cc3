#pragma once
#include <CLI/CLI.hpp>
#include <cmath>

namespace roomwise {

/// An option's value must be a finite number above 0.
inline CLI::Validator positive_number() {
  return {[](const std::string& text) {
            double value = 0.0;
            const bool good =
                CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0.0;
            return good ? std::string() : text + " must be a number above 0";
          },
          "POSITIVE"};
}

}  // namespace roomwise
