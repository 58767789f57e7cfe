// The sentences about a document that its schema forbids, for people who have to mend it.
//
// Covers type, enum, const, ranges, lengths, pattern, required and unknown properties, numbers of items, and allOf with
// if and then; a `title` stands for all that a schema allows. Of other keywords it says nothing. Thread: pure.
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

namespace godwit::io::schemas {

// What is wrong at one place of a JSON document. Thread: plain values.

// From the root of the document on: the key in an object, or the index in a list. Whoever shows it to people writes it
// in the form that they know there: "/items/3/at" or "items[3].at".
using step = std::variant<std::string, std::size_t>;
using place = std::vector<step>;

struct problem {
  place where;
  std::string what;    // what is there: "is 95"
  std::string allowed; // what may be there: "a number from -90 to 90"; empty when `what` says it all
};

// SCHEMA has no $ref. Looks no further than one problem beyond AT_MOST.
[[nodiscard]] std::vector<problem> explain(const nlohmann::json& document, const nlohmann::json& schema,
                                           std::size_t at_most);

// What may stand where SCHEMA holds: "a number from -90 to 90".
[[nodiscard]] std::string allowed_by(const nlohmann::json& schema);

} // namespace godwit::io::schemas
