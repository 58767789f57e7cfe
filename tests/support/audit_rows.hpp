// The audit of a simulated disk: what was written to its table, read as the journal's file is. Thread: one.
#pragma once

#include <variant>

#include <gtest/gtest.h>

#include "actors/operator_bridge/audit_table.hpp"
#include "runtime/simulation/simulated_journal.hpp"

namespace godwit::audit_support {

class audit_rows {
public:
  audit_rows() : db(*io::sqlite::database::open(":memory:", {.mode = io::sqlite::open_mode::create})) {
    for (const auto& each : operator_bridge::audit_table().migrations)
      EXPECT_TRUE(db.exec(each));
  }
  explicit audit_rows(const runtime::simulated_disk& disk) : audit_rows() {
    for (const auto& each : disk.rows)
      run(each);
  }
  void run(const runtime::row_change& change) {
    auto prepared = db.prepare(change.sql);
    ASSERT_TRUE(prepared) << prepared.error().message;
    ASSERT_TRUE(prepared->changes_data()) << "or the journal refuses it";
    ASSERT_EQ(static_cast<std::size_t>(prepared->parameter_count()), change.values.size());
    int parameter = 0;
    for (const auto& value : change.values)
      std::visit([&](const auto& content) { prepared->bind(++parameter, content); }, value);
    ASSERT_TRUE(prepared->run());
  }
  [[nodiscard]] operator_bridge::audit_page read(const operator_bridge::audit_query& wanted) {
    return *operator_bridge::read_page(db, wanted);
  }

  io::sqlite::database db;
};

} // namespace godwit::audit_support
