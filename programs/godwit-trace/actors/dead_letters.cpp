#include "programs/godwit-trace/actors/dead_letters.hpp"

#include <algorithm>
#include <utility>

#include "runtime/journal/journal_reader.hpp"

namespace godwit::trace_tool {

tl::expected<std::vector<given_up>, std::string> read_dead_letters(const std::string& journal,
                                                                   const std::vector<std::string>& actors) {
  auto reader = runtime::journal_reader::open(journal);
  if (!reader)
    return tl::unexpected(reader.error().message());
  std::vector<given_up> result;
  for (const auto& actor : actors) {
    auto letters = reader->dead_letters(actor);
    if (!letters)
      return tl::unexpected(letters.error().message());
    for (auto& each : *letters)
      result.push_back({actor, std::move(each)});
  }
  std::ranges::stable_sort(result, {}, [](const given_up& each) { return each.letter.at_ns; });
  return result;
}

void append_dead_letter(std::string& out, const given_up& each, const paint& colours) {
  append_utc_ns(out, each.letter.at_ns);
  out.append(" ").append(colours.bad()).append(each.actor).append(" gave up").append(colours.end());
  out += ' ' + each.letter.type + " #" + std::to_string(each.letter.message_id) + " of " + each.letter.sender +
         ", after " + std::to_string(each.letter.attempts) + " crashes: ";
  append_printable(out, each.letter.reason);
  out += "\n  ";
  append_printable(out, each.letter.body);
  out += '\n';
}

void append_dead_letter_json(std::string& out, const given_up& each) {
  out += R"({"dead_letter":)" + std::to_string(each.letter.message_id) + R"(,"cause":)" +
         std::to_string(each.letter.cause_id) + R"(,"time_ns":)" + std::to_string(each.letter.at_ns) +
         R"(,"attempts":)" + std::to_string(each.letter.attempts);
  append_member(out, "actor", each.actor);
  append_member(out, "sender", each.letter.sender);
  append_member(out, "type", each.letter.type);
  append_member(out, "reason", each.letter.reason);
  append_member(out, "message", each.letter.body);
  out += "}\n";
}

} // namespace godwit::trace_tool
