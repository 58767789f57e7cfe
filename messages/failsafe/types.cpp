// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/failsafe/types.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::failsafe, command_pending, expect_mode, following, get_failsafe_status, guard_answer,
                       guard_mission, hand_back, override_answer, override_rule, failsafe_status, return_taken,
                       taken_over, tick);
