#include "io/prometheus/text.hpp"

#include <charconv>
#include <cmath>

namespace godwit::io::prometheus {
namespace {

// In a help text quotes stay as they are.
void append_escaped(std::string& to, std::string_view text, bool is_label) {
  for (const char each : text) {
    if (each == '\n')
      to += "\\n";
    else if (each == '\\' || (is_label && each == '"'))
      (to += '\\') += each;
    else
      to += each;
  }
}

} // namespace

void text_writer::begin(std::string_view name, metric_kind kind, std::string_view help) {
  name_ = name;
  head_.assign("# HELP ").append(name).append(" ");
  append_escaped(head_, help, false);
  head_.append("\n# TYPE ").append(name).append(kind == metric_kind::counter ? " counter\n" : " gauge\n");
}

std::string text_writer::text_of(double value) {
  if (std::isnan(value))
    return "NaN";
  if (std::isinf(value))
    return value > 0 ? "+Inf" : "-Inf";
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return {digits, end};
}

void text_writer::add_text(const std::string& value, std::initializer_list<label> labels) {
  text_ += head_;
  head_.clear();
  text_ += name_;
  char before = '{';
  for (const auto& each : labels) {
    (text_ += before).append(each.name).append("=\"");
    append_escaped(text_, each.value, true);
    text_ += '"';
    before = ',';
  }
  if (labels.size() != 0)
    text_ += '}';
  (text_ += ' ').append(value) += '\n';
}

} // namespace godwit::io::prometheus
