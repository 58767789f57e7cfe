// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "tests/example/messages/odometer/types.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::odometer, get_total, milestone, moved, reset, reset_done, total);
