// The types of the stream that are no messages, and that the trace records.
#include "actors/telemetry_stream/actor.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::telemetry_stream, audience, pictured_points);
