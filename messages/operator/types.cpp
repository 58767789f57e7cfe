// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/operator/types.hpp"
#include "messages/operator/principal.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGES(godwit::operators, answer, command, principal);
