// Who may say what to mapobjects_store. Every ask is answered when its outcome is on the disk; who hears that the
// outcome is unknown asks again with the same id or key.
//
// Hand out the narrowest handle that serves.
#pragma once

#include "messages/mapobjects_store/types.hpp"
#include "runtime/seam.hpp"

namespace godwit::mapobjects_store {

// Who recognises things.
using sighting_handle =
    runtime::mailbox<runtime::asks<sighting, sighting_answer>, runtime::asks<pass_end, pass_answer>>;

// Who speaks for the operator.
using operator_handle =
    runtime::mailbox<runtime::asks<operator_verdict, verdict_answer>, runtime::asks<acknowledge_fallback, map_answer>,
                     runtime::asks<requeue_mission, moved_rows>, runtime::asks<get_owed, owed_list>,
                     runtime::asks<get_map, map_status>>;

// Who shows the map to people.
using viewer_handle = runtime::mailbox<runtime::asks<get_objects, shown_objects>>;

// Who talks with the missions service.
using client_handle =
    runtime::mailbox<runtime::asks<choose_mission, map_answer>, runtime::asks<begin_load, load_answer>,
                     runtime::asks<load_page, load_answer>, runtime::asks<finish_load, load_answer>,
                     runtime::asks<pull_failed, map_answer>, runtime::asks<acknowledge_fallback, map_answer>,
                     runtime::asks<take_batch, batch>, runtime::asks<get_batches, open_batches>,
                     runtime::asks<batch_delivered, map_answer>, runtime::asks<return_batch, map_answer>,
                     runtime::asks<delete_mission, moved_rows>, runtime::asks<orphan_mission, moved_rows>,
                     runtime::asks<requeue_mission, moved_rows>, runtime::asks<get_owed, owed_list>,
                     runtime::asks<get_map, map_status>>;

// Everything that may be asked.
using handle =
    runtime::mailbox<runtime::asks<sighting, sighting_answer>, runtime::asks<pass_end, pass_answer>,
                     runtime::asks<operator_verdict, verdict_answer>, runtime::asks<acknowledge_fallback, map_answer>,
                     runtime::asks<choose_mission, map_answer>, runtime::asks<begin_load, load_answer>,
                     runtime::asks<load_page, load_answer>, runtime::asks<finish_load, load_answer>,
                     runtime::asks<pull_failed, map_answer>, runtime::asks<take_batch, batch>,
                     runtime::asks<get_batches, open_batches>, runtime::asks<batch_delivered, map_answer>,
                     runtime::asks<return_batch, map_answer>, runtime::asks<delete_mission, moved_rows>,
                     runtime::asks<orphan_mission, moved_rows>, runtime::asks<requeue_mission, moved_rows>,
                     runtime::asks<get_owed, owed_list>, runtime::asks<get_map, map_status>>;

// The writer's thread.
using wake_handle = runtime::mailbox<runtime::tells<wake>>;

// All of it.
using own_handle =
    runtime::combine<handle, viewer_handle, runtime::mailbox<runtime::tells<wake>, runtime::tells<look>>>;

} // namespace godwit::mapobjects_store
