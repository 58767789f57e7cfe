// What is wrong at one place of a JSON document. Thread: plain values.
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace godwit::io::schemas {

// From the root of the document on: the key in an object, or the index in a list. Whoever shows it to people writes it
// in the form that they know there: "/items/3/at" or "items[3].at".
using step = std::variant<std::string, std::size_t>;
using place = std::vector<step>;

struct problem {
  place where;
  std::string what;    // what is there: "is 95"
  std::string allowed; // what may be there: "a number from -90 to 90"; empty when `what` says it all
};

} // namespace godwit::io::schemas
