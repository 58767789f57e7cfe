#include "runtime/internal_messages.hpp"

#include "runtime/ask_error.hpp"
#include "runtime/define_message.hpp"
#include "runtime/supervision/messages.hpp"
#include "runtime/trace/trace_renderer.hpp"

GODWIT_DEFINE_MESSAGES(godwit::runtime, ping, pong, durable, write_failed, restored, begun, outside_call, deadline,
                       retry_write, effect_taken, child_up, recovery_ready, restart_due, stop_overdue, guardian_tick,
                       start_children, stop_children, ask_failed, get_children, children, child_event, child_alive,
                       supervise, supervised, trace_loss);
