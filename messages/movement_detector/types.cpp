// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/movement_detector/types.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::movement_detector, eyes_view, get_eyes, helper_candidates, helper_ended, helper_status);
