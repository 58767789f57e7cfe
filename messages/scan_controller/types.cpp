// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/scan_controller/types.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::scan_controller, candidate, candidate_answer, decide_answer, decide_point, get_points,
                       point_closed, point_shown, points, survey_progress, view);
