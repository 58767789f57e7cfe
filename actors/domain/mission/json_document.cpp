#include "actors/domain/mission/json_document.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "runtime/assert.hpp"

namespace godwit::mission {

namespace {

using nlohmann::json;

// What a parser of numbers overflows with; its sentence repeats the number, however long it is.
constexpr int number_overflow = 406;

// Builds the document from the parser's events and stops at the first bound that is passed. Every handler returns
// whether the parser shall go on.
class document_builder final : public json::json_sax_t {
public:
  explicit document_builder(std::size_t max_values) : max_values_(max_values) {}

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(std::int64_t value) override { return put(value); }
  // Who asks such a number for a signed one would be given another: 2^64 - 1 would be -1, and a good latitude.
  bool number_unsigned(std::uint64_t value) override {
    return std::in_range<std::int64_t>(value) ? put(value) : put(static_cast<double>(value));
  }
  bool number_float(double value, const std::string& /*text*/) override { return put(value); }
  bool binary(json::binary_t& /*value*/) override { return false; } // no such thing in a JSON text
  bool start_object(std::size_t /*size*/) override { return open(json::object()); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t /*size*/) override { return open(json::array()); }
  bool end_array() override { return close(); }

  bool string(std::string& value) override {
    if (value.size() > max_document_text)
      return stop("has a text of " + std::to_string(value.size()) + " bytes",
                  "up to " + std::to_string(max_document_text) + " bytes");
    if (value.find('\0') != std::string::npos) // where C reads it, the text would end there
      return stop("has a text with the character U+0000 in it", {});
    return put(std::move(value));
  }

  bool key(std::string& key) override {
    if (key.size() > max_document_key)
      return stop("has a property whose name has " + std::to_string(key.size()) + " bytes",
                  "up to " + std::to_string(max_document_key) + " bytes");
    const auto [place, is_new] = open_.back()->get_ref<json::object_t&>().try_emplace(std::move(key), nullptr);
    if (!is_new)
      return stop("has the property " + in_quotes(place->first) + " twice in one object", {});
    property_ = &place->second;
    return true;
  }

  // What the parser read last is not repeated: it may be long, and need not be UTF-8.
  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const nlohmann::detail::exception& error) override {
    std::string_view words = error.what();
    if (const auto start = words.find("syntax error "); start != std::string_view::npos)
      words.remove_prefix(start + 13);
    words = words.substr(0, words.find("; last read: "));
    stop(error.id == number_overflow ? "has a number beyond 1.8e308" : "is not JSON: " + std::string(words), {});
    position_ = position;
    return false;
  }

  [[nodiscard]] json& document() { return document_; }
  [[nodiscard]] const document_problem& problem() const { return problem_; }
  [[nodiscard]] std::size_t position() const { return position_; } // 0: not a matter of syntax

private:
  bool stop(std::string what, std::string allowed) {
    problem_ = {{}, std::move(what), std::move(allowed)};
    return false;
  }

  json& place(json value) {
    if (open_.empty())
      return document_ = std::move(value);
    auto& container = *open_.back();
    return container.is_array() ? container.emplace_back(std::move(value)) : *property_ = std::move(value);
  }

  bool has_room() {
    return ++values_ <= max_values_ || stop("has more than " + std::to_string(max_values_) + " values", {});
  }

  bool put(json value) {
    if (!has_room())
      return false;
    place(std::move(value));
    return true;
  }

  // The innermost container is the only one that changes, so the places of the outer ones stay.
  bool open(json container) {
    if (open_.size() == max_document_depth)
      return stop("is nested too deep", "up to " + std::to_string(max_document_depth) + " levels");
    if (!has_room())
      return false;
    open_.push_back(&place(std::move(container)));
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  std::size_t max_values_;
  std::size_t values_ = 0;
  json document_;
  std::vector<json*> open_;
  json* property_ = nullptr; // in the innermost object, for the value that comes next
  document_problem problem_;
  std::size_t position_ = 0;
};

std::string place_in(std::string_view text, std::size_t position) {
  const auto before = text.substr(0, position == 0 ? 0 : position - 1);
  const auto line_end = before.rfind('\n');
  const auto line = 1 + static_cast<std::size_t>(std::ranges::count(before, '\n'));
  const auto column = before.size() - (line_end == std::string_view::npos ? 0 : line_end + 1) + 1;
  return " (line " + std::to_string(line) + ", column " + std::to_string(column) + ")";
}

} // namespace

tl::expected<json, document_error> parse_document(std::string_view text, std::size_t max_bytes) {
  if (text.size() > max_bytes)
    return tl::unexpected(
        bounded({document_errc::too_large,
                 {{{}, "has " + std::to_string(text.size()) + " bytes", "up to " + std::to_string(max_bytes)}}},
                text));
  // The parser takes a byte 0 for the end of the text.
  if (const auto end = text.find('\0'); end != std::string_view::npos)
    return tl::unexpected(
        bounded({document_errc::syntax, {{{}, "is not JSON: a byte 0" + place_in(text, end + 1), {}}}}, text));
  document_builder builder(max_bytes / bytes_a_value);
  if (json::sax_parse(text.begin(), text.end(), &builder))
    return std::move(builder.document());
  auto problem = builder.problem();
  GODWIT_ASSERT(!problem.what.empty(), "a text that was not read to its end has a problem");
  const bool is_syntax = builder.position() != 0;
  if (is_syntax)
    problem.what += place_in(text, builder.position());
  return tl::unexpected(
      bounded({is_syntax ? document_errc::syntax : document_errc::wrong_form, {std::move(problem)}}, text));
}

} // namespace godwit::mission
