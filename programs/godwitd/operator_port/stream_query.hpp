// What a client of the stream wants, out of the address that it asks for:
//
//   /api/v1/stream?topics=position@5,flight,authority      position at most five times a second
//   /api/v1/stream                                         all topics, as often as they come
//
// Errors: sentences for the answer, without quotes. Thread: pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "actors/telemetry_stream/hub.hpp"

namespace godwit::operator_port {

[[nodiscard]] tl::expected<std::vector<telemetry_stream::wanted_topic>, std::string>
read_topics(std::string_view target);

} // namespace godwit::operator_port
