// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/operator/types.hpp"
#include "messages/operator/principal.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::operators::answer);
GODWIT_DEFINE_MESSAGE(godwit::operators::command);
GODWIT_DEFINE_MESSAGE(godwit::operators::principal);
