#include "programs/godwit-trace/message_json.hpp"

#include "io/fields/hex_text.hpp"
#include "io/fields/json_text.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-trace/message_name.hpp"
#include "programs/godwit-trace/withheld.hpp"

namespace godwit::trace_tool {

void append_message_json(std::string& out, std::uint64_t time_us, const io::mavlink::frame_view& frame) {
  out += "{\"time_us\":";
  io::append_json_number(out, time_us);
  out += ",\"system\":";
  io::append_json_number(out, frame.system());
  out += ",\"component\":";
  io::append_json_number(out, frame.component());
  out += ",\"sequence\":";
  io::append_json_number(out, frame.sequence());
  out += ",\"id\":";
  io::append_json_number(out, frame.id());
  out += ",\"name\":\"";
  append_message_name(out, frame.id());
  out += "\",\"signed\":";
  io::append_json_value(out, frame.is_signed());
  const bool is_ours = io::mavlink::visit(frame, [&](const auto& message) {
    out += ",\"fields\":";
    io::append_json(out, message);
  });
  if (!is_ours && !is_withheld(frame.id())) {
    out += ",\"payload\":\"";
    io::append_hex(out, frame.payload());
    out += '"';
  }
  out += '}';
}

} // namespace godwit::trace_tool
