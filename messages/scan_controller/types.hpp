// All that is said to and by scan_controller. Thread: plain values.
#pragma once

#include "messages/scan_controller/candidate.hpp"
#include "messages/scan_controller/decision.hpp"
#include "messages/scan_controller/point.hpp"
#include "messages/scan_controller/survey_progress.hpp"
#include "messages/scan_controller/view.hpp"
