// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "programs/godwitd/control/messages.hpp"
#include "programs/godwitd/ground_run/messages.hpp"
#include "programs/godwitd/landing_watch/messages.hpp"
#include "programs/godwitd/sightings/messages.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::control::control_request);
GODWIT_DEFINE_MESSAGE(godwit::daemon::sighting_counts);
GODWIT_DEFINE_MESSAGES(godwit::ground_run, get_run, retry_due, run_status, tick, woken);
GODWIT_DEFINE_MESSAGE(godwit::landing_watch::tick);
GODWIT_DEFINE_MESSAGES(godwit::sightings, get_sightings, tick, woken);
