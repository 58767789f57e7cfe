// Names for the numbers in messages: the values that godwit reads and writes, named as in MAVLink without the prefix.
//
// The members of messages are plain integers, because a peer may send a value that is not here and it must survive.
// `enum_names` gives the text for logs. Source: MAVLink's common.xml, minimal.xml and standard.xml. Thread: constants.
#pragma once

#include <type_traits>

#include "io/mavlink/enums/command.hpp"
#include "io/mavlink/enums/mission.hpp"
#include "io/mavlink/enums/vehicle.hpp"

namespace godwit::io::mavlink {

// The number of VALUE, as the fields of messages hold it.
template <class E>
requires std::is_enum_v<E>
constexpr std::underlying_type_t<E> number(E value) { return static_cast<std::underlying_type_t<E>>(value); }

} // namespace godwit::io::mavlink
