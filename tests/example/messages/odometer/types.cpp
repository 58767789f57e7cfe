// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "tests/example/messages/odometer/types.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::odometer::get_total);
GODWIT_DEFINE_MESSAGE(godwit::odometer::milestone);
GODWIT_DEFINE_MESSAGE(godwit::odometer::moved);
GODWIT_DEFINE_MESSAGE(godwit::odometer::reset);
GODWIT_DEFINE_MESSAGE(godwit::odometer::reset_done);
GODWIT_DEFINE_MESSAGE(godwit::odometer::total);
