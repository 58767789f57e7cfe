#include "actors/domain/mission/schema_check.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "actors/domain/mission/text_patterns.hpp"
#include "io/json_schema/sentence_parts.hpp"
#include "runtime/assert.hpp"

namespace godwit::mission {

namespace {

using nlohmann::json;

constexpr auto no_limit = std::numeric_limits<std::size_t>::max();

bool is_any(const json&) { return true; }

} // namespace

struct schema_check::node {
  struct property {
    std::string key;
    std::unique_ptr<node> value; // null: any
    bool is_required = false;
  };
  struct branch {
    std::unique_ptr<node> condition;
    std::unique_ptr<node> then;
  };

  explicit node(const json& schema);
  [[nodiscard]] bool holds(const json& value) const;

private:
  void add_keyword(const std::string& key, const json& value);
  void add_properties(const json& schemas);
  void add_required(const json& keys);
  void add_branches(const json& all_of);
  [[nodiscard]] bool holds_of_number(double value) const;
  [[nodiscard]] bool holds_of_text(const std::string& text) const;
  [[nodiscard]] bool holds_of_object(const json& object) const;
  [[nodiscard]] bool holds_of_list(const json& list) const;

  bool (*has_type_)(const json& value) = is_any;
  std::optional<std::vector<json>> only_; // enum and const
  std::optional<double> minimum_, above_, maximum_, below_;
  std::size_t least_size_ = 0; // of a text or a list, whichever the schema is about
  std::size_t most_size_ = no_limit;
  text_test has_form_ = nullptr;
  std::vector<property> properties_; // sorted by key, as the members of a document are
  std::size_t required_ = 0;
  bool is_closed_ = false;
  std::unique_ptr<node> each_;
  std::vector<branch> branches_;
};

schema_check::node::node(const json& schema) {
  GODWIT_ASSERT(schema.is_object(), "a schema is an object");
  add_properties(schema.value("properties", json::object()));
  for (const auto& [key, value] : schema.items())
    add_keyword(key, value);
}

namespace {

bool (*type_named(const std::string& name))(const json&) {
  using row = std::pair<std::string_view, bool (*)(const json&)>;
  static constexpr row rows[] = {{"object", [](const json& value) { return value.is_object(); }},
                                 {"array", [](const json& value) { return value.is_array(); }},
                                 {"string", [](const json& value) { return value.is_string(); }},
                                 {"number", [](const json& value) { return value.is_number(); }},
                                 {"integer", [](const json& value) { return value.is_number_integer(); }},
                                 {"boolean", [](const json& value) { return value.is_boolean(); }}};
  const auto* const found = std::ranges::find(rows, name, &row::first);
  GODWIT_ASSERT(found != std::end(rows), "the program knows the type " + name);
  return found->second;
}

} // namespace

void schema_check::node::add_keyword(const std::string& key, const json& value) {
  using adder = std::function<void(node&, const json&)>;
  static const std::map<std::string, adder, std::less<>> adders{
      {"$schema", [](node&, const json&) {}},
      {"title", [](node&, const json&) {}},
      {"description", [](node&, const json&) {}},
      {"properties", [](node&, const json&) {}}, // before all others
      {"type", [](node& n, const json& v) { n.has_type_ = type_named(v.get<std::string>()); }},
      {"enum", [](node& n, const json& v) { n.only_ = v.get<std::vector<json>>(); }},
      {"const", [](node& n, const json& v) { n.only_ = std::vector{v}; }},
      {"minimum", [](node& n, const json& v) { n.minimum_ = v.get<double>(); }},
      {"exclusiveMinimum", [](node& n, const json& v) { n.above_ = v.get<double>(); }},
      {"maximum", [](node& n, const json& v) { n.maximum_ = v.get<double>(); }},
      {"exclusiveMaximum", [](node& n, const json& v) { n.below_ = v.get<double>(); }},
      {"minLength", [](node& n, const json& v) { n.least_size_ = v.get<std::size_t>(); }},
      {"maxLength", [](node& n, const json& v) { n.most_size_ = v.get<std::size_t>(); }},
      {"minItems", [](node& n, const json& v) { n.least_size_ = v.get<std::size_t>(); }},
      {"maxItems", [](node& n, const json& v) { n.most_size_ = v.get<std::size_t>(); }},
      {"pattern", [](node& n, const json& v) { n.has_form_ = test_of_pattern(v.get<std::string>()); }},
      {"items", [](node& n, const json& v) { n.each_ = std::make_unique<node>(v); }},
      {"required", [](node& n, const json& v) { n.add_required(v); }},
      {"additionalProperties", [](node& n, const json& v) { n.is_closed_ = v == json(false); }},
      {"allOf", [](node& n, const json& v) { n.add_branches(v); }},
  };
  const auto found = adders.find(key);
  GODWIT_ASSERT(found != adders.end(), "the program knows the keyword " + key);
  found->second(*this, value);
}

// JSON's objects are sorted here, so the properties are too.
void schema_check::node::add_properties(const json& schemas) {
  for (const auto& [key, schema] : schemas.items())
    properties_.push_back({key, std::make_unique<node>(schema), false});
}

void schema_check::node::add_required(const json& keys) {
  for (const auto& key : keys) {
    const auto found = std::ranges::find(properties_, key.get_ref<const std::string&>(), &property::key);
    GODWIT_ASSERT(found != properties_.end(), "what is required is among the properties: " + key.dump());
    found->is_required = true;
    ++required_;
  }
}

void schema_check::node::add_branches(const json& all_of) {
  for (const auto& each : all_of)
    branches_.push_back({std::make_unique<node>(each.at("if")), std::make_unique<node>(each.at("then"))});
}

bool schema_check::node::holds(const json& value) const {
  if (!has_type_(value) || (only_ && std::ranges::find(*only_, value) == only_->end()))
    return false;
  const bool holds_inside = value.is_number()   ? holds_of_number(value.get<double>())
                            : value.is_string() ? holds_of_text(value.get_ref<const std::string&>())
                            : value.is_object() ? holds_of_object(value)
                            : value.is_array()  ? holds_of_list(value)
                                                : true;
  return holds_inside && std::ranges::all_of(branches_, [&](const branch& each) {
           return !each.condition->holds(value) || each.then->holds(value);
         });
}

bool schema_check::node::holds_of_number(double value) const {
  return (!minimum_ || value >= *minimum_) && (!above_ || value > *above_) && (!maximum_ || value <= *maximum_) &&
         (!below_ || value < *below_);
}

bool schema_check::node::holds_of_text(const std::string& text) const {
  const auto size = io::schemas::utf8_length(text);
  return size >= least_size_ && size <= most_size_ && (has_form_ == nullptr || has_form_(text));
}

// Both are sorted by key, so one walk along both is enough.
bool schema_check::node::holds_of_object(const json& object) const {
  auto known = properties_.begin();
  std::size_t required_found = 0;
  for (const auto& [key, value] : object.get_ref<const json::object_t&>()) {
    while (known != properties_.end() && known->key < key)
      ++known;
    const bool is_known = known != properties_.end() && known->key == key;
    if (is_known ? !known->value->holds(value) : is_closed_)
      return false;
    required_found += is_known && known->is_required ? 1 : 0;
  }
  return required_found == required_;
}

bool schema_check::node::holds_of_list(const json& list) const {
  return list.size() >= least_size_ && list.size() <= most_size_ &&
         (!each_ || std::ranges::all_of(list, [this](const json& value) { return each_->holds(value); }));
}

schema_check::schema_check(const json& schema) : root_(std::make_unique<node>(schema)) {}
schema_check::~schema_check() = default;
schema_check::schema_check(schema_check&&) noexcept = default;
schema_check& schema_check::operator=(schema_check&&) noexcept = default;

bool schema_check::holds(const json& document) const { return root_->holds(document); }

} // namespace godwit::mission
