#pragma once
#include <OpenNI.h>

#include <string>

namespace roomwise {

/// OpenNI2's own words for what went wrong last, on one line.
inline std::string openni_error() {
  std::string text = openni::OpenNI::getExtendedError();
  for (char& letter : text) {
    if (letter == '\n' || letter == '\t') letter = ' ';
  }
  text.erase(text.find_last_not_of(' ') + 1);
  text.erase(0, text.find_first_not_of(' '));
  return text;
}

}  // namespace roomwise
