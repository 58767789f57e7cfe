// One frame in words: what the two sides of the peer check write down about it and hold against each other.
//
// Everything is a text, so that comparing is comparing texts, for any kind of field and without a number that one of
// two languages rounds. A description is a line of JSON:
//
//   {"message":"PING","frame":{"id":"4","sequence":"9",...},"fields":{"time_usec":"17","seq":"0",...}}
//
// `frame` has id, sequence, system, component and signature ("right", "none", or what is wrong with it); a signed one
// has link and time too. Errors: a line that is not such a description throws, and the program ends with its sentence.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace godwit::io::mavlink::peers {

using texts = std::map<std::string, std::string>; // by name

struct described_frame {
  std::string message;
  texts frame;
  texts fields;
};

[[nodiscard]] std::string to_line(const described_frame& description);
[[nodiscard]] described_frame from_line(const std::string& line);

// A sentence for everything that is not the same, or that only one of them has.
[[nodiscard]] std::vector<std::string> differences(const described_frame& expected, const described_frame& found);

} // namespace godwit::io::mavlink::peers
