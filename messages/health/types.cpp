// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/health/types.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::health, get_health, health_status, make_report);
