// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/movement_detector/types.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::movement_detector::eyes_view);
GODWIT_DEFINE_MESSAGE(godwit::movement_detector::get_eyes);
GODWIT_DEFINE_MESSAGE(godwit::movement_detector::helper_candidates);
GODWIT_DEFINE_MESSAGE(godwit::movement_detector::helper_ended);
GODWIT_DEFINE_MESSAGE(godwit::movement_detector::helper_status);
