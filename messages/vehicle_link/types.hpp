// All that is said to and by vehicle_link. Thread: plain values.
#pragma once

#include "messages/vehicle_link/command.hpp"
#include "messages/vehicle_link/connection.hpp"
#include "messages/vehicle_link/evidence.hpp"
#include "messages/vehicle_link/port.hpp"
#include "messages/vehicle_link/relay.hpp"
#include "messages/vehicle_link/transfer.hpp"
