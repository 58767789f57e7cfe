// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/health/types.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::health::get_health);
GODWIT_DEFINE_MESSAGE(godwit::health::health_status);
GODWIT_DEFINE_MESSAGE(godwit::health::make_report);
