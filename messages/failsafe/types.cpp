// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/failsafe/types.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::failsafe::command_pending);
GODWIT_DEFINE_MESSAGE(godwit::failsafe::expect_mode);
GODWIT_DEFINE_MESSAGE(godwit::failsafe::following);
GODWIT_DEFINE_MESSAGE(godwit::failsafe::get_failsafe_status);
GODWIT_DEFINE_MESSAGE(godwit::failsafe::guard_answer);
GODWIT_DEFINE_MESSAGE(godwit::failsafe::guard_mission);
GODWIT_DEFINE_MESSAGE(godwit::failsafe::hand_back);
GODWIT_DEFINE_MESSAGE(godwit::failsafe::override_answer);
GODWIT_DEFINE_MESSAGE(godwit::failsafe::override_rule);
GODWIT_DEFINE_MESSAGE(godwit::failsafe::failsafe_status);
GODWIT_DEFINE_MESSAGE(godwit::failsafe::return_taken);
GODWIT_DEFINE_MESSAGE(godwit::failsafe::taken_over);
GODWIT_DEFINE_MESSAGE(godwit::failsafe::tick);
