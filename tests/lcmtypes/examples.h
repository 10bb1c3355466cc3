#pragma once
#include "roomwise/all_messages.hpp"

namespace roomwise {

/// A message with every member set, no two alike where their types could be confused, and with no
/// empty array: what the golden bytes are made of. A member added to a type must be added here, or
/// this does not compile (-Wmissing-field-initializers).
template <class Message>
Message example();

}  // namespace roomwise
