// The message types of this folder, their JSON and binary forms (runtime/define_message.hpp).
#include "messages/operator/types.hpp"
#include "runtime/define_message.hpp"

GODWIT_DEFINE_MESSAGE(godwit::operator_words::answer);
GODWIT_DEFINE_MESSAGE(godwit::operator_words::word);
