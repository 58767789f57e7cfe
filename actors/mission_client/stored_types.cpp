// What the journal and the trace keep of this actor: its JSON and binary forms (runtime/define_message.hpp).
#include "actors/mission_client/events.hpp"
#include "actors/mission_client/outbox/recorded_answer.hpp"
#include "actors/mission_client/state.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::mission_client::assignments_seen);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::batch_empty);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::batch_planned);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::batch_returned);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::begun_anew);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::change_done);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::change_failed);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::clock_jumped);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::earlier_delivered);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::store_operation_done);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::fetch_failed);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::mission_fetched);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::mission_gone);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::mission_looked_up);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::next_given);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::on_disk);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::owed_found);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::progress_told);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::pull_ended);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::recorded_answer);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::row_noted);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::rows_delivered);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::rows_failed);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::rows_refused);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::state);
GODWIT_DEFINE_MESSAGE(godwit::mission_client::table_pruned);
