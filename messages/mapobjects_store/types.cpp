// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/mapobjects_store/types.hpp"

#include "messages/mapobjects_store/answer.hpp"
#include "messages/mapobjects_store/delivery.hpp"
#include "messages/mapobjects_store/load.hpp"
#include "messages/mapobjects_store/observation.hpp"
#include "messages/mapobjects_store/operator_verdict.hpp"
#include "messages/mapobjects_store/pass.hpp"
#include "messages/mapobjects_store/status.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::mapobjects_store, acknowledge_fallback, batch, batch_delivered, begin_load,
                       choose_mission, delete_mission, finish_load, get_batches, get_map, get_objects, get_owed,
                       load_answer, load_page, look, map_answer, map_status, moved_rows, open_batches, operator_verdict,
                       orphan_mission, owed_list, pass_answer, pass_end, pull_failed, requeue_mission, return_batch,
                       shown_objects, sighting, sighting_answer, take_batch, verdict_answer, wake);
