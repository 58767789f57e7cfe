// The types of the health actor that are no messages, and that the trace records.
#include "actors/health/actor.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::health::board_view);
