// All that is said to and by scan_controller. Thread: plain values.
#pragma once

#include "messages/scan_controller/point.hpp"
#include "messages/scan_controller/view.hpp"
