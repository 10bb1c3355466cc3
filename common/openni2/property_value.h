#pragma once
#include <OniCTypes.h>

#include <algorithm>
#include <cstring>
#include <string_view>

namespace roomwise {

/// Copies a property out, the way OpenNI2 asks for one. `size` must be exactly the value's.
template <class Value>
OniStatus give_value(const Value& value, void* data, int* size) {
  if (*size != static_cast<int>(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof value);
  return ONI_STATUS_OK;
}

/// Copies text out with its closing zero; `size` becomes what was written.
inline OniStatus give_text(std::string_view text, void* data, int* size) {
  if (*size < static_cast<int>(text.size()) + 1) return ONI_STATUS_BAD_PARAMETER;
  std::copy(text.begin(), text.end(), static_cast<char*>(data));
  static_cast<char*>(data)[text.size()] = '\0';
  *size = static_cast<int>(text.size()) + 1;
  return ONI_STATUS_OK;
}

/// Copies a property in.
template <class Value>
OniStatus take_value(const void* data, int size, Value& value) {
  if (size != static_cast<int>(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(&value, data, sizeof value);
  return ONI_STATUS_OK;
}

}  // namespace roomwise
