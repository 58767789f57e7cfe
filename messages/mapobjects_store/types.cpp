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

GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::acknowledge_fallback);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::batch);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::batch_delivered);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::begin_load);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::choose_mission);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::delete_mission);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::finish_load);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::get_batches);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::get_map);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::get_objects);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::get_owed);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::load_answer);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::load_page);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::look);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::map_answer);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::map_status);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::moved_rows);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::open_batches);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::operator_verdict);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::orphan_mission);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::owed_list);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::pass_answer);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::pass_end);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::pull_failed);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::requeue_mission);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::return_batch);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::shown_objects);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::sighting);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::sighting_answer);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::take_batch);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::verdict_answer);
GODWIT_DEFINE_MESSAGE(godwit::mapobjects_store::wake);
