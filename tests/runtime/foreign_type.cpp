#include "tests/runtime/foreign_type.hpp"

#include <string>

#include <nlohmann/json.hpp>

namespace {

using godwit::runtime::envelope;
using godwit::runtime::message_body;
using godwit::runtime::message_type;

struct add {
  std::string by = "another layout than the program's";
};

// What define_message.hpp makes; without the libraries behind it, which are in the program and not in here.
const message_type type_of_add{
    "test.add",
    [](godwit::io::byte_sink&, const void*) {},
    [](std::string& out, godwit::io::byte_source&) { out += "{}"; },
    []() { return nlohmann::json::object(); },
    [](std::string& out, const void*) { out += "{}"; },
    [](const nlohmann::json&, void*) { return std::string(); },
    [](const nlohmann::json&, message_body&) { return std::string(); },
};

} // namespace

void godwit_make_foreign_add(envelope* made) { *made = {{7, 0, 0, 0, 0}, &type_of_add, message_body::of(add{})}; }
