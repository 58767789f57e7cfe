// All that is said to and by ground_port. Times in milliseconds and nanoseconds. Thread: plain values.
#pragma once

#include "messages/ground_port/description.hpp"
#include "messages/ground_port/mission.hpp"
#include "messages/ground_port/operator_link.hpp"
#include "messages/ground_port/port.hpp"
