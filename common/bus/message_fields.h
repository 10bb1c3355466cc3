#pragma once

namespace roomwise {

/// Shows a visitor every field of a message, in the order of its .lcm file:
///
///   MessageFields<Message>::visit(message, visitor) calls
///     visitor.value(name, number, string or message)
///     visitor.array(name, std::span of a fixed number of them)
///     visitor.list(name, name of its count, std::vector of them)
///     visitor.blob(name, name of its count, std::vector<std::uint8_t>)
///
/// lcmtypes/generate writes one specialisation for each message (roomwise/TYPE_fields.hpp).
template <class Message>
struct MessageFields;

}  // namespace roomwise
