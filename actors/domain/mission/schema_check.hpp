// A schema of config/schemas as a tree that is asked whether a document is valid, and nothing else: ten times as fast
// as valijson, for lists of thousands of rows and for nothing else (docs/decisions/map-and-service.md).
//
// Knows the keywords that config/schemas uses (io/json_schema/explain.hpp has their list); another one is a broken
// invariant, because the schemas are part of the program. A test holds the answers against those of valijson. Thread:
// any, once made. Source: JSON Schema draft-07, validation; a whole number is one without a decimal point.
#pragma once

#include <memory>

#include <nlohmann/json.hpp>

namespace godwit::mission {

class schema_check {
public:
  // SCHEMA has no $ref. It is not needed any more afterwards.
  explicit schema_check(const nlohmann::json& schema);
  ~schema_check();
  schema_check(schema_check&&) noexcept;
  schema_check& operator=(schema_check&&) noexcept;

  [[nodiscard]] bool holds(const nlohmann::json& document) const;

private:
  struct node;
  std::unique_ptr<node> root_;
};

} // namespace godwit::mission
