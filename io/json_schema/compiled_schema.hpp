// A JSON Schema (draft-07), prepared once and asked often: whether a document is valid, and what is wrong with it.
//
// valijson judges, also by keywords that explain.hpp has no sentence for: those are told in valijson's words. The
// schemas are part of the program and have no $ref; one that is broken throws. Thread: any, once made.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/json_schema/explain.hpp"

namespace godwit::io::schemas {

class compiled_schema {
public:
  explicit compiled_schema(nlohmann::json schema);
  ~compiled_schema();
  compiled_schema(compiled_schema&&) noexcept;
  compiled_schema& operator=(compiled_schema&&) noexcept;

  [[nodiscard]] const nlohmann::json& source() const { return source_; }

  [[nodiscard]] bool holds(const nlohmann::json& document) const;

  // Empty when the document is valid. Looks no further than one problem beyond AT_MOST.
  [[nodiscard]] std::vector<problem> problems_of(const nlohmann::json& document, std::size_t at_most) const;

  // The same for a document that somebody else has found wrong: never empty.
  [[nodiscard]] std::vector<problem> explain_wrong(const nlohmann::json& document, std::size_t at_most) const;

private:
  void add_unexplained(const nlohmann::json& document, std::vector<problem>& problems) const;

  struct prepared; // keeps valijson's headers out
  nlohmann::json source_;
  std::unique_ptr<prepared> prepared_;
};

} // namespace godwit::io::schemas
