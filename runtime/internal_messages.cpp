#include "runtime/internal_messages.hpp"

#include "runtime/ask_error.hpp"
#include "runtime/define_message.hpp"
#include "runtime/supervision/messages.hpp"
#include "runtime/trace/trace_renderer.hpp"

GODWIT_DEFINE_MESSAGE(godwit::runtime::ping);
GODWIT_DEFINE_MESSAGE(godwit::runtime::pong);
GODWIT_DEFINE_MESSAGE(godwit::runtime::durable);
GODWIT_DEFINE_MESSAGE(godwit::runtime::write_failed);
GODWIT_DEFINE_MESSAGE(godwit::runtime::restored);
GODWIT_DEFINE_MESSAGE(godwit::runtime::begun);
GODWIT_DEFINE_MESSAGE(godwit::runtime::outside_call);
GODWIT_DEFINE_MESSAGE(godwit::runtime::deadline);
GODWIT_DEFINE_MESSAGE(godwit::runtime::retry_write);
GODWIT_DEFINE_MESSAGE(godwit::runtime::effect_taken);
GODWIT_DEFINE_MESSAGE(godwit::runtime::child_up);
GODWIT_DEFINE_MESSAGE(godwit::runtime::recovery_ready);
GODWIT_DEFINE_MESSAGE(godwit::runtime::restart_due);
GODWIT_DEFINE_MESSAGE(godwit::runtime::stop_overdue);
GODWIT_DEFINE_MESSAGE(godwit::runtime::guardian_tick);
GODWIT_DEFINE_MESSAGE(godwit::runtime::start_children);
GODWIT_DEFINE_MESSAGE(godwit::runtime::stop_children);
GODWIT_DEFINE_MESSAGE(godwit::runtime::ask_failed);
GODWIT_DEFINE_MESSAGE(godwit::runtime::get_children);
GODWIT_DEFINE_MESSAGE(godwit::runtime::children);
GODWIT_DEFINE_MESSAGE(godwit::runtime::child_event);
GODWIT_DEFINE_MESSAGE(godwit::runtime::child_alive);
GODWIT_DEFINE_MESSAGE(godwit::runtime::supervise);
GODWIT_DEFINE_MESSAGE(godwit::runtime::supervised);
GODWIT_DEFINE_MESSAGE(godwit::runtime::trace_loss);
