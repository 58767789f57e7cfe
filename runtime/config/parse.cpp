#include "runtime/config/parse.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "runtime/assert.hpp"
#include "runtime/config/schema.hpp"

namespace godwit::runtime {

namespace {

using nlohmann::json;

// Builds the document from the parser's events, so that double keys and the bounds are seen before they do harm.
// Every handler returns whether the parser shall go on.
class document_builder final : public json::json_sax_t {
public:
  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(std::int64_t value) override { return put(value); }
  bool number_unsigned(std::uint64_t value) override { return put(value); }
  bool number_float(double value, const std::string& /*text*/) override { return put(value); }
  bool binary(json::binary_t& /*value*/) override { return false; } // no such thing in a JSON text
  bool start_object(std::size_t /*size*/) override { return open(json::object()); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t /*size*/) override { return open(json::array()); }
  bool end_array() override { return close(); }

  bool string(std::string& value) override {
    if (value.size() <= max_config_text)
      return put(std::move(value));
    problems_.push_back({path_here(), "is a text of " + std::to_string(value.size()) + " bytes",
                         "a text of up to " + std::to_string(max_config_text) + " bytes"});
    return put(std::string{});
  }

  bool key(std::string& key) override {
    open_.back().key = std::move(key);
    return true;
  }

  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const nlohmann::detail::exception& error) override {
    position_ = position;
    syntax_error_ = error.what();
    return false;
  }

  [[nodiscard]] json& document() { return document_; }
  [[nodiscard]] std::vector<config_problem>& problems() { return problems_; }
  // Of the offending byte: the parser counts the bytes that it has read, and that one is the last of them.
  [[nodiscard]] std::size_t offset() const { return position_ == 0 ? 0 : position_ - 1; }
  [[nodiscard]] const std::string& syntax_error() const { return syntax_error_; }

private:
  struct level {
    json* container; // stays valid: only the innermost container changes while it is open
    std::string key; // of the value that comes next, in an object
    std::string path;
  };

  [[nodiscard]] std::string path_here() const {
    if (open_.empty())
      return {};
    const auto& [container, key, path] = open_.back();
    return container->is_array() ? path_to_item(path, container->size()) : path_to_key(path, key);
  }

  // Puts a value where the parser is and returns the place.
  json* place(json value) {
    if (open_.empty())
      return &(document_ = std::move(value));
    auto& [container, key, path] = open_.back();
    if (container->is_array())
      return &container->emplace_back(std::move(value));
    if (container->contains(key) && problems_.size() < max_config_problems)
      problems_.push_back({path_to_key(path, key), "stands twice in the same object", {}});
    return &((*container)[key] = std::move(value));
  }

  bool put(json value) {
    place(std::move(value));
    return problems_.size() < max_config_problems;
  }

  bool open(json container) {
    auto path = path_here();
    if (open_.size() == max_config_depth) {
      problems_.push_back(
          {std::move(path), "is nested too deep", "up to " + std::to_string(max_config_depth) + " levels"});
      return false;
    }
    auto* opened = place(std::move(container));
    open_.push_back({opened, {}, std::move(path)});
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  json document_;
  std::vector<level> open_;
  std::vector<config_problem> problems_;
  std::size_t position_ = 0;
  std::string syntax_error_;
};

// "[json.exception.parse_error.101] parse error at line 1, column 3: syntax error while ..." without all that stands in
// front.
std::string reason_of(const std::string& parser_message) {
  constexpr std::string_view front = "syntax error ";
  if (const auto start = parser_message.find(front); start != std::string::npos)
    return "is not JSON: " + parser_message.substr(start + front.size());
  const auto start = parser_message.find("] ");
  return "is not JSON: " + (start == std::string::npos ? parser_message : parser_message.substr(start + 2));
}

// `offset` is that of the offending byte, or the end of the text.
config_error syntax_error(std::string_view text, std::string_view source, std::size_t offset, std::string reason) {
  const auto before = text.substr(0, offset);
  const auto line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  const auto line = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const auto column = 1 + before.size() - line_start;
  return {config_errc::syntax, std::string(source), line, column, {{{}, std::move(reason), {}}}, 0};
}

} // namespace

tl::expected<json, config_error> parse_config(std::string_view text, std::string_view source) {
  if (text.size() > max_config_bytes)
    return tl::unexpected(config_error{
        config_errc::too_large,
        std::string(source),
        0,
        0,
        {{{}, "has " + std::to_string(text.size()) + " bytes", "up to " + std::to_string(max_config_bytes) + " bytes"}},
        0});
  // The parser takes a byte 0 for the end of the text.
  if (const auto end = text.find('\0'); end != std::string_view::npos)
    return tl::unexpected(syntax_error(text, source, end, "is not JSON: a byte 0"));
  document_builder builder;
  constexpr bool whole_text = true;
  constexpr bool with_comments = true;
  const bool complete =
      json::sax_parse(text.begin(), text.end(), &builder, json::input_format_t::json, whole_text, with_comments);
  if (!builder.syntax_error().empty())
    return tl::unexpected(syntax_error(text, source, builder.offset(), reason_of(builder.syntax_error())));
  if (!builder.problems().empty())
    return tl::unexpected(
        config_error{config_errc::invalid, std::string(source), 0, 0, std::move(builder.problems()), 0});
  GODWIT_ASSERT(complete, "a JSON text that was not read to its end has a problem");
  return std::move(builder.document());
}

} // namespace godwit::runtime
