// A table of text: each column as wide as what stands in it, numbers to the right. Thread: a value.
#pragma once

#include <string>
#include <vector>

namespace godwit::trace_tool {

class text_table {
public:
  struct column {
    std::string title;
    bool is_number = true;
  };
  explicit text_table(std::vector<column> columns) : columns_(std::move(columns)) {}

  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  void append_to(std::string& out) const;

private:
  std::vector<column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

} // namespace godwit::trace_tool
