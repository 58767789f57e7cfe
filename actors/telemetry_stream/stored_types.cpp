// The types of the stream that are no messages, and that the trace records.
#include "actors/telemetry_stream/actor.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::telemetry_stream::audience);
GODWIT_DEFINE_MESSAGE(godwit::telemetry_stream::pictured_points);
