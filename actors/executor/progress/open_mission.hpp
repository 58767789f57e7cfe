// Which mission the reports are about, and its end before its time. A mission that was open before goes on with its
// numbers when it is opened again. Thread: one at a time.
#pragma once

#include "actors/executor/progress/decision_context.hpp"

namespace godwit::executor::progress {

void take(decision_context& t, const mission_opened& what);

// Numbers only rise, and a mission that was told as complete stays so.
void take(decision_context& t, const earlier_reports_told& what);

// Reported once until the mission is started anew, and not at all when it is complete.
void take(decision_context& t, const mission_aborted& what);

} // namespace godwit::executor::progress
